//! The set-down of scripts/lmu.cif on four leg mating units: by the formulas of [MOSES-FLEX LMU], and beside an independent solution
//! (tests/data/lmu_stages.py).

use crate::common;

use windlass_model::Model;
use windlass_solve::System;

/// The model after the script has set the hoist to a length and found the equilibrium.
fn stage(hoist: &str) -> Model {
    let script = std::fs::read_to_string("scripts/lmu.cif").unwrap();
    let change = format!("&CONNECTOR HOIST -LENGTH {hoist}\n&EQUI\n");
    let end = script.find(&change).unwrap() + change.len();
    let (mut session, screen, _folder) = common::session();
    session.open("script", script[..end].to_string());
    session.run();
    assert_eq!(session.errors, 0, "{}", screen.text());
    session.job.model.clone()
}

/// Force of a connector on a body (kN).
fn force(model: &Model, body: &str, connector: &str) -> [f64; 3] {
    let system = System::new(model, &[]).unwrap();
    let poses = system.state(model).poses;
    let index = system.nodes.iter().position(|n| n.name == body).unwrap();
    let list = system.contributions(&poses).unwrap();
    let own = list.iter().find(|c| c.body == index && c.connector.as_deref() == Some(connector)).unwrap();
    [0, 1, 2].map(|i| own.load.wrench[i] / 1e3)
}

#[test]
fn every_lmu_stage_matches_independent_solution() {
    let mut reader = csv::Reader::from_path("tests/data/lmu_stages.csv").unwrap();
    let mut rows = 0;
    for row in reader.records() {
        let row = row.unwrap();
        let number = |i: usize| row[i].parse::<f64>().unwrap();
        let model = stage(&row[0].parse::<f64>().unwrap().to_string());
        // one part in a million of the 8,000 kN that hang there; the least stiff degree of freedom, yaw, asks for no more
        let close = |got: f64, want: f64, what: &str| {
            assert!((got - want).abs() < 5e-6 + 1e-6 * want.abs(), "{} m, {what}: {got} is not {want}", &row[0]);
        };
        let [x, y, z, ..] = model.bodies.get("DECK").unwrap().position.values();
        for (got, (i, axis)) in [x, y, z].into_iter().zip([(1, "X"), (2, "Y"), (3, "Z")]) {
            close(got, number(i), axis);
        }
        for (leg, name) in ["L1", "L2", "L3", "L4"].into_iter().enumerate() {
            for (axis, got) in force(&model, "DECK", name).into_iter().enumerate() {
                close(got, number(4 + 3 * leg + axis), name);
            }
        }
        let ropes = ["S1", "S2", "S3", "S4", "T1", "T2"];
        for (index, name) in ropes.into_iter().enumerate() {
            let [x, y, z] = force(&model, "DECK", name);
            close(x.hypot(y).hypot(z), number(16 + index), name);
        }
        let [x, y, z] = force(&model, "HOOK", "HOIST");
        close(x.hypot(y).hypot(z), number(22), "HOIST");
        rows += 1;
    }
    assert_eq!(rows, 3);
}

#[test]
fn landed_topside_matches_rigid_plate_on_four_springs() {
    let model = stage("43.2");
    // the tips are at (+-10, +-6); W = 8000 kN at (0.5, -0.25, 5) m; the tuggers pull with T each at z = 8 toward +y, and up with their
    // slope (8 - 6.46) / 50: both by hand from their stretch, 1256.637 kN / 49 m times 50.024 - 49 m
    let (ea, long) = (std::f64::consts::FRAC_PI_4 * 0.04f64.powi(2) * 1e6, 50.0f64.hypot(1.5395));
    let pull = ea * (long - 49.0) / 49.0;
    let side = 2.0 * pull * 50.0 / long;
    let up = 2.0 * pull * 1.5395 / long;
    // moments about the tips' height: of the weight W y, of the tuggers -side 8 + up 6, and as much of the legs
    let (w, e_x, e_y) =
        (8000.0 - up, 8000.0 * 0.5 / (8000.0 - up), (-8000.0 * 0.25 + side * 8.0 - up * 6.0) / (8000.0 - up));
    // R = W/4 (1 +- e_x / 10 +- e_y / 6) at (+-10, +-6): tilts of 2e-4 move the centers by millimetres, 3e-4 of a leg's load
    for (name, x, y) in [("L1", 1.0, 1.0), ("L2", -1.0, 1.0), ("L3", -1.0, -1.0), ("L4", 1.0, -1.0)] {
        let want = w / 4.0 * (1.0 + x * e_x / 10.0 + y * e_y / 6.0);
        let [_, _, got] = force(&model, "DECK", name);
        assert!((got - want).abs() < 1e-3 * want, "{name}: {got} is not {want}");
    }
    // the tuggers' pull is shared by four sides of K_h: d; c = W / 4 K_v = D_v - LEN + T d
    let [_, y, z, ..] = model.bodies.get("DECK").unwrap().position.values();
    let d = side / 4.0 / 8000.0;
    assert!((y - d).abs() < 1e-6, "{y}");
    assert!((z + 1.5 + w / 4.0 / 50000.0 - d * 0.8 / 3.0).abs() < 1e-6, "{z}");
    // the slings are slack: the hoist bears the hook alone
    let [_, _, hook] = force(&model, "HOOK", "HOIST");
    assert!((hook - 50.0).abs() < 1e-9, "{hook}");
}

