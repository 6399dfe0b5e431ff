//! Far starts: a moored barge and a load in four slings come to the same rest from forty places each, in a bounded number of steps.

use crate::common::run::model_as_written as model;

use std::fmt::Write;
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_model::Model;
use windlass_solve::{EquilibriumOptions, System, equilibrium};

/// A barge of 60 m by 60 m on eight chains of 900 m in 300 m, as in benches/equilibrium.rs.
fn barge() -> Model {
    let mut records = String::from(
        "&DIMEN -DIMEN METERS N\n&ENV -DEPTH 300\nMEDIT\n&DESCRIBE BODY SHIP\n*CG 0 0 -2\n#WEIGHT *CG 2E8 22 22 22\n\
         &SURFACE\nBLOCK HULL -30 -30 -8 30 30 10\nEND_&SURFACE\n",
    );
    let section = std::f64::consts::FRAC_PI_4 * 0.18 * 0.18;
    let (modulus, weight) = (8.54e8 / section / 1e6, (199.0 - 1025.0 * section) * 9.80665);
    writeln!(records, "~C B_CAT 180 EXACT -LEN 900 -DEP 300 -BUOY 0 -WTPL {weight} -EMOD {modulus}").unwrap();
    for line in 0..8 {
        let angle = 22.5 + 45.0 * f64::from(line);
        let (sin, cos) = angle.to_radians().sin_cos();
        writeln!(records, "*F{line} {} {} -10\nCONNECTOR L{line} -ANC {angle} 800 ~C *F{line}", 30.0 * cos, 30.0 * sin)
            .unwrap();
    }
    model(&format!("{records}END"))
}

/// A load of 5,000 kN, 10 m by 8 m, in four slings of 20 m from four points of a frame 12 m by 10 m.
fn hanging_load() -> Model {
    let mut records = String::from("&DIMEN -DIMEN METERS K-NTS\nMEDIT\n");
    let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    for (n, (x, y)) in corners.iter().enumerate() {
        writeln!(records, "*A{n} {} {} 0", 6.0 * x, 5.0 * y).unwrap();
    }
    records.push_str(
        "&DESCRIBE BODY LOAD\n*CG 0 0 0\n#WEIGHT *CG 5000 4 4 5\n~S SL_ELEM 100 TENSION -LEN 20 -EMOD 60000\n",
    );
    for (n, (x, y)) in corners.iter().enumerate() {
        writeln!(records, "*E{n} {} {} 2\nCONNECTOR S{n} ~S *E{n} *A{n}", 5.0 * x, 4.0 * y).unwrap();
    }
    records.push_str("END\n&INSTATE -LOCATE LOAD 0 0 -22");
    model(&records)
}

/// Numbers from -1 to 1, always the same.
fn numbers() -> impl FnMut() -> f64 {
    let mut seed = 77_u64;
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Starts up to so far off, with heel and trim to 30 degrees and yaw to 90: the steps each took, or why none came to rest.
fn steps(model: &Model, far: [f64; 3]) -> Vec<Result<usize, String>> {
    let system = System::new(model, &[]).unwrap();
    let mut at_rest = system.state(model);
    equilibrium(&system, &mut at_rest, &EquilibriumOptions::default()).unwrap();
    let home = at_rest.poses[0];
    let mut next = numbers();
    let mut list = Vec::new();
    for start in 0..400 {
        let [x, y, z] = far.map(|f| f * next());
        let [roll, pitch, yaw] = [30.0, 30.0, 90.0].map(|a: f64| (a * next()).to_radians());
        let position = [home.origin.x + x, home.origin.y + y, home.origin.z + z, roll, pitch, yaw];
        let mut state = system.state(model);
        state.poses[0] = Pose::from_place(&Place::new(position));
        list.push(match equilibrium(&system, &mut state, &EquilibriumOptions::default()) {
            Ok(found) => {
                let away = (state.poses[0].origin - home.origin).norm();
                let turned = (state.poses[0].axes - home.axes).norm();
                if away < 1e-4 && turned < 1e-5 {
                    Ok(found.search.iterations)
                } else {
                    Err(format!(
                        "{start} {position:?}: elsewhere, {away:.3e} m, {turned:.3e}, {:.1e} g left",
                        found.search.residual
                    ))
                }
            }
            Err(error) => Err(format!("{start} {position:?}: {} {}", error.who.unwrap_or_default(), error.error)),
        });
    }
    list
}

/// None failed, and none took more steps than this.
fn check_steps(list: &[Result<usize, String>], bound: usize) {
    let failed: Vec<_> = list.iter().filter_map(|r| r.as_ref().err()).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    let most = list.iter().flatten().max();
    assert!(most.is_some_and(|m| *m <= bound), "{most:?} steps: more than {bound}");
}

#[test]
fn barge_on_eight_chains_converges_from_200_m_and_large_angles() {
    check_steps(&steps(&barge(), [140.0, 140.0, 10.0]), 20);
}

#[test]
fn load_in_four_slings_converges_from_distant_start() {
    check_steps(&steps(&hanging_load(), [15.0, 15.0, 10.0]), 36);
}
