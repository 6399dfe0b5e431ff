//! A rigid load below a hook: four slings of equal and unequal lengths against closed forms.
//!
//! The nodes are at (+-8, +-6, 1), ten from the middle; slings of 20 to a hook on a fall of 10 below a boom at 60; metres and
//! newtons. A sling of length L stretched to l has T = EA (l - L) / L. With the hook h above the plane of the nodes
//! l2 = h2 + 100, and the vertical forces give W = sum of T h / l.

use crate::common;

use windlass::session::Session;
use windlass_base::diagnostic::Severity;
use windlass_model::{End, Model, Situation};
use windlass_solve::{EquilibriumOptions, find_equilibrium_with_rebuilds};

/// AE of 100 mm of the default steel (N).
const EA: f64 = 29000.0 * 6894757.293168361 * std::f64::consts::FRAC_PI_4 * 0.01;

fn run(records: &str) -> (Session, String) {
    let (mut session, screen, _folder): (Session, _, _) = common::session();
    session.open("records", format!("&DIMEN -DIMEN METERS N\n{records}\n"));
    session.run();
    let text = screen.text();
    assert!(session.reports.iter().all(|r| r.severity != Severity::Error), "{text}");
    (session, text)
}

/// The set with these slings and options of its record, the weight at (0, 0, -2).
fn records(weight: f64, lengths: [f64; 4], options: &str) -> String {
    let slings: String = [("8 6", 1), ("-8 6", 2), ("-8 -6", 3), ("8 -6", 4)]
        .iter()
        .zip(lengths)
        .map(|((at, n), l)| format!("*S{n} {at} 1\n~L{n} SLING 100 -LEN {l}\nCONNECTOR L{n} ~L{n} *S{n}\n"))
        .collect();
    format!(
        "MEDIT\n*BOOM 3 5 60\n*BOOM2 3 5 70\n*BOOM3 3 5 61\n~FALL SLING 200 -LEN 10\nCONNECTOR FALL ~FALL *BOOM\n&DESCRIBE BODY DECK\n*CG 0 0 -2\n\
         #WEIGHT *CG {weight} 4 5 6\n{slings}ASSEMBLY T-H_DEFINITION HOOK FALL L1 L2 L3 L4 {options}\nEND"
    )
}

fn settle_model(records: &str) -> Model {
    let mut model = run(records).0.job.model.clone();
    let found = find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap();
    assert!(found.found.search.residual < 1e-9, "{:?}", found.found);
    model
}

fn tension(model: &Model, name: &str) -> f64 {
    let connector = model.connectors.get(name).unwrap();
    let ends = model.end_poses(connector).map(End::at_rest);
    let surroundings = model.surroundings();
    let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
    model.element(connector).unwrap().summary(&at, &[]).unwrap().tension.unwrap()
}

fn assert_near(got: f64, want: f64, tolerance: f64) {
    assert!((got - want).abs() <= tolerance, "{got} {want}");
}

fn position(model: &Model, body: &str) -> [f64; 6] {
    model.bodies.get(body).unwrap().position.values()
}

/// W of slings of these lengths that are all l long.
fn weight(l: f64, lengths: [f64; 4]) -> f64 {
    let height = (l * l - 100.0).sqrt();
    lengths.iter().map(|own| EA * (l - own).max(0.0) / own * height / l).sum()
}

#[test]
fn four_equal_slings_carry_quarter_load_each_with_its_stretch() {
    let l: f64 = 20.02;
    let model = settle_model(&records(weight(l, [20.0; 4]), [20.0; 4], "-INITIAL"));
    let w = weight(l, [20.0; 4]);
    for name in ["L1", "L2", "L3", "L4"] {
        assert_near(tension(&model, name) / (EA * 0.001), 1.0, 1e-9);
    }
    assert_near(tension(&model, "FALL") / w, 1.0, 1e-9);
    // the fall of 200 mm has four times the AE
    let hook = 60.0 - 10.0 * (1.0 + w / (4.0 * EA));
    let want = [3.0, 5.0, hook - (l * l - 100.0).sqrt() - 1.0, 0.0, 0.0];
    for (got, want) in position(&model, "DECK").iter().zip(want) {
        assert_near(*got, want, 1e-8);
    }
    assert_near(position(&model, "HOOK")[2], hook, 1e-8);
}

#[test]
fn longer_diagonal_is_slack_and_other_carries_all() {
    let lengths = [20.0, 20.2, 20.0, 20.2];
    let l: f64 = 20.03;
    let model = settle_model(&records(weight(l, lengths), lengths, "-INITIAL"));
    for name in ["L1", "L3"] {
        assert_near(tension(&model, name) / (EA * 0.0015), 1.0, 1e-8);
    }
    for name in ["L2", "L4"] {
        assert_near(tension(&model, name), 0.0, 0.0);
    }
}

