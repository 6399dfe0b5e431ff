//! Members with marine growth, in a current that varies, and in runs: against larger tubes and closed forms.

use crate::common;
use crate::common::assert_share;
use crate::common::body_load::begin_step;
use crate::common::run as runs;

use nalgebra::{Matrix6, Vector3};
use runs::{settings, trapezoidal};
use std::f64::consts::{FRAC_PI_4, PI, TAU};
use std::sync::Arc;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::hull::{Solid, TubeHull};
use windlass_hydro::sea::{Component, Sea, Water};
use windlass_hydro::{BodyLoad, BodyStep, Category, Floating, growth_loads};
use windlass_model::{Model, Stretching};
use windlass_solve::time::RunSettings;

const RHO: f64 = 1025.0;
const G: f64 = 9.80665;

/// The model with a body B of which records are given, in an environment.
fn body(records: &str, pieces: &str, more: &str) -> Model {
    let (mut session, screen, _folder) = common::session();
    session.open(
        "records",
        format!(
            "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -WATER 1025\nMEDIT\n&DESCRIBE BODY B\n*A 0 0 -50\n*B 0 0 20\n*C 0 -30 -20\n*D 0 30 -20\n\
             {records}\nEND\n&SURFACE\n{pieces}\nEND\n{more}\n"
        ),
    );
    session.run();
    assert_eq!(session.errors, 0, "{:?} {}", session.reports, screen.text());
    session.job.model.clone()
}

fn sea(frequency: f64, number: f64, amplitude: f64) -> Arc<Sea> {
    let component = Component { frequency, number, amplitude, toward: [0.8, 0.6], phase: 0.0 };
    let water = Water { depth: None, level: 0.0, gravity: G, density: RHO };
    Arc::new(Sea::airy(vec![component], water, 0.0, Stretching::Wheeler))
}

fn force_at(load: &dyn BodyLoad, time: f64, pose: &Pose, velocity: &Six) -> Six {
    let ahead = BodyStep { time, dt: 0.0, pose, velocity };
    let state = begin_step(load, &ahead);
    load.dynamic_load(&ahead, &state).unwrap().load.wrench
}

fn members(model: &Model, sea: Option<&Arc<Sea>>) -> Box<dyn BodyLoad> {
    let floating = Floating::under_way(model, &model.bodies["B"], sea).unwrap();
    floating.loads.into_iter().find(|l| l.category() == Category::Wave).unwrap()
}

/// The drag of the current at rest.
fn drag(model: &Model) -> Six {
    let loads = Floating::at_rest(model, &model.bodies["B"]).unwrap().loads;
    let mine = loads.iter().filter(|l| l.category() == Category::ViscousDrag);
    mine.map(|l| l.mean_load(&Pose::default()).unwrap().wrench).sum()
}

/// Added mass without the growth's own.
fn added_mass(model: &Model) -> Matrix6<f64> {
    let body = &model.bodies["B"];
    Floating::at_rest(model, body).unwrap().added_mass - growth_loads::build_growth_loads(model, body).unwrap().mass
}

const PILE: &str = "-CD 0.8 -CDA 0.03 -CA 0.9 -CAA 0.6";

#[test]
fn pile_with_growth_has_drag_and_inertia_of_larger_pile() {
    let growth = "&DATA CURVES M_GROWTH G -90 300 90 300\n&ENV -CURRENT 1.2 90 -M_GROWTH G";
    let thin = body("", &format!("TUBE PILE *A *B 1500 {PILE}"), growth);
    let thick = body("", &format!("TUBE PILE *A *B 1800 {PILE}"), "&ENV -CURRENT 1.2 90");
    assert!((added_mass(&thin) - added_mass(&thick)).amax() <= 1e-9 * added_mass(&thick).amax());
    assert!((drag(&thin) - drag(&thick)).amax() <= 1e-12 * drag(&thick).amax());
    let sea = sea(0.9, 0.81 / G, 3.0);
    let (first, second) = (members(&thin, Some(&sea)), members(&thick, Some(&sea)));
    let leaning = Pose::from_place(&Place::new([1.0, 2.0, -1.0, 0.1, -0.2, 0.3]));
    let velocity = Six::new(0.5, -0.3, 0.2, 0.01, 0.02, 0.0);
    for pose in [Pose::default(), leaning] {
        for time in [0.0, 1.3, 4.0] {
            let (got, want) = (force_at(&*first, time, &pose, &velocity), force_at(&*second, time, &pose, &velocity));
            assert!((got - want).amax() <= 1e-12 * want.amax(), "{got} {want}");
        }
    }
}

