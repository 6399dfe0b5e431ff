//! Equilibrium against numbers that can be derived by hand.

use crate::common;

use windlass::session::Session;
use windlass_model::{Model, SolverCache, Weight};
use windlass_solve::{EquilibriumOptions, SolveError, System, find_equilibrium_with_rebuilds, modes};

/// The model that records make, in metres and newtons; each `weights` is one of the body's own part.
fn model(records: &str, weights: &[(&str, [f64; 3], f64, [f64; 3])]) -> Model {
    let (mut session, screen, _folder): (Session, _, _) = common::session();
    session.open("records", format!("&DIMEN -DIMEN METERS N\n{records}\n"));
    session.run();
    assert!(
        session.reports.iter().all(|r| r.severity != windlass_base::diagnostic::Severity::Error),
        "{}",
        screen.text()
    );
    let mut model = session.job.model.clone();
    for (part, at, weight, radii) in weights {
        let made = Weight { at: *at, weight: *weight, radii: *radii, ..Weight::default() };
        model.parts.get_mut(*part).unwrap().weights.push(made);
    }
    model
}

const HUNG: &str = "MEDIT\n*A 0 0 0\n&DESCRIBE BODY LOAD\n*HOOK 0 0 2\n~TIE SL_ELEM 50 TENSION -LEN 10\n\
                    CONNECTOR T ~TIE *HOOK *A\nEND\n&INSTATE -LOCATE LOAD 3 1 -11 10 5 0";

fn z_of(model: &Model, body: &str) -> [f64; 6] {
    model.bodies.get(body).unwrap().position.values()
}

#[test]
fn weight_on_spring_hangs_at_its_static_stretch() {
    let mut model = model(HUNG, &[("LOAD", [0.0, 0.0, 0.0], 1e5, [1.0, 1.0, 1.0])]);
    let found = find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap();
    let ea = 29000.0 * 6894757.293168361 * std::f64::consts::FRAC_PI_4 * 0.05 * 0.05;
    let want = [0.0, 0.0, -10.0 * (1.0 + 1e5 / ea) - 2.0, 0.0, 0.0];
    for (got, want) in z_of(&model, "LOAD").iter().zip(want) {
        assert!((got - want).abs() < 1e-8, "{got} {want} {:?}", found.found);
    }
    assert!(found.found.search.residual < 1e-10, "{:?}", found.found);
    assert_eq!(found.found.loose, [("LOAD".to_string(), "RZ".to_string())]);
}

#[test]
fn periods_match_spring_and_double_pendulum() {
    let mut model = model(HUNG, &[("LOAD", [0.0, 0.0, 0.0], 1e5, [1.0, 1.0, 1.0])]);
    let found = find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap();
    let list = modes(&found.system, &found.state).unwrap();
    let ea = 29000.0 * 6894757.293168361 * std::f64::consts::FRAC_PI_4 * 0.05 * 0.05;
    let (g, m) = (9.80665, 1e5 / 9.80665);
    let heave = ea / 10.0 / m;
    assert!((list.last().unwrap().eigenvalue / heave - 1.0).abs() < 1e-9, "{list:?}");
    // a body of radius of gyration k hung at b below a string of length l: w4 l k2 - w2 g (k2 + b2 + b l) + g2 b = 0
    let (l, b, k2): (f64, f64, f64) = (10.0 * (1.0 + 1e5 / ea), 2.0, 1.0);
    let (p, q) = (g * (k2 + b * b + b * l), g * g * b);
    let root = (p * p - 4.0 * l * k2 * q).sqrt();
    for (index, want) in
        [(1, (p - root) / (2.0 * l * k2)), (2, (p - root) / (2.0 * l * k2)), (3, (p + root) / (2.0 * l * k2))]
    {
        assert!((list[index].eigenvalue / want - 1.0).abs() < 1e-6, "{index} {want} {list:?}");
    }
}

#[test]
fn corrupt_stiffness_has_no_modes_and_names_its_entry() {
    let mut model = model(HUNG, &[("LOAD", [0.0, 0.0, 0.0], 1e5, [1.0, 1.0, 1.0])]);
    let mut found = find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap();
    for value in [f64::NAN, f64::INFINITY] {
        for (row, column) in [(3, 3), (3, 5), (3, 0)] {
            let mut damaged = found.state.stiffness.clone();
            damaged[(row, column)] = value;
            std::mem::swap(&mut found.state.stiffness, &mut damaged);
            let error = modes(&found.system, &found.state).unwrap_err();
            std::mem::swap(&mut found.state.stiffness, &mut damaged);
            assert_eq!(error.who.as_deref(), Some("LOAD"));
            assert!(error.error.to_string().contains("is not finite"), "{error:?}");
        }
    }
    // the largest that a file or record may hold still has modes, or an error
    let largest = found.state.stiffness.clone() * 1e36;
    found.state.stiffness = largest;
    let list = modes(&found.system, &found.state).unwrap();
    assert!(list.iter().all(|m| m.eigenvalue.is_finite()));
}

