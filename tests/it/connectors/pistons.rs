//! Pistons, dashpots and viscoelastic springs of lines against numbers worked out by hand from [MOSES-FLEX -PISTON, -X_DAMPING, -CONVOLUTION].

use crate::common;

use nalgebra::Vector3;
use windlass::session::Session;
use windlass_base::pose::{Pose, Six};
use windlass_model::{ConnectorElement, ConnectorResponse, ConnectorSummary, End, Situation, SolverCache, TimeStep};

/// A line between *A of body ONE at the origin and another end.
struct PistonRig {
    session: Session,
    element: Box<dyn ConnectorElement>,
    /// Committed.
    state: Vec<f64>,
    /// Where the first end is and where the second.
    ends: [Vector3<f64>; 2],
}

/// EA = 1E6 N; of 100 m: 1E4 N/m.
const SPRING: &str = "100 TENSION -LEN 100 -EMOD 400/3.14159265358979323846";

impl PistonRig {
    fn new(class: &str, connector: &str, second: [f64; 3]) -> PistonRig {
        let (mut session, screen, _folder) = common::session();
        let [x, y, z] = second;
        let text = format!(
            "&DIMEN -DIMEN METERS N\n&ENV -DEPTH 200\n&DATA CONVOLUTION TIME SOFT 0 5E4 400 2E4 -NDOF 1\nMEDIT\n\
             &DESCRIBE BODY ONE\n*A 0 0 -5\n&DESCRIBE BODY TWO\n*B {x} {y} {z}\n~C {class}\nCONNECTOR IT {connector}\nEND\n"
        );
        session.open("records", text);
        session.run();
        assert_eq!(session.errors, 0, "{class}: {:?} {}", session.reports, screen.text());
        let model = &session.job.model;
        let connector = model.connectors.values().next().unwrap();
        let element = model.element(connector).unwrap();
        let ends = model.end_poses(connector).map(|p| p.origin);
        let mut state = vec![0.0; element.states()];
        element.start(&mut state);
        PistonRig { session, element, state, ends }
    }

    /// A spring of 1E4 N/m and 100 m along X.
    fn spring(options: &str) -> PistonRig {
        PistonRig::new(&format!("SL_ELEM {SPRING} {options}"), "~C *A *B", [100.0, 0.0, -5.0])
    }

    /// The answer with the second end moved along X from where it was defined, with a velocity.
    fn evaluate_at(&self, moved: f64, speed: f64, dt: Option<f64>) -> (ConnectorResponse, Vec<f64>) {
        let [first, second] = self.ends;
        let there = [
            End::at_rest(Pose::from_position(first.into())),
            End::at_rest(Pose::from_position((second + Vector3::x() * moved).into())),
        ];
        let velocity = Six::new(speed, 0.0, 0.0, 0.0, 0.0, 0.0);
        self.answer([there[0], End { velocity, ..there[1] }], dt)
    }

    fn answer(&self, ends: [End; 2], dt: Option<f64>) -> (ConnectorResponse, Vec<f64>) {
        let surroundings = self.session.job.model.surroundings();
        let step = dt.map(|dt| TimeStep { time: dt, dt });
        let (mut out, mut trial) = (ConnectorResponse::default(), vec![f64::NAN; self.state.len()]);
        let at = Situation { ends: &ends, step, surroundings: &surroundings };
        self.element.evaluate(&at, &self.state, &mut trial, &mut SolverCache::new(), &mut out).unwrap();
        (out, trial)
    }

    fn summary(&self, moved: f64) -> ConnectorSummary {
        let surroundings = self.session.job.model.surroundings();
        let [first, second] = self.ends;
        let ends = [first, second + Vector3::x() * moved].map(|p| End::at_rest(Pose::from_position(p.into())));
        self.element.summary(&Situation { ends: &ends, step: None, surroundings: &surroundings }, &self.state).unwrap()
    }

    /// Tension after a step to a place, which is committed.
    fn step(&mut self, moved: f64, dt: f64) -> f64 {
        let (out, trial) = self.evaluate_at(moved, 0.0, Some(dt));
        self.state = trial;
        out.wrench[0][0]
    }

    /// Tension and position of the piston at rest.
    fn rest(&self, moved: f64) -> (f64, f64) {
        let (out, trial) = self.evaluate_at(moved, 0.0, None);
        (out.wrench[0][0], trial[0])
    }
}

fn assert_near(got: f64, want: f64) {
    assert!((got - want).abs() <= 1e-8 * want.abs().max(1.0), "{got} is not {want}");
}