#[test]
fn growth_on_part_of_pile_increases_diameter_there() {
    // 0.3 m more between 30 m and 10 m deep, and 0.6 m from there to the surface; ends are free at the foot alone
    let growth = "&DATA CURVES M_GROWTH G -30 300 -10 300 -9.9999999 600 20 600\n&ENV -CURRENT 1.5 180 -M_GROWTH G";
    let model = body("", &format!("TUBE PILE *A *B 1500 {PILE}"), growth);
    assert_share(drag(&model)[0], 0.5 * RHO * 0.8 * 2.25 * (50.0 * 1.5 + 20.0 * 0.3 + 10.0 * 0.6), 1e-7);
    let areas = FRAC_PI_4 * (20.0 * 1.5 * 1.5 + 20.0 * 1.8 * 1.8 + 10.0 * 2.1 * 2.1);
    assert_share(added_mass(&model)[(0, 0)], RHO * 0.9 * areas, 1e-7);
    assert_share(added_mass(&model)[(2, 2)], RHO * PI / 12.0 * 1.5f64.powi(3) * 0.6, 1e-9);
}

#[test]
fn tapering_growth_is_integrated_over_pile() {
    let growth = "&DATA CURVES M_GROWTH G -50 0 0 500 20 700\n&ENV -CURRENT 1.5 180 -M_GROWTH G";
    let model = body("", &format!("TUBE PILE *A *B 1000 {PILE}"), growth);
    // D = 1.5 + 0.01 z: of D the lengths have the exact mean, but that what cuts the surface goes on above it (0.01 m of 50);
    // of D2 one that is 0.02^2/12 = 3e-5 short
    assert_share(drag(&model)[0], 0.5 * RHO * 0.8 * 2.25 * 50.0 * 1.25, 1e-6);
    assert_share(added_mass(&model)[(0, 0)], RHO * 0.9 * FRAC_PI_4 * (1.5f64.powi(3) - 1.0) / 0.03, 4e-5);
}

#[test]
fn growth_in_rising_level_floats_like_larger_tube() {
    // a wave a thousand times round the earth: what members add to the buoyancy of tube and growth under the mean level
    let long = sea(1e-6, 1e-10, 1.7);
    let growth = "&DATA CURVES M_GROWTH G -90 600 90 600\n&ENV -M_GROWTH G";
    let model = body("", "TUBE PILE *A *B 2000", growth);
    let floating = Floating::under_way(&model, &model.bodies["B"], Some(&long)).unwrap();
    let mine = floating.loads.iter().filter(|l| l.category() != Category::Weight);
    let got: Six = mine.map(|l| force_at(l.as_ref(), 0.0, &Pose::default(), &Six::zeros())).sum();
    let tube = TubeHull { ends: [Vector3::new(0.0, 0.0, -50.0), Vector3::new(0.0, 0.0, 20.0)], diameter: 2.6 };
    assert_share(got[2], tube.wet(&Pose::default(), 1.7).load(RHO * G).wrench[2], 1e-7);
}

