//! Lines over pulleys and off winch drums: rope on a pulley, two-part fall, drum under a weight, against closed forms; metres and newtons.
//!
//! A span of H_CAT without EXACT is straight and weightless: one tension T stretches all spans of one EA, `D = L (1 + T/EA)` with the
//! sum D of their distances.

use crate::common::assert_share;
use crate::common::run::{model, model_as_written, run, settings};
use windlass_base::pose::Six;
use windlass_model::{Model, Situation};
use windlass_solve::time::Run;
use windlass_solve::{EquilibriumOptions, System, SystemState, find_equilibrium_with_rebuilds};

/// AE of 100 mm of the default steel (N).
const EA: f64 = 29000.0 * 6894757.293168361 * std::f64::consts::FRAC_PI_4 * 0.01;
const G: f64 = 9.80665;

fn settled(records: &str) -> Model {
    let mut model = model(records);
    let found = find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap();
    assert!(found.found.search.residual < 1e-9, "{:?}", found.found);
    model
}

fn tension(model: &Model, name: &str) -> f64 {
    let connector = model.connectors.get(name).unwrap();
    let ends: Vec<_> = model.element_ends(connector).into_iter().map(windlass_model::End::at_rest).collect();
    let surroundings = model.surroundings();
    let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
    let element = model.element(connector).unwrap();
    element.summary(&at, &vec![0.0; element.states()]).unwrap().tension.unwrap()
}

fn position(model: &Model) -> [f64; 6] {
    model.bodies["B"].position.values()
}

/// A weight on a rope from the ground over a pulley 20 m up, 1e6 N.
fn rope(lengths: [f64; 2], more: &str) -> String {
    let [first, second] = lengths;
    format!(
        "MEDIT\n*A -30 0 10\n*P 0 0 20\n&DESCRIBE BODY B -IGNORE RX RY RZ\n*W 0 0 0\n#WEIGHT *W 1E6 1 1 1\n~R1 H_CAT 100 -LEN {first}\n\
         ~R2 H_CAT 100 -LEN {second}\nCONNECTOR S1 ~R1 *A *P\nCONNECTOR S2 ~R2 *P *W\nASSEMBLY PULLEY ROPE S1 S2\n{more}END\n&INSTATE -LOCATE B 0 0 8"
    )
}

#[test]
fn rope_over_pulley_has_one_tension_and_shares_its_length() {
    // 30 m aside and 10 m up to the pulley; what is over of 50 m, however it is divided, hangs under it with the stretch of all
    let aside = 1000f64.sqrt();
    for lengths in [[31.0, 19.0], [10.0, 40.0], [49.0, 1.0]] {
        let made = settled(&rope(lengths, ""));
        let hangs = 50.0 * (1.0 + 1e6 / EA) - aside;
        for (got, want) in position(&made).iter().zip([0.0, 0.0, 20.0 - hangs]) {
            assert!((got - want).abs() < 1e-9 * hangs, "{got} {want}");
        }
        for name in ["S1", "S2"] {
            assert_share(tension(&made, name), 1e6, 1e-9);
        }
    }
}

#[test]
fn unlike_spans_share_length_by_their_stiffness() {
    // 100 mm on one side and 50 mm on the other, a quarter of its EA: l1 = 31.62 / (1 + T/EA), and the rest of 50 m stretches by 4 T/EA
    let made = settled(&rope([30.0, 20.0], "").replace("~R2 H_CAT 100", "~R2 H_CAT 50"));
    let aside = 1000f64.sqrt() / (1.0 + 1e6 / EA);
    assert_share(20.0 - position(&made)[2], (50.0 - aside) * (1.0 + 4e6 / EA), 1e-9);
}

