//! Equilibria of a free body on eight chains beside MoorPy 1.3.0 [MOORPY-1], an independent program: tests/data/moorpy_equilibrium.csv, which
//! benches/moorpy_equilibrium.py made. One segment a line, and two with a clump between; surge loads up to where the lines are taut.

use crate::common;

use std::f64::consts::FRAC_PI_4;
use std::fmt::Write;
use windlass_base::pose::Six;
use windlass_model::Model;
use windlass_solve::{EquilibriumOptions, System, equilibrium};

/// The mooring of the script that made the file. MoorPy's hydrostatics are linear: the waterplane area at the origin, and at the
/// metacentre the buoyancy at rest. By -KRX and -KRY: rho g V z_M against pitch about the origin, with the weight 2 m below it on
/// its own.
fn model(clump: f64) -> Model {
    let (rho, g, side, draft) = (1025.0, 9.80665, 60.0, 8.0);
    let (area, volume) = (side * side, side * side * draft);
    let metacentre = -draft / 2.0 + area * side * side / 12.0 / volume;
    let (heave, tilt, buoyancy) = (rho * g * area, rho * g * volume * metacentre, rho * g * volume);
    let mut records = format!(
        "&DIMEN -DIMEN METERS N\n&ENV -DEPTH 300\nMEDIT\n&DESCRIBE BODY SHIP\n*O 0 0 0\n*CG 0 0 -2\n#WEIGHT *CG 2E8 22 22 22\n\
         #HYDROSTATIC *O {heave} {tilt} {tilt} -BUOYANCY {buoyancy} -ZCGE 0\n"
    );
    for line in 0..8 {
        let (sin, cos) = (22.5 + 45.0 * f64::from(line)).to_radians().sin_cos();
        writeln!(records, "*F{line} {} {} -10", 30.0 * cos, 30.0 * sin).unwrap();
    }
    let section = FRAC_PI_4 * 0.18 * 0.18;
    let rest = format!("-BUOY 0 -WTPL {} -EMOD {}", (199.0 - 1025.0 * section) * 9.80665, 8.54e8 / section / 1e6);
    if clump > 0.0 {
        writeln!(records, "~C B_CAT 180 EXACT -LEN 450 -DEP 300 -CLUMP {clump} {rest}\n~C B_CAT 180 -LEN 450 {rest}")
            .unwrap();
    } else {
        writeln!(records, "~C B_CAT 180 EXACT -LEN 900 -DEP 300 {rest}").unwrap();
    }
    for line in 0..8 {
        writeln!(records, "CONNECTOR L{line} -ANC {} 800 ~C *F{line}", 22.5 + 45.0 * f64::from(line)).unwrap();
    }
    records.push_str("END\n");
    let (mut session, screen, _folder) = common::session();
    session.open("records", records);
    session.run();
    assert!(session.errors == 0, "{}", screen.text());
    session.job.model.clone()
}

#[test]
fn free_body_on_eight_chains_matches_moorpy_equilibrium() {
    let mut reader = csv::Reader::from_path("tests/data/moorpy_equilibrium.csv").unwrap();
    let mut rows = 0;
    for row in reader.records() {
        let row = row.unwrap();
        let number = |i: usize| row[i].parse::<f64>().unwrap();
        let model = model(number(0));
        let mut system = System::new(&model, &[]).unwrap();
        system.applied = vec![(0, Six::new(number(1), 0.0, 0.0, 0.0, 0.0, 0.0))];
        let mut state = system.state(&model);
        let found = equilibrium(&system, &mut state, &EquilibriumOptions::default()).unwrap();
        assert!(found.search.residual < 1e-9 && found.loose.is_empty(), "{found:?}");
        assert!(found.search.iterations <= 6, "{} steps", found.search.iterations);
        let pose = state.poses[0];
        let pitch = -pose.axes[(2, 0)].asin();
        let away = |got: f64, want: f64| (got - want).abs();
        let list = system.contributions(&state.poses).unwrap();
        let tension = |n: usize| {
            let own = list.iter().find(|c| c.connector.as_deref() == Some(format!("L{n}").as_str())).unwrap();
            own.load.wrench.fixed_rows::<3>(0).norm()
        };
        let ten = (0..8).map(|n| away(tension(n) / number(5 + n), 1.0)).fold(0.0, f64::max);
        let now = [away(pose.origin.x, number(2)), away(pose.origin.z, number(3)), away(pitch, number(4)), ten];
        // MoorPy stops at steps of 1e-7; a clump on the bottom it holds by a reaction over 1 mm of height, which moves the body by
        // some 0.1 mm
        let grounded = number(14) < -299.99;
        let room = if grounded { [1e-4, 1e-6, 5e-8, 1e-5] } else { [5e-8, 1e-9, 1e-9, 2e-9] };
        assert!(
            now.iter().zip(room).all(|(n, r)| *n < r),
            "{} N, {} N: {now:?} in X, Z, pitch, tension",
            &row[0],
            &row[1]
        );
        rows += 1;
    }
    assert_eq!(rows, 10);
}