#[test]
fn member_uses_current_of_present_time() {
    let model = body(
        "",
        "TUBE PILE *A *B 2000 -CD 0.65",
        "&DATA CURVES C_HISTORY F 0 1 100 -0.5\n&ENV -CURRENT 1.5 180 -C_HISTORY F",
    );
    let want = 0.5 * RHO * 0.65 * 2.0 * 50.0 * 1.5 * 1.5;
    // statics has the current itself
    assert_share(drag(&model)[0], want, 1e-12);
    let load = members(&model, None);
    for (time, factor) in [(0.0, 1.0f64), (40.0, 0.4), (100.0, -0.5), (500.0, -0.5)] {
        assert_share(force_at(&*load, time, &Pose::default(), &Six::zeros())[0], want * factor * factor.abs(), 1e-12);
    }
    // half of a ramp: half of what the history changes
    let ramped = body(
        "",
        "TUBE PILE *A *B 2000 -CD 0.65",
        "&DATA CURVES C_HISTORY F 0 2 9 2\n&ENV -CURRENT 1.5 180 -C_HISTORY F -RAMP 60",
    );
    assert_share(force_at(&*members(&ramped, None), 30.0, &Pose::default(), &Six::zeros())[0], want * 1.5 * 1.5, 1e-12);
}

/// Time, place and velocity of one degree of freedom of the only body in a run by the trapezoidal rule.
fn run(model: &Model, (observed, dt): (f64, f64), dof: usize) -> Vec<[f64; 3]> {
    let settings = RunSettings { method: trapezoidal(), ..settings(observed, dt) };
    let run = runs::run(model, settings, vec![]);
    let first = run.history.layout.body(0) + dof;
    run.history.rows().map(|row| [row[0], row[first], row[first + 6]]).collect()
}

#[test]
fn plate_carried_by_current_approaches_its_speed() {
    // m dv/dt = k (U - v)^2 from rest: v = U - U / (1 + U k t / m)
    let records = "*E 0 -3 -9\n*F 0 3 -9\n*G 0 3 -11\n*H 0 -3 -11\n#PLATE *E *F *G *H -CD 1.2 -FLUID WATER\n\
                   *W 0 0 -10\n#WEIGHT *W 980.665 1 1 1\n&DESCRIBE BODY B -IGNORE Y Z RX RY RZ";
    let model = body(records, "", "&ENV -CURRENT 2 180");
    let (current, mass, k) = (2.0, 1e5, 0.5 * RHO * 1.2 * 12.0);
    let rows = run(&model, (400.0, 0.1), 0);
    for [t, _, v] in &rows {
        let want = current - current / (1.0 + current * k * t / mass);
        // the trapezoidal rule: (k U dt / m)^2 = 2e-4, a twelfth of it a step where the force changes
        assert!((v - want).abs() < 1e-4 * current, "{t} {v} {want}");
    }
    // 1 + 59 of it are left behind
    assert!(rows.last().unwrap()[2] > 0.98 * current);
}

#[test]
fn level_tube_sinks_to_its_terminal_velocity() {
    // (m + a) dv/dt = F - c v^2: v = sqrt(F/c) tanh(t sqrt(F c) / (m + a)), F being the weight in water
    let (long, diameter, ca) = (60.0, 1.0f64, 0.7);
    let displaced = RHO * FRAC_PI_4 * diameter * diameter * long;
    let mass = 1.5 * displaced;
    let records = format!("*W 0 0 -20\n#WEIGHT *W {:.9} 1 1 1\n&DESCRIBE BODY B -IGNORE X Y RX RY RZ", mass * G / 1e3);
    let tube = |more: &str| body(&records, &format!("TUBE T *C *D 1000 -CA {ca} {more}"), "");
    let (force, c) = (0.5 * displaced * G, 0.5 * RHO * 1.1 * diameter * long);
    let speed = (force / c).sqrt();
    // the drag of the tube by its coefficient; or by the area that it shows, of a prism within 0.1 % of the tube's width
    for (model, tolerance) in [(tube("-CD 1.1"), 1e-4), (tube("-CS_CURRENT 0 0 1.1"), 1e-3)] {
        let rows = run(&model, (20.0, 0.02), 2);
        for [t, _, v] in &rows {
            let want = -speed * (t * (force * c).sqrt() / (mass + ca * displaced)).tanh();
            assert!((v - want).abs() < tolerance * speed, "{t} {v} {want}");
        }
        assert!(rows.last().unwrap()[2] < -0.99 * speed);
    }
}