/// LT 3 m, LD 1 m, lengthening 0.5 m/s, shortening 0.25 m/s, TMAX 8000 N, TMIN 2000 N.
const MINMAX: &str = "-PISTON MINMAX 3000 1000 0.5 0.25 8000 2000";
const MAX: &str = "-PISTON MAX 3000 1000 0.5 0.25 8000";

#[test]
fn slow_pull_raises_tension_to_tmax_while_piston_extends() {
    let mut rig = PistonRig::spring(MAX);
    // 0.4 m/s in steps of 0.1 s: 400 N a step; TMAX after 20 steps, then the piston goes 0.04 m a step
    for i in 1..=60 {
        let moved = 0.04 * f64::from(i);
        let tension = rig.step(moved, 0.1);
        assert_near(tension, (1e4 * moved).min(8000.0));
        assert_near(rig.state[0], 1.0 + (moved - 0.8).max(0.0));
    }
}

#[test]
fn pull_faster_than_piston_exceeds_tmax_by_speed_difference() {
    let mut rig = PistonRig::spring(MAX);
    // 0.8 m/s: TMAX after 1 s; then 0.3 m/s are left to the spring, 300 N a step, until the piston, 2 m further and 4 s later, stops
    for i in 1..=70 {
        let (t, moved) = (0.1 * f64::from(i), 0.08 * f64::from(i));
        let tension = rig.step(moved, 0.1);
        let piston = (0.5 * (t - 1.0)).clamp(0.0, 2.0);
        assert_near(rig.state[0], 1.0 + piston);
        assert_near(tension, 1e4 * (moved - piston));
        // it lags or has stopped: the spring is as stiff as ever
        if t > 1.05 {
            assert_near(rig.evaluate_at(moved + 0.08, 0.0, Some(0.1)).0.stiffness[0][(0, 0)], 1e4);
        }
    }
}

#[test]
fn max_piston_returns_to_nominal_and_never_exceeds_tmax() {
    let mut rig = PistonRig::spring(MAX);
    rig.state[0] = 2.0;
    // let go at once: 0.25 m/s back, 4 s to LD, and no shorter
    for i in 1..=50 {
        assert_near(rig.step(0.2, 0.1), (1e4 * (0.2 - (rig.state[0] - 1.0))).max(0.0));
        assert_near(rig.state[0], (2.0 - 0.025 * f64::from(i)).max(1.0));
    }
    // stretched by 1.5 m it holds TMAX at 0.7 m beyond LD, though it could go further back
    rig.state[0] = 1.72;
    assert_near(rig.step(1.5, 0.1), 8000.0);
    assert_near(rig.state[0], 1.7);
}

#[test]
fn minmax_piston_keeps_tension_between_both_limits() {
    let mut rig = PistonRig::spring(MINMAX);
    // 5000 N, then relaxed at 0.2 m/s: TMIN after 1.5 s, held from there by shortening to 0 another 5 s later; then slack
    assert_near(rig.step(0.5, 0.1), 5000.0);
    assert_near(rig.state[0], 1.0);
    for i in 1..=90 {
        let moved = 0.5 - 0.02 * f64::from(i);
        let piston = (1.0 - (0.2 - moved).max(0.0)).max(0.0);
        assert_near(rig.step(moved, 0.1), (1e4 * (moved + 1.0 - piston)).max(0.0));
        assert_near(rig.state[0], piston);
    }
    // pulled again it stays at 0 up to TMAX: 8000 N at -0.2 m, and then lengthens at once
    for i in 0..=30 {
        let moved = -1.0 + 0.04 * f64::from(i);
        assert_near(rig.step(moved, 0.1), (1e4 * (moved + 1.0)).min(8000.0));
        assert_near(rig.state[0], (moved + 0.2).max(0.0));
    }
}

#[test]
fn release_faster_than_piston_drops_below_tmin_and_recovers() {
    let mut rig = PistonRig::spring(MINMAX);
    // held at 0.1 m, 1000 N: 0.025 m a step, 250 N, up to 2000 N
    for i in 1..=6 {
        assert_near(rig.step(0.1, 0.1), (1000.0 + 250.0 * f64::from(i)).min(2000.0));
    }
}

#[test]
fn monotone_pull_gives_monotone_tension_at_any_step() {
    for dt in [0.001, 0.013, 0.1, 1.0] {
        let mut rig = PistonRig::spring(MINMAX);
        let (mut before, mut position) = (0.0, 1.0);
        let steps = (5.0_f64 / dt) as usize;
        for i in 1..=steps {
            let tension = rig.step(0.3 * dt * i as f64, dt);
            assert!(tension >= before - 1e-6, "{dt}: {tension} after {before}");
            // at first it takes up the slack below TMIN, then it only lengthens
            let taken = tension <= 2000.0 + 1e-6;
            assert!(taken || rig.state[0] >= position - 1e-12, "{dt}: {} after {position}", rig.state[0]);
            (before, position) = (tension, rig.state[0]);
        }
        assert_near(before, 8000.0);
    }
}