#[test]
fn two_part_fall_bears_half_its_load_in_each_part() {
    // a block on a rope between anchors at unlike heights: both parts have one tension, so that they lean alike
    let (whole, spread, heights) = (80.0, 6.0, [40.0, 42.0]);
    let pull = 0.001 * EA;
    let stretched = whole * 1.001;
    let sine: f64 = spread / stretched;
    let cosine = (1.0 - sine * sine).sqrt();
    let load = 2.0 * pull * cosine;
    let records = format!(
        "MEDIT\n*A 0 3 40\n*C 0 -3 42\n&DESCRIBE BODY B -IGNORE RX RY RZ\n*W 0 0 0\n#WEIGHT *W {load} 1 1 1\n~R H_CAT 100 -LEN 40\n\
         CONNECTOR S1 ~R *A *W\nCONNECTOR S2 ~R *W *C\nASSEMBLY PULLEY FALL S1 S2\nEND\n&INSTATE -LOCATE B 0 0.4 2"
    );
    let made = settled(&records);
    let z = 0.5 * (heights[0] + heights[1] - stretched * cosine);
    let y = 3.0 - (heights[0] - z) * sine / cosine;
    let [_, got_y, got_z, ..] = position(&made);
    assert!((got_y - y).abs() < 1e-8 && (got_z - z).abs() < 1e-8, "{got_y} {y} {got_z} {z}");
    for name in ["S1", "S2"] {
        assert_share(tension(&made, name), pull, 1e-8);
        assert_share(tension(&made, name), 0.5 * load, 0.003);
    }
}

/// A vessel whose mooring wire runs from a winch on deck over a fairlead to an anchor.
fn moored(lengths: [f64; 2]) -> String {
    let [deck, line] = lengths;
    format!(
        "&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY B\n*D -20 3 12\n*F 0 0 8\n#WEIGHT *D 1E6 5 5 5\n~W H_CAT 100 -LEN {deck}\n\
         ~C B_CAT 100 -LEN {line} -DEPANCHOR 100 -WTPLEN 0.06\nCONNECTOR S1 ~W *D *F\nCONNECTOR S2 ~C -ANCHOR 0 400 *F\nASSEMBLY PULLEY M S1 S2\nEND"
    )
}

#[test]
fn mooring_line_over_fairlead_has_tension_of_wire_behind_it() {
    let made = model(&moored([25.0, 420.0]));
    let pull = tension(&made, "S1");
    assert_share(tension(&made, "S2"), pull, 1e-9);
    // the wire keeps its distance less its stretch, and the line has what it leaves: a plain B_CAT of that length has that tension
    let apart = (20f64.powi(2) + 3f64.powi(2) + 4f64.powi(2)).sqrt();
    let left = 445.0 - apart / (1.0 + pull / EA);
    let plain = model(&moored([25.0, left]).replace("ASSEMBLY PULLEY M S1 S2\n", ""));
    assert_share(tension(&plain, "S2"), pull, 1e-9);
}

/// The residual of a model with its body moved.
fn residual(model: &Model, motion: &Six) -> (Six, nalgebra::Matrix6<f64>) {
    let system = System::new(model, &[]).unwrap();
    let mut state: SystemState = system.state(model);
    let turn = nalgebra::Rotation3::new(motion.fixed_rows::<3>(3).into_owned());
    state.poses[0].origin += motion.fixed_rows::<3>(0);
    state.poses[0].axes = turn.matrix() * state.poses[0].axes;
    system.evaluate(&mut state).unwrap();
    (state.residual.fixed_rows::<6>(0).into_owned(), state.stiffness.fixed_view::<6, 6>(0, 0).into_owned())
}

#[test]
fn stiffness_of_lines_over_pulleys_is_difference_of_force() {
    let across = "MEDIT\n*A 0 3 40\n*C 5 -3 42\n&DESCRIBE BODY B\n*W 1 2 3\n*V -4 1 2\n#WEIGHT *W 1E6 1 1 1\n~R H_CAT 100 -LEN 40\n~S H_CAT 60 -LEN 30\n\
                  CONNECTOR S1 ~R *A *W\nCONNECTOR S2 ~S *W *C\nCONNECTOR S3 ~R *C *V\nASSEMBLY PULLEY FALL S1 S2 S3\nEND\n";
    for (records, tolerance) in [(across.to_string(), 1e-6), (moored([25.0, 400.0]), 1e-5)] {
        let made = model(&records);
        let (_, exact) = residual(&made, &Six::zeros());
        let mut differences = nalgebra::Matrix6::zeros();
        for column in 0..6 {
            let mut step = Six::zeros();
            step[column] = 1e-5;
            let change = residual(&made, &step).0 - residual(&made, &-step).0;
            differences.set_column(column, &(-change / 2e-5));
        }
        let size = differences.amax();
        assert!((exact - differences).amax() < tolerance * size, "{exact} {differences}");
    }
}