#[test]
fn spar_heave_in_still_water_has_its_period_and_gains_no_energy() {
    let (draft, diameter, friction, start) = (50.0, 10.0f64, 0.5, 0.5);
    let stiffness = RHO * G * FRAC_PI_4 * diameter * diameter;
    let mass = stiffness * draft / G;
    let end = RHO * PI / 12.0 * diameter.powi(3) * 0.64;
    let records =
        format!("*W 0 0 -30\n#WEIGHT *W {:.12} 10 10 10\n&DESCRIBE BODY B -IGNORE X Y RX RY RZ", mass * G / 1e3);
    let more = format!("&INSTATE -LOCATE B 0 0 {start}");
    let model = body(&records, &format!("TUBE S *A *B 10000 -CAA 0.64 -CDA {friction}"), &more);
    let whole = mass + end;
    let period = TAU * (whole / stiffness).sqrt();
    let rows = run(&model, (10.0 * period, period / 200.0), 2);
    let energy = |[_, z, v]: &[f64; 3]| 0.5 * whole * v * v + 0.5 * stiffness * z * z;
    let first = energy(&rows[0]);
    for pair in rows.windows(2) {
        // what Newton's iteration leaves
        assert!(energy(&pair[1]) <= energy(&pair[0]) + 1e-9 * first, "{pair:?}");
    }
    // passages through the water upward
    let mut passages = Vec::new();
    for pair in rows.windows(2) {
        let ([t0, z0, _], [t1, z1, _]) = (pair[0], pair[1]);
        if z0 < 0.0 && z1 >= 0.0 {
            passages.push(t0 + (t1 - t0) * z0 / (z0 - z1));
        }
    }
    let cycles = passages.len() - 1;
    // the rule makes a period (w h)^2/12 = 8e-5 longer; friction of second degree changes it in the second order
    assert_share((passages[cycles] - passages[0]) / cycles as f64, period, 2e-4);
    // m x" + c |x'| x' + k x = 0 loses 4/3 c/m A^2 each half cycle [FALTINSEN-1990 7.1], so that 1/A grows by 8/3 c/m a cycle
    let c = 0.5 * RHO * friction * PI * diameter * draft;
    let last = (energy(rows.last().unwrap()) * 2.0 / stiffness).sqrt();
    let want = 1.0 / (1.0 / start + 10.0 * 8.0 / 3.0 * c / whole);
    // the wet length differs by z/draft = 1 %, and the formula is of first order in what is lost, 1 % a half cycle
    assert_share(last, want, 5e-3);
    assert!(last < 0.9 * start);
}

#[test]
fn member_wetted_by_waves_converges_with_second_order() {
    // a column through the surface in waves of 6 m: its wet added mass changes by a tenth, against waves that go on
    let records = "*W 0 0 -30\n#WEIGHT *W 25263 10 10 10\n&DESCRIBE BODY B -IGNORE Y RX RY RZ";
    let sea = "&ENV -DEPTH 345 -SEA STOKES 180 6 10 -STRETCHING EXPONENTIAL -RAMP 0";
    let model = body(records, "TUBE S *A *B 8000 -CD 0 -CA 1", sea);
    let position = |dt: f64| {
        let run = runs::run(&model, settings(20.0, dt), vec![]);
        let at = run.history.layout.body(0);
        let row = run.history.rows().last().unwrap();
        [row[at], row[at + 2]]
    };
    let [coarse, middle, fine] = [0.1, 0.05, 0.025].map(position);
    for dof in 0..2 {
        let [first, second] = [(coarse, middle), (middle, fine)].map(|(a, b)| (a[dof] - b[dof]).abs());
        // 4 of the second order, 2 of the first; and what is left is small
        assert!(first / second > 3.0 && second < 5e-3, "{dof}: {first} {second}");
    }
}