#[test]
fn static_piston_slides_to_hold_limit_or_to_its_stop() {
    let rig = PistonRig::spring(MINMAX);
    for (moved, tension, position) in [
        (0.5, 5000.0, 1.0),
        (1.3, 8000.0, 1.5),
        (2.8, 8000.0, 3.0),
        (3.5, 15000.0, 3.0),
        (-0.3, 2000.0, 0.5),
        (-0.9, 1000.0, 0.0),
        (-2.0, 0.0, 0.0),
    ] {
        let (got, at) = rig.rest(moved);
        assert_near(got, tension);
        assert_near(at, position);
    }
    // of MAX nothing is taken up
    let (tension, position) = PistonRig::spring(MAX).rest(-0.3);
    assert_eq!((tension, position), (0.0, 1.0));
    let reported = rig.summary(1.3);
    assert_near(reported.springs[0].deflection, 1.5);
    assert!(reported.notes.iter().any(|n| n.without_values().contains("holds TMAX")), "{reported:?}");
    assert!(
        rig.summary(3.5)
            .notes
            .iter()
            .any(|n| n.without_values().starts_with("warning") && n.without_values().contains("end of its stroke"))
    );
}

#[test]
fn constant_tension_leaves_only_geometric_stiffness() {
    let rig = PistonRig::spring(MINMAX);
    for dt in [None, Some(5.0)] {
        let (out, _) = rig.evaluate_at(1.3, 0.0, dt);
        // T over the distance across, nothing along
        let k = out.stiffness[0];
        assert_near(k[(0, 0)], 0.0);
        assert_near(k[(1, 1)], 8000.0 / 101.3);
        assert_near(k[(2, 2)], 8000.0 / 101.3);
    }
}

#[test]
fn piston_limits_pushing_spring_too() {
    let rig = PistonRig::new(
        "SL_ELEM 100 -LEN 100 -EMOD 400/3.14159265358979323846 -PISTON MINMAX 3000 1000 0.5 0.25 8000 0",
        "~C *A *B",
        [100.0, 0.0, -5.0],
    );
    // pushed together by 0.4 m the piston gives way, down to no force; by 1.4 m it is shortest and 0.4 m are left
    assert!(rig.rest(-0.4).0.abs() < 1e-6);
    assert_near(rig.rest(-1.4).0, -4000.0);
}

#[test]
fn evaluation_does_not_move_the_piston() {
    let mut rig = PistonRig::spring(MAX);
    rig.step(1.0, 10.0);
    let before = rig.state.clone();
    let first = rig.evaluate_at(1.1, 0.0, Some(0.1));
    rig.evaluate_at(2.9, 0.0, Some(0.1));
    let again = rig.evaluate_at(1.1, 0.0, Some(0.1));
    assert_eq!(first.1, again.1);
    assert_eq!(first.0.wrench, again.0.wrench);
    assert_eq!(before, rig.state);
}

#[test]
fn line_to_ground_is_held_at_tmax_by_travel_along_tension() {
    for flag in ["EXACT", "-TABLE"] {
        let class = |piston: &str| format!("B_CAT 100 {flag} -LEN 1100 -BUOY 0 -WTPL 900 -DEP 200 {piston}");
        let free = PistonRig::new(&class(""), "-ANCHOR 0 1080 ~C *A", [0.0; 3]);
        let held = PistonRig::new(&class("-PISTON MAX 9000 1000 1 1 2.3E6"), "-ANCHOR 0 1080 ~C *A", [0.0; 3]);
        let wrench = |rig: &PistonRig, first: Vector3<f64>| {
            let ends = [first, rig.ends[1]].map(|p| End::at_rest(Pose::from_position(p.into())));
            let (out, trial) = rig.answer(ends, None);
            (out.wrench[0].fixed_rows::<3>(0).into_owned(), trial)
        };
        let (force, state) = wrench(&held, held.ends[0]);
        assert_near(force.norm() / 2.3e6, 1.0);
        let way = state[0] - 1.0;
        assert!(way > 0.5 && way < 8.0, "{state:?}");
        // the same line without a piston, its end that much further in
        let (alone, _) = wrench(&free, free.ends[0] + force.normalize() * way);
        assert!((alone - force).norm() <= 1e-9 * force.norm(), "{flag}: {alone} {force}");
    }
}