#[test]
fn top_heavy_body_is_reported_unstable() {
    // on a pin a height h below its centre: the eigenvalue is -g h/(k2 + h2), of h = 1.5E-7 m -5.9E-8 rad2/s2, more than an hour to grow by e
    for (height, warned) in [(1.5e-7, false), (0.05, true)] {
        let records = format!(
            "MEDIT\n*Q 0 0 0\n&DESCRIBE BODY TOP -IGNORE RZ\n*C 0 0 {height}\n*P 0 0 0\n#WEIGHT *C 1E6 5 5 5\n\
             ~PIN FIX X Y Z\nCONNECTOR P ~PIN *Q *P\nEND"
        );
        let mut model = model(&records, &[]);
        let found = find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap();
        let list = modes(&found.system, &found.state).unwrap();
        let want = -9.80665 * height / (25.0 + height * height);
        // rounding of a stiffness of 1e12 N/m over 1e5 kg leaves some 1e-9 rad2/s2
        assert!((list[0].eigenvalue - want).abs() < 1e-4 * want.abs() + 1e-8, "{} {want}", list[0].eigenvalue);
        let table = windlass_solve::tables::periods(&found.system, &found.state).unwrap();
        assert_eq!(format!("{table:?}").contains("not stable"), warned, "{height} {table:?}");
    }
}

#[test]
fn interrupted_equilibrium_ends_with_its_error() {
    let mut model = model(HUNG, &[("LOAD", [0.0, 0.0, 0.0], 1e5, [1.0, 1.0, 1.0])]);
    model.interrupt.store(true, std::sync::atomic::Ordering::Relaxed);
    let error = find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap_err();
    assert_eq!(error.error.to_string(), "interrupted");
}

#[test]
fn system_stiffness_matches_force_finite_difference() {
    let records = "&ENV -DEPTH 200\nMEDIT\n&DESCRIBE BODY A\n*A1 10 5 -2\n*A2 -10 4 3\n&DESCRIBE BODY B\n*B1 0 -6 1\n*B2 3 3 3\n\
                   ~C B_CAT 100 EXACT -LEN 300 -BUOY 0 -WTPL 900 -CLUMP 2E4\n~C B_CAT 80 -LEN 200 -BUOY 0 -WTPL 500\n\
                   ~S B_CAT 100 EXACT -LEN 400 -BUOY 0 -WTPL 900\n\
                   ~H H_CAT 100 EXACT -LEN 60 -WTPL 700\n~T SL_ELEM 50 -LEN 40\n\
                   CONNECTOR C1 -ANC 10 420 ~C *A1\nCONNECTOR S1 -ANC 160 330 ~S *A2\nEND\n\
                   &INSTATE -LOCATE A 0 0 0 10 -20 35 -LOCATE B 20 50 4 -15 30 100\nMEDIT\n\
                   CONNECTOR H1 ~H *A1 *B1\nCONNECTOR T1 ~T *A2 *B2\nEND";
    let weights = [("A", [0.0, 1.0, 3.0], 1e6, [5.0, 5.0, 5.0]), ("B", [2.0, 1.0, 0.0], 1e6, [5.0, 5.0, 5.0])];
    let model = model(records, &weights);
    let system = System::new(&model, &[]).unwrap();
    let mut state = system.state(&model);
    system.evaluate(&mut state).unwrap();
    let start = state.poses.clone();
    let stiffness = state.stiffness.clone();
    let scale = stiffness.amax();
    for column in 0..12 {
        let mut sides = [1.0, -1.0].map(|sign| {
            let mut motion = windlass_base::pose::Six::zeros();
            motion[column % 6] = sign * 1e-5;
            state.poses = start.clone();
            state.poses[column / 6] = start[column / 6].after_motion(&motion);
            system.evaluate(&mut state).unwrap();
            state.residual.clone()
        });
        let [plus, minus] = &mut sides;
        for row in 0..12 {
            let slope = -(plus[row] - minus[row]) / 2e-5;
            let got = stiffness[(row, column)];
            assert!((slope - got).abs() < 2e-7 * scale, "[{row}][{column}]: {got} is not {slope}");
        }
    }
}