#[test]
fn span_that_does_not_act_lets_the_line_go() {
    let made = model(&rope([31.0, 19.0], "&CONNECTOR S1 -INACTIVE\n"));
    let (force, _) = residual(&made, &Six::zeros());
    assert_share(force[2], -1e6, 1e-12);
}

/// A weight of 1e6 N that hangs 20 m under a drum of 5e4 N, 0.8 m gyradius and 0.5 m radius.
fn winch(more: &str, curves: &str) -> String {
    format!(
        "{curves}MEDIT\n*P 0 0 20\n&DESCRIBE BODY B -IGNORE RX RY RZ\n*W 0 0 0\n#WEIGHT *W 1E6 1 1 1\n~R H_CAT 100 -LEN 20\nCONNECTOR S ~R *P *W\n\
         ASSEMBLY WINCH W S {more}\n&INSTATE -LOCATE B 0 0 {}\n",
        -20.0 * 1e6 / EA
    )
}

fn ran(records: &str, time: f64) -> Run {
    run(&model(records), settings(time, 0.01), Vec::new())
}

/// How far the body has risen at the end of a run, and the tension of the line.
fn end(run: &Run) -> [f64; 2] {
    let layout = &run.history.layout;
    let height = |row: &[f64]| row[layout.body(0) + 2];
    let (first, last) = (run.history.rows().next().unwrap(), run.history.rows().last().unwrap());
    [height(last) - height(first), layout.tension(0, last).unwrap()]
}

/// Mass, inertia over the square of the radius (kg), and the radius.
const MASS: f64 = 1e6 / G;
const DRUM: f64 = 5e4 / G * 0.64 / 0.25;
const RADIUS: f64 = 0.5;

#[test]
fn drum_with_slipping_brake_accelerates_by_its_inertia() {
    // m a = m g - T and (I/R2) a = T - D/R; the stretch of the rope at the start, 20 m W/EA = 0.013 m, goes and swings
    for (brake, dynamic, within) in [(0.0, 0.0, 0.03), (4.95e5, 4.9e5, 1e-3)] {
        let made = ran(&winch(&format!("-WINCH 5E4 0 {brake} {dynamic} 500 0.8 0.5\nEND"), ""), 2.0);
        let a = (1e6 - dynamic / RADIUS) / (MASS + DRUM);
        let [z, _] = end(&made);
        assert!((z + 0.5 * a * 4.0).abs() < within, "{z} {}", -2.0 * a);
    }
}

#[test]
fn brake_holds_up_to_its_static_moment() {
    let made = ran(&winch("-WINCH 5E4 0 5.1E5 0 500 0.8 0.5\nEND", ""), 2.0);
    assert!(end(&made)[0].abs() < 1e-4, "{:?}", end(&made));
}

#[test]
fn line_on_drum_is_all_that_is_paid_out() {
    let made = ran(&winch("-WINCH 5E4 0 0 0 3 0.8 0.5\nEND", ""), 1.0);
    // it has fallen 3 m by then, at v^2 = 2 a 3, and the drum stands: the weight is caught by 23 m of rope, from its slack length on by
    // s + sqrt(s^2 + v^2 m L/EA) with s = W L/EA
    let (a, catch) = (1e6 / (MASS + DRUM), 23.0 / EA);
    let (still, start) = (1e6 * catch, 20.0 * 1e6 / EA);
    let deepest = 3.0 - start + still + (still * still + 6.0 * a * MASS * catch).sqrt();
    let at = made.history.layout.body(0) + 2;
    let lowest = made.history.rows().map(|row| row[at] + start).fold(0.0, f64::min);
    // the rope swings by its stretch while the drum turns, and steps of 0.01 s of a period of 0.24 s miss the lowest point
    assert!((lowest + deepest).abs() < 0.03, "{lowest} {deepest}");
}