#[test]
fn unequal_diagonals_share_weight_by_their_stretch() {
    // all four are l long: 20 is stretched by 0.03, 20.01 by 0.02
    let lengths = [20.0, 20.01, 20.0, 20.01];
    let l: f64 = 20.03;
    let model = settle_model(&records(weight(l, lengths), lengths, "-INITIAL"));
    for (name, own) in ["L1", "L2", "L3", "L4"].iter().zip(lengths) {
        assert_near(tension(&model, name) / (EA * (l - own) / own), 1.0, 1e-8);
    }
}

#[test]
fn longer_sling_shifts_load_to_other_diagonal() {
    // the slings' own state of stress is (1, -1, 1, -1): to first order T1 + T3 - T2 - T4 = EA d / L, and the vertical forces give
    // the sum. What is left is of second order: the tilt, some d / 10, turns so much of the weight
    let (d, l) = (0.004, 20.02);
    let lengths = [20.0, 20.0 + d, 20.0, 20.0];
    let w = weight(l, [20.0; 4]);
    let model = settle_model(&records(w, lengths, "-INITIAL"));
    let [a, b, c, e] = ["L1", "L2", "L3", "L4"].map(|n| tension(&model, n));
    let half = EA * d / 20.0;
    assert_near(a + c - b - e, half, d / 10.0 * w);
    assert_near(a + b + c + e, 4.0 * EA * 0.001, d / 10.0 * w);
    assert_near(a - c, 0.0, d / 10.0 * w);
}

#[test]
fn initial_places_hook_below_boom_and_keeps_attitude() {
    let (session, _) = run(&records(1e6, [20.0; 4], "-INITIAL"));
    let model = &session.job.model;
    let want = [3.0, 5.0, 50.0 - 300.0_f64.sqrt() - 1.0, 0.0, 0.0, 0.0];
    for (got, want) in position(model, "DECK").iter().zip(want) {
        assert_near(*got, want, 1e-12);
    }
    for (got, want) in position(model, "HOOK").iter().zip([3.0, 5.0, 50.0]) {
        assert_near(*got, want, 1e-12);
    }
}

#[test]
fn vertical_rotates_body_to_hang_with_centre_below_hook() {
    // slings to a hook over (2, 0): 18 above the nodes, the centre 3 below them
    let far = |x: f64, y: f64| ((x - 2.0).powi(2) + y * y + 324.0_f64).sqrt();
    let lengths = [far(8.0, 6.0), far(-8.0, 6.0), far(-8.0, -6.0), far(8.0, -6.0)];
    let (session, _) = run(&records(1e6, lengths, "-INITIAL -VERTICAL"));
    let model = &session.job.model;
    let [x, y, z, roll, pitch, _] = position(model, "DECK");
    assert_near(roll, 0.0, 1e-9);
    // (2, 0, 21) from the centre to the hook is turned upright
    assert_near(pitch, -(2.0_f64 / 21.0).atan(), 1e-9);
    let centre = windlass_base::geometry::Place::new([x, y, z, roll, pitch, 0.0]).apply([0.0, 0.0, -2.0]);
    for (got, want) in centre.iter().zip([3.0, 5.0, 50.0 - (4.0_f64 + 441.0).sqrt()]) {
        assert_near(*got, want, 1e-8);
    }
    // and there it rests, but for the stretch
    let mut rest = model.clone();
    find_equilibrium_with_rebuilds(&mut rest, &EquilibriumOptions::default()).unwrap();
    assert_near(position(&rest, "DECK")[4], pitch, 1e-3);
}

#[test]
fn later_set_removes_sag_from_its_lines() {
    let second = "MEDIT\nCONNECTOR FALL2 ~FALL *BOOM2\n&DESCRIBE BODY DECK\n*T1 4 0 1\n*T2 -4 0 1\n~T1 SLING 50 -LEN 30\n\
                  CONNECTOR A ~T1 *T1\nCONNECTOR B ~T1 *T2\nASSEMBLY T-H_DEFINITION SECOND FALL2 A B -INITIAL\nEND";
    let (session, text) = run(&format!("{}\n{second}", records(1e6, [20.0; 4], "-INITIAL")));
    let model = &session.job.model;
    let before = run(&records(1e6, [20.0; 4], "-INITIAL")).0;
    assert_eq!(position(model, "DECK"), position(&before.job.model, "DECK"));
    let deck = position(model, "DECK")[2];
    let hook = deck + 1.0 + (900.0_f64 - 16.0).sqrt();
    assert_near(position(model, "SECOND")[2], hook, 1e-9);
    assert_near(model.connectors.get("FALL2").unwrap().first_length.unwrap(), 70.0 - hook, 1e-9);
    assert_eq!(model.connectors.get("A").unwrap().first_length, None);
    assert!(session.reports.iter().any(|r| r.message.starts_with("connector FALL2: ")), "{text}");
}