#[test]
fn dashpot_adds_limited_power_law_force_under_tension_only() {
    let rig = PistonRig::spring("-X_DAMPING 3000 2 4000");
    for (moved, speed, want) in [
        (0.5, 0.0, 5000.0),
        (0.5, 1.0, 8000.0),
        (0.5, -1.0, 2000.0),
        (0.5, 2.0, 9000.0),
        (0.5, -2.0, 1000.0),
        (-0.1, 1.0, 0.0),
    ] {
        let (out, _) = rig.evaluate_at(moved, speed, Some(0.1));
        assert_near(out.wrench[0][0], want);
        assert_near(out.wrench[1][0], -want);
        // none at rest
        assert_near(rig.evaluate_at(moved, speed, None).0.wrench[0][0], (1e4 * moved).max(0.0));
    }
    // 2 Co v
    assert_near(rig.evaluate_at(0.5, 0.7, Some(0.1)).0.damping[0][(0, 0)], 4200.0);
    // no cap without Fo
    assert_near(PistonRig::spring("-X_DAMPING 3000 1").evaluate_at(0.5, 9.0, Some(0.1)).0.wrench[0][0], 32_000.0);
}

#[test]
fn series_viscoelastic_spring_relaxes_by_combined_exponential() {
    // K(t) = 2E4 + 3E4 exp(-t/tau) in series with k = 1E4; the fit of two points is exact, and gives tau
    let mut rig = PistonRig::spring("-CONVOLUTION SOFT");
    let curve = rig.session.job.model.curves.values().next().unwrap();
    let law = windlass_connectors::viscous::ViscoelasticLaw::fit(curve).unwrap().law;
    assert_eq!(law.branches.len(), 1);
    let (k, lasting, branch, tau) = (1e4, law.long_term, law.branches[0].stiffness, law.branches[0].time);
    assert_near(lasting, 2e4);
    // stretched by 1 m at once: k in series with all of the spring
    let glassy = lasting + branch;
    let steps = 4000;
    let dt = 3.0 * tau / f64::from(steps);
    assert_near(rig.step(1.0, 1e-9 * tau) / (k * glassy / (k + glassy)), 1.0);
    // T = k (u - d), d the deflection; (k + lasting + branch) d' = -(d (k + lasting) - k u) / tau: held, it relaxes with the time
    // tau (k + lasting + branch) / (k + lasting)
    let slow = tau * (k + glassy) / (k + lasting);
    let (first, last) = (k * glassy / (k + glassy), k * lasting / (k + lasting));
    let mut tension = 0.0;
    for _ in 0..steps {
        tension = rig.step(1.0, dt);
    }
    let want = last + (first - last) * (-3.0 * tau / slow).exp();
    // the step takes the deflection for even: its error falls with the square of it
    assert!((tension - want).abs() < 1e-6 * want, "{tension} {want}");
    // statics has the last
    assert_near(rig.evaluate_at(1.0, 0.0, None).0.wrench[0][0], last);
}

#[test]
fn static_viscoelastic_catenary_has_end_spring_of_long_term_stiffness() {
    let class = |more: &str| format!("H_CAT 100 EXACT -LEN 320 -WTPL 700 {more}");
    let at = |more: &str| PistonRig::new(&class(more), "~C *A *B", [250.0, 180.0, -40.0]).evaluate_at(0.0, 0.0, None).0;
    let (soft, plain) = (at("-CONVOLUTION SOFT"), at("-SEND 2E4"));
    for i in 0..2 {
        assert!((soft.wrench[i] - plain.wrench[i]).norm() <= 1e-8 * plain.wrench[i].norm());
    }
    for i in 0..4 {
        let scale = plain.stiffness[i].norm();
        assert!((soft.stiffness[i] - plain.stiffness[i]).norm() <= 1e-7 * scale, "{i}");
    }
}

#[test]
fn contradictory_pistons_are_refused() {
    for (bad, says) in [
        ("-PISTON MINMAX 3000 1000 0.5 0.25 2000 8000", "TMIN"),
        ("-PISTON MAX 1000 3000 0.5 0.25 8000", "LD"),
        ("-PISTON MINMAX 3000 1000 0.5 0.25 8000", "TMIN"),
    ] {
        let (mut session, _, _folder) = common::session();
        session.open("records", format!("&DIMEN -DIMEN METERS N\nMEDIT\n~C SL_ELEM 100 -LEN 100 {bad}\nEND\n"));
        session.run();
        assert_eq!(session.errors, 1, "{bad}");
        let reported = format!("{:?}", session.reports);
        assert!(reported.contains(says), "{bad}: {reported}");
    }
}