#[test]
fn stabbed_pin_force_matches_cone_formulas() {
    let model = stage("41.7");
    let system = System::new(&model, &[]).unwrap();
    let pose = system.state(&model).poses[system.nodes.iter().position(|n| n.name == "DECK").unwrap()];
    let tangent = (1.6 - 0.8) / (2.0 * 1.5);
    let mut touching = 0;
    for (name, x, y) in [("L1", 10.0, 6.0), ("L2", -10.0, 6.0), ("L3", -10.0, -6.0), ("L4", 10.0, -6.0)] {
        let tip = pose.point([x, y, 0.0].into());
        let (deep, side) = (-tip.z, [tip.x - x, tip.y - y]);
        let off = side[0].hypot(side[1]);
        assert!(deep > 0.0 && deep < 1.5, "stabbed: {deep}");
        let d = f64::max(0.0, off - tangent * (1.5 - deep));
        let want = [-side[0] / off * 8000.0 * d, -side[1] / off * 8000.0 * d, 50000.0 * tangent * d];
        for (got, want) in force(&model, "DECK", name).into_iter().zip(want) {
            assert!((got - want).abs() < 1e-6, "{name}: {got} is not {want}");
        }
        touching += usize::from(d > 0.0);
    }
    // the tuggers pull toward +y, the hoist toward +x: the two cones on the -y side hold
    assert_eq!(touching, 2);
}

#[test]
fn pin_on_axis_and_cone_floor_is_held_laterally() {
    // landed, D_v > LEN: the formulas leave no room, d = D_h, so that K_h is the stiffness of a leg in both directions: 4 K_h of four
    let records = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*C1 10 6 0\n*C2 -10 6 0\n*C3 -10 -6 0\n*C4 10 -6 0\n&DESCRIBE BODY DECK\n\
                   *P1 10 6 0\n*P2 -10 6 0\n*P3 -10 -6 0\n*P4 10 -6 0\n*CG 0 0 0\n#WEIGHT *CG 8000 6 8 9\n\
                   ~L LMU 1500 800 1600 X 50000 Y 8000\nCONNECTOR L1 ~L *P1 *C1\nCONNECTOR L2 ~L *P2 *C2\n\
                   CONNECTOR L3 ~L *P3 *C3\nCONNECTOR L4 ~L *P4 *C4\nEND\n&INSTATE -LOCATE DECK 0 0 -1.51\n&EQUI";
    let (mut session, screen, _folder) = common::session();
    session.open("records", records.to_string());
    session.run();
    assert!(session.reports.is_empty(), "{}", screen.text());
    let model = session.job.model.clone();
    let [_, _, z, ..] = model.bodies.get("DECK").unwrap().position.values();
    assert!((z + 1.5 + 0.04).abs() < 1e-12, "W / 4 K_v = 40 mm: {z}");
    let system = System::new(&model, &[]).unwrap();
    let mut state = system.state(&model);
    system.evaluate(&mut state).unwrap();
    // about the origin, in the plane of the tips; yaw: 4 K_h r2, r2 = 136 m2; roll: 4 K_v 36 m2
    for (dof, want) in [
        (0, 4.0 * 8e6),
        (1, 4.0 * 8e6),
        (2, 4.0 * 5e7),
        (3, 4.0 * 5e7 * 36.0),
        (4, 4.0 * 5e7 * 100.0),
        (5, 4.0 * 8e6 * 136.0),
    ] {
        let got = state.stiffness[(dof, dof)];
        assert!((got / want - 1.0).abs() < 1e-9, "{dof}: {got} is not {want}");
    }
}
