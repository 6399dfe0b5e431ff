//! Steps whose end is foretold by stiffness and damping end where steps do that are solved to the last digit, with one evaluation.

#[path = "../../../benches/eight/mod.rs"]
mod eight;
#[path = "../../../benches/measured/mod.rs"]
mod measured;

use std::f64::consts::PI;
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::Category;
use windlass_model::{Model, TimeStep};
use windlass_solve::System;
use windlass_solve::time::{
    BodyForces, BodyMotion, Ending, LoadMemory, Method, Run, RunRequirements, RunSettings, SilentWatcher, StepTolerance,
};

const GRAVITY: f64 = 9.80665;
const MASS: f64 = 2.0 / 3.0 * PI * 27000.0 * 1025.0;
const GYRATION: f64 = 19.0;

/// A hemisphere of 30 m radius on eight lines, with the memory of its radiation, away from rest; in an irregular sea or without.
fn moored_hemisphere(sea: bool) -> Model {
    let weight = MASS * GRAVITY;
    let hull = format!(
        "*CG 0 0 -12\n#WEIGHT *CG {weight} {GYRATION} {GYRATION} {GYRATION}\n#DAMP *CG 1E6 1E6 2E7 3E9 3E9 3E8\n\
         DATABASE SHIP -WAMIT {}/tests/data/hemisphere/wamit -ULEN 3 -SYMMETRIC -MEMORY 30 -HYDROSTATICS YES\n",
        env!("CARGO_MANIFEST_DIR")
    );
    let line = |rest: &str| format!("~CHAIN B_CAT 180 -LEN 900 -DEP 300 {rest}\n");
    let waves = if sea { "-SEA JONSWAP 150 5 11 -RAMP 50" } else { "" };
    eight::model(&hull, &line, &format!("&ENV -DEPTH 300 {waves}\n&INSTATE -LOCATE SHIP 5 2 0 0 0 1\n"))
}

fn run(model: &Model, observed: f64, tolerance: f64) -> Run {
    let settings = RunSettings {
        observed,
        dt: 0.1,
        method: Method::default(),
        convergence: StepTolerance { tolerance, ..StepTolerance::default() },
        store: 1,
        capsize: true,
        adaptive: None,
        keep: true,
        along: 1,
        balance: false,
        transient: 0.0,
    };
    let mut run = Run::new(model, settings, Vec::new()).unwrap();
    assert_eq!(run.run(&mut SilentWatcher), Ok(Ending::Done));
    run
}

#[test]
fn predicted_steps_follow_fully_solved_steps_for_moored_body() {
    let model = moored_hemisphere(true);
    let (usual, tight) = (run(&model, 200.0, 1e-7), run(&model, 200.0, 1e-12));
    let at = usual.history.layout.body(0);
    let (mut most, mut reach) = (0.0f64, 0.0f64);
    for (row, other) in usual.history.rows().zip(tight.history.rows()) {
        for dof in 0..6 {
            let lever = if dof < 3 { 1.0 } else { GYRATION };
            most = most.max(lever * (row[at + dof] - other[at + dof]).abs());
            reach = reach.max(lever * row[at + dof].abs());
        }
    }
    // 1e-7 g left in every step and always the same way would be 0.02 m after 200 s; what is left has its sign by chance and goes
    // with the next step
    assert!(most < 1e-6 && reach > 1.0, "{most:e} m of {reach} m");
    let counts = usual.counts;
    assert!(counts.evaluations as f64 <= 1.05 * counts.steps as f64, "{counts:?}");
}

#[test]
fn reported_predicted_step_balances_within_tolerance() {
    let tolerance = 1e-7;
    let made = run(&moored_hemisphere(true), 100.0, tolerance);
    let layout = &made.history.layout;
    for row in made.history.rows() {
        for dof in 0..6 {
            let forces = Category::ALL.into_iter().filter_map(|c| layout.category(0, c));
            let left: f64 = forces.map(|at| row[at + dof]).sum();
            // of the body's mass alone, less than that of the water with it; forces of 1e9 N rounded are 1e-6 N
            let allowed = tolerance * GRAVITY * MASS * if dof < 3 { 1.0 } else { GYRATION };
            assert!(left.abs() <= allowed, "{} s: {left:e} of {allowed:e} in {dof}", row[0]);
        }
    }
}

#[test]
fn prediction_in_still_water_adds_no_evaluations() {
    let counts = run(&moored_hemisphere(false), 200.0, 1e-7).counts;
    // the trial goes on as the acceleration changed last; most of these are near enough
    assert!(counts.evaluations as f64 <= 1.13 * counts.steps as f64, "{counts:?}");
    assert!(counts.iterations <= counts.steps, "{counts:?}");
}

#[test]
fn damping_rotating_with_body_is_in_its_stiffness() {
    let weight = 1e5 * GRAVITY;
    let line = |rest: &str| format!("~CHAIN B_CAT 180 -LEN 900 -DEP 300 {rest}\n");
    let hull = format!("*CG 3 -2 5\n#WEIGHT *CG {weight} 4 5 6\n#DAMP *CG 1E4 3E4 2E4 3E6 1E6 5E6\n");
    let mut model = eight::model(&hull, &line, "");
    model.connectors.clear();
    let system = System::under_way(&model, None::<&Arc<_>>, RunRequirements::default()).unwrap();
    let memory = LoadMemory::new(&system);
    let pose = Pose::default().after_motion(&Six::new(1.0, 2.0, -1.0, 0.4, -0.7, 1.1));
    let start = BodyMotion { pose, velocity: Six::new(1.0, 2.0, -1.0, 0.3, -0.5, 0.2), ..BodyMotion::default() };
    let at = |motion: BodyMotion| {
        let mut forces = BodyForces::default();
        forces.evaluate(&system, &memory, &[motion], TimeStep { time: 0.0, dt: 0.0 }).unwrap();
        forces
    };
    let whole = at(start);
    for n in 0..6 {
        let mut by = Six::zeros();
        by[n] = 1e-5;
        let turned = |by: Six| at(BodyMotion { pose: pose.after_motion(&by), ..start }).sum;
        let faster = |by: Six| at(BodyMotion { velocity: start.velocity + by, ..start }).sum;
        let stiffness = (turned(-by) - turned(by)) / 2e-5 - whole.stiffness.column(n);
        let damping = (faster(-by) - faster(by)) / 2e-5 - whole.damping.column(n);
        // forces of 1e7: rounded 1e-9, over 1e-5; the third derivative 1e7 times 1e-10
        assert!(stiffness.amax() < 1e-2 && damping.amax() < 1e-2, "{n}: {stiffness} {damping}");
    }
    // rotations meet a moment of 5e6 * 0.5
    assert!(whole.stiffness.view((3, 3), (3, 3)).amax() > 1e5);
}