#[test]
fn unrestrained_weight_is_refused_with_name_and_direction() {
    let records = "MEDIT\n&DESCRIBE BODY LOAD\n*HOOK 0 0 2\nEND";
    let mut model = model(records, &[("LOAD", [0.0, 0.0, 0.0], 1e5, [1.0, 1.0, 1.0])]);
    let SolveError { who, error } =
        find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap_err();
    assert_eq!(who.as_deref(), Some("LOAD"));
    assert!(error.to_string().contains("nothing holds it in Z") && error.to_string().contains("WEIGHT"), "{error}");
}

#[test]
fn stiffness_with_following_junctions_matches_finite_difference() {
    let records = std::fs::read_to_string("scripts/bridles.cif").unwrap();
    let records: String = records.lines().take_while(|l| !l.starts_with("&STATUS")).map(|l| format!("{l}\n")).collect();
    let mut model = model(&records, &[]);
    let buoy = model.bodies.get_index_of("BUOY").unwrap();
    let held = EquilibriumOptions { ignored: (0..6).map(|f| (buoy, f)).collect(), ..EquilibriumOptions::default() };
    let rest = find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap();
    let got = rest.system.followed_stiffness(&rest.state, buoy).unwrap();
    let start = rest.state.poses.clone();
    for column in 0..6 {
        let sides = [1.0, -1.0].map(|sign| {
            let mut motion = windlass_base::pose::Six::zeros();
            motion[column] = sign * 1e-4;
            let mut state = rest.system.state(&model);
            state.poses = start.clone();
            state.poses[buoy] = start[buoy].after_motion(&motion);
            windlass_solve::equilibrium(&rest.system, &mut state, &held).unwrap();
            state.residual.fixed_rows::<6>(6 * buoy).into_owned()
        });
        let slope = -(sides[0] - sides[1]) / 2e-4;
        for row in 0..6 {
            let scale = (got[(row, row)] * got[(column, column)]).abs().sqrt();
            assert!((slope[row] - got[(row, column)]).abs() < 1e-4 * scale, "[{row}][{column}]: {got} {slope}");
        }
    }
    // with its junctions held the buoy would be four hundred times as stiff
    assert!(got[(0, 0)] < 0.01 * rest.state.stiffness[(6 * buoy, 6 * buoy)]);
}

/// The connectors' vertical forces on their first ends, as F_CONNECTOR has them.
fn lifts(records: &str) -> Vec<(String, f64)> {
    let model = model(records, &[]);
    let mut list = Vec::new();
    for connector in model.connectors.values() {
        let element = model.element(connector).unwrap();
        let ends = model.end_poses(connector).map(windlass_model::End::at_rest);
        let surroundings = model.surroundings();
        let at = windlass_model::Situation { ends: &ends, step: None, surroundings: &surroundings };
        let mut out = windlass_model::ConnectorResponse::default();
        let (committed, mut trial) = (vec![0.0; element.states()], vec![0.0; element.states()]);
        element.evaluate(&at, &committed, &mut trial, &mut SolverCache::new(), &mut out).unwrap();
        list.push((connector.name.clone(), out.wrench[0][2]));
    }
    list
}

#[test]
fn four_pads_share_weight_by_distance_and_ig_stiff_tie_is_left_out() {
    let records = std::fs::read_to_string("scripts/foundation.cif").unwrap();
    let list = lifts(&records);
    // W/4 (1 + x X/25 + y Y/25) with the weight at x, y; the deck turns by some thousandths, with its weight 2 m above
    for (name, want) in [("P1", 292.5e3), ("P2", 202.5e3), ("P3", 157.5e3), ("P4", 247.5e3)] {
        let got = list.iter().find(|(n, _)| n == name).unwrap().1;
        assert!((got / want - 1.0).abs() < 5e-3, "{name}: {got}");
    }
    let (mut session, screen, _folder) = common::session();
    session.open("records", records);
    session.run();
    let text = screen.text();
    assert!(text.contains("Largest Unity") && text.contains("without T (-IG_STIFF)"), "{text}");
    // four springs of 2000 kN/m alone
    let first = text.split("S T I F F N E S S   O F   D E C K :   F O R C E S").nth(1).unwrap();
    let fx = first.lines().find(|l| l.trim_start().starts_with("FX")).unwrap();
    // their axes turn with the deck, by some thousandths
    let xx: f64 = fx.split_whitespace().nth(1).unwrap().parse().unwrap();
    assert!((xx / 8e3 - 1.0).abs() < 1e-5, "{xx}");
}