#[test]
fn motor_hauls_in_with_its_share_of_torque() {
    let records = winch("-WINCH 5E4 1E6 0 0 500 0.8 0.5\nEND\n&CONNECTOR W -L_DYNAMIC MOTOR 0.6", "");
    let a = (0.6 * 1e6 / RADIUS - 1e6) / (MASS + DRUM);
    let [z, _] = end(&ran(&records, 2.0));
    assert!((z - 0.5 * a * 4.0).abs() < 0.01, "{z} {}", 2.0 * a);
}

#[test]
fn rate_and_length_curves_pay_out_their_integral() {
    // 0.4 m/s times a factor that rises over 5 s to 1 and stays: 0.4 (2.5 + 5) = 3 m after 10 s
    let rate = winch("-VELOCITY V 0.4\nEND", "&DATA CURVES LT_MULTIPLIER V 0 0 5 1 100 1\n");
    let [z, pull] = end(&ran(&rate, 10.0));
    // what is paid out hangs with the stretch of all
    assert!((z + 3.0 * (1.0 + 1e6 / EA)).abs() < 3e-4, "{z}");
    assert_share(pull, 1e6, 0.02);
    // the same length as a curve, twice; and up to where 21 m hang
    let curves = "&DATA CURVES LT_MULTIPLIER V 0 0 5 0\n&DATA CURVES CT_LENGTH C 0 0 5 0.5 10 1.5\n";
    for (how, want) in [("C 2", 3.0), ("C 2 21", 1.0)] {
        let records = winch(&format!("-VELOCITY V 1\nEND\n&CONNECTOR S -L_DYNAMIC {how}"), curves);
        let [z, _] = end(&ran(&records, 10.0));
        // a stop at a speed lets the weight swing: v sqrt(m L/EA) = 0.4 x 0.037
        let swing = if want == 1.0 { 0.02 } else { 0.01 };
        assert!((z + want).abs() < swing, "{how} {z}");
    }
}

#[test]
fn units_of_winches_follow_the_unit_system() {
    let metric = model(&winch("-WINCH 5E4 1E6 2E5 1E5 500 0.8 0.5\nEND", ""));
    let records = "&DIMEN -DIMEN FEET KIPS\nMEDIT\n*P 0 0 65.616798\n&DESCRIBE BODY B\n*W 0 0 0\n~R H_CAT 4 -LEN 65\nCONNECTOR S ~R *P *W\n\
                   ASSEMBLY WINCH W S -WINCH 11.240447 737.562149 147.51243 73.7562149 1640.41995 2.624672 1.640420\nEND\n";
    let english = model_as_written(records);
    let drum = |model: &Model| match &model.assemblies["W"].kind {
        windlass_model::AssemblyKind::Winch { drum, .. } => drum.clone(),
        other => panic!("{other:?}"),
    };
    let (a, b) = (drum(&metric), drum(&english));
    for (got, want) in [
        (a.inertia, 5e4 / G * 0.64),
        (b.inertia, 5e4 / G * 0.64),
        (b.max_torque, 1e6),
        (b.static_brake, 2e5),
        (b.dynamic_brake, 1e5),
        (b.stored, 500.0),
        (b.radius, 0.5),
    ] {
        assert_share(got, want, 1e-6);
    }
}

#[test]
fn mooring_line_on_drum_has_tension_of_its_new_length() {
    // a body that is held; 6 m are paid out in 10 s, and a B_CAT of that length has the tension
    let records = |length: f64, winch: &str| {
        format!(
            "&DATA CURVES LT_MULTIPLIER V 0 1 100 1\n&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY B -IGNORE X Y Z RX RY RZ\n*F 0 0 8\n#WEIGHT *F 1E6 5 5 5\n\
             ~C B_CAT 100 -LEN {length} -DEPANCHOR 100 -WTPLEN 0.06\nCONNECTOR S ~C -ANCHOR 0 400 *F\n{winch}END\n"
        )
    };
    let wound = run(&model(&records(420.0, "ASSEMBLY WINCH W S -VELOCITY V 0.6\n")), settings(10.0, 0.1), Vec::new());
    let plain = tension(&model(&records(426.0, "")), "S");
    assert_share(end(&wound)[1], plain, 1e-9);
}