#[test]
fn orient_aligns_body_system_with_its_nodes_without_moving_it() {
    let start = "MEDIT\n*BOOM 0 0 60\n~FALL SLING 200 -LEN 10\nCONNECTOR FALL ~FALL *BOOM\n&DESCRIBE BODY DECK\n*CG 1 2 3\n#WEIGHT *CG 1E5 1 1 1\n\
                 *S1 8 6 1\n*S2 -8 6 1\n*S3 -8 -6 1\n*S4 8 -6 1\n~L SLING 100 -LEN 20\nCONNECTOR L1 ~L *S1\nCONNECTOR L2 ~L *S2\n\
                 CONNECTOR L3 ~L *S3\nCONNECTOR L4 ~L *S4\nEND\n&INSTATE -LOCATE DECK 5 6 7 10 20 30\n";
    let (plain, _) = run(start);
    let (turned, _) = run(&format!("{start}MEDIT\nASSEMBLY T-H_DEFINITION HOOK FALL L1 L2 L3 L4 -ORIENT\nEND"));
    let (plain, turned) = (&plain.job.model, &turned.job.model);
    for point in ["*CG", "*S1", "*S2", "*S3", "*S4"] {
        let [a, b] = [plain, turned].map(|m| m.global(m.points.get(point).unwrap()));
        a.iter().zip(b).for_each(|(a, b)| assert_near(*a, b, 1e-12));
    }
    // x of the new system is y of the old, y its x turned about: the side of node 1 against node 2 is +x
    let body = turned.bodies.get("DECK").unwrap();
    let old = plain.bodies.get("DECK").unwrap();
    for (new, was) in
        [([0.0; 3], [0.0, 0.0, 1.0]), ([1.0, 0.0, 0.0], [0.0, 1.0, 1.0]), ([0.0, 1.0, 0.0], [1.0, 0.0, 1.0])]
    {
        body.position.apply(new).iter().zip(old.position.apply(was)).for_each(|(a, b)| assert_near(*a, b, 1e-12));
    }
}

#[test]
fn deactivated_sets_leave_their_hooks_in_place() {
    let second = "MEDIT\nCONNECTOR FALL2 ~FALL *BOOM3\n&DESCRIBE BODY DECK\nCONNECTOR M1 ~L1 *S1\nCONNECTOR M2 ~L1 *S2\n\
                  CONNECTOR M3 ~L1 *S3\nCONNECTOR M4 ~L1 *S4\nASSEMBLY T-H_DEF NEW FALL2 M1 M2 M3 M4 -INITIAL -DEACTIVATE\nEND";
    let (session, _) = run(&format!("{}\n{second}", records(1e6, [20.0; 4], "-INITIAL")));
    let mut model = session.job.model.clone();
    assert!(!model.connectors.get("FALL").unwrap().active && model.connectors.get("FALL2").unwrap().active);
    let before = position(&model, "HOOK");
    let found = find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap();
    assert_eq!(position(&model, "HOOK"), before);
    assert!(found.found.loose.iter().all(|(body, _)| body == "DECK"), "{:?}", found.found.loose);
    assert_near(tension(&model, "FALL2") / 1e6, 1.0, 1e-8);
}

#[test]
fn assembly_is_renamed_and_dismantled_whole() {
    let edit = "MEDIT\nRENAME HOOK BLOCK\nRENAME L1 NORTH\nEND\n&STATUS ASSEMBLIES BLOCK\n&STATUS G_CONN NORTH";
    let (session, text) = run(&format!("{}\n{edit}", records(1e6, [20.0; 4], "")));
    let model = &session.job.model;
    assert_eq!(model.connectors.get("NORTH").unwrap().points, ["*S1", "*BLOCK"]);
    assert!(model.assembly_of("north").is_some_and(|a| a.name == "BLOCK"), "{text}");
    let (session, _) = run(&format!("{}\n{edit}\nMEDIT\nDELETE BLOCK\nDELETE NORTH\nEND", records(1e6, [20.0; 4], "")));
    let model = &session.job.model;
    assert!(model.assemblies.is_empty() && !model.bodies.contains_key("BLOCK") && !model.points.contains_key("*BLOCK"));
    assert_eq!(model.connectors.get("L2").unwrap().points, ["*S2"]);
}
