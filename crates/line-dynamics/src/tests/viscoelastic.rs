//! Ropes with a static and a dynamic stiffness, against the standard linear solid.

use super::super::viscoelastic::MaxwellMemory;
use super::super::*;
use super::tangent::compare;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Unstretched length (m).
const LENGTH: f64 = 10.0;
/// Amplitude of the strain.
const SWING: f64 = 1e-3;

/// What a cycle of strain about a mean found.
struct Cycle {
    /// Stiffness in phase with the strain (N).
    storage: f64,
    /// Work lost in the cycle (J).
    lost: f64,
    /// Mean tension (N).
    mean: f64,
    /// Energy lost by damping in the balance, and its imbalance (J).
    booked: [f64; 2],
}

/// Stretches one massless element by a mean strain and swings it at `frequency` (rad/s) for some cycles of `steps` steps.
fn cycle(rope: ViscoelasticRope, mean: f64, frequency: f64, steps: usize) -> Cycle {
    let axial = TensionLaw::Viscoelastic(Box::new(rope));
    let segment = RodSegment { axial, ..RodSegment::line(LENGTH, 1, 1e-6, 1.0, 0.1) };
    let rod = Rod::new("rope", vec![segment], vec![]).unwrap();
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment::new(&fluid, 0.0);
    let (a, b) = (Vector3::zeros(), Vector3::x() * (LENGTH * (1.0 + mean)));
    let swing = Vector3::x() * (LENGTH * SWING);
    let mut state = RodState::along_points(&rod, &[a, b]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    let held = RodEnd::pin(a);
    let made = solver.statics(&rod, &mut state, &world, [held, RodEnd::pin(b + swing)]).unwrap();
    let mut balance = RodEnergyBalance::open(&rod, &state, &world, &solver, &made);
    let mut found = Cycle { storage: 0.0, lost: 0.0, mean: 0.0, booked: [0.0; 2] };
    let (mut before, mut damped) = ((-made.force[1].x, b.x + swing.x), 0.0);
    // the start dies out with the relaxation time: eight of them, and whole cycles
    let settling = (8.0 * 20.0 * frequency / (2.0 * PI)).ceil().max(3.0) as usize;
    for i in 1..=(settling + 1) * steps {
        let t = 2.0 * PI / frequency * i as f64 / steps as f64;
        let (s, c) = (2.0 * PI * (i % steps) as f64 / steps as f64).sin_cos();
        let motion = RodEndMotion {
            position: b + swing * c,
            velocity: swing * (-frequency * s),
            acceleration: swing * (-frequency * frequency * c),
        };
        let made = solver.step(&rod, &mut state, &world, t, [held, RodEnd::from_motion(motion)]).unwrap();
        balance.enter(&rod, &state, &world, &solver, &made);
        let now = (-made.force[1].x, motion.position.x);
        if i == settling * steps {
            damped = balance.work.damping;
        }
        if i > settling * steps {
            found.storage += now.0 * c * 2.0 / (steps as f64 * SWING);
            found.mean += now.0 / steps as f64;
            found.lost += 0.5 * (now.0 + before.0) * (now.1 - before.1);
        }
        before = now;
    }
    found.booked = [damped - balance.work.damping, balance.energy_error()];
    found
}

#[test]
fn cycled_rope_matches_standard_linear_solid_modulus_and_loss() {
    let (slow, fast, tau) = (1e7, 2.5e7, 20.0);
    for frequency in [1e-3, 0.02, 0.05, 0.3, 6.0] {
        let rope = ViscoelasticRope { slow: TensionLaw::Linear(slow), fast: [fast, 0.0], relaxation: tau };
        let found = cycle(rope, 0.02, frequency, 400);
        let wt = frequency * tau;
        // E' = E0 + E1 (w tau)^2 / (1 + (w tau)^2), E'' = E1 w tau / (1 + (w tau)^2), loss pi e^2 E''
        let storage = slow + (fast - slow) * wt * wt / (1.0 + wt * wt);
        let lost = PI * SWING * SWING * LENGTH * (fast - slow) * wt / (1.0 + wt * wt);
        // chords of the sine of 400 steps: (2 pi / 400)^2 / 12 = 2e-5, and as much for the sums; what is left of the
        // start, exp(-8) of E1 / (w tau)^2 at most
        assert!((found.storage / storage - 1.0).abs() < 1e-4, "{frequency}: {} {storage}", found.storage);
        assert!((found.lost / lost - 1.0).abs() < 2e-3, "{frequency}: {} {lost}", found.lost);
        assert!((found.booked[0] / lost - 1.0).abs() < 2e-3, "{frequency}: {:?} {lost}", found.booked);
        // the balance sums power by the trapezoidal rule
        assert!(found.booked[1].abs() < 1e-4 * slow * 0.02 * 0.02 * LENGTH, "{frequency}: {:?}", found.booked);
    }
}

#[test]
fn slow_cycle_has_static_and_fast_cycle_dynamic_stiffness() {
    for (mean, tension) in [(0.01, 1.1e5), (0.03, 3.9e5)] {
        // T = 1e7 e + 1e8 e^2; dynamic 1.8e7 + 12 T
        let (a, b) = (1.8e7, 12.0);
        let slow = TensionLaw::Polynomial(vec![1e7, 1e8]);
        let rope = || ViscoelasticRope { slow: slow.clone(), fast: [a, b], relaxation: 20.0 };
        let (still, quick) = (cycle(rope(), mean, 1e-4, 100), cycle(rope(), mean, 6.0, 100));
        let (law, at) = (slow.evaluate(mean), a + b * tension);
        assert!((law.0 / tension - 1.0).abs() < 1e-12);
        // (w tau)^2 is 4e-6 and the sums 3e-4; 7e-5 for the fast one
        assert!((still.storage / law.1 - 1.0).abs() < 1e-3, "{} {law:?}", still.storage);
        assert!((quick.storage / at - 1.0).abs() < 1e-3, "{} {at}", quick.storage);
        // the swing's square in the slow law: 1e8 e^2 / 2 = 50 N
        assert!((quick.mean - tension).abs() < 100.0, "{} {tension}", quick.mean);
        assert!(quick.lost > 0.0 && still.lost > 0.0);
    }
}

#[test]
fn hanging_load_creeps_to_static_length_with_closed_energy_balance() {
    // pulled by a weight at once the rope stretches by W / E_d, then creeps with tau E_d / E_s to W / E_s
    let (slow, fast, tau, load) = (1e7, 2.5e7, 20.0, 1e5);
    let axial = TensionLaw::Viscoelastic(Box::new(ViscoelasticRope {
        slow: TensionLaw::Linear(slow),
        fast: [fast, 0.0],
        relaxation: tau,
    }));
    let segment = RodSegment { axial, axial_damping: 2e5, ..RodSegment::line(LENGTH, 4, 1.0, 1.0, 0.1) };
    let rod = Rod::new("rope", vec![segment], vec![]).unwrap();
    let fluid = UniformFluid::vacuum();
    let forces = [(4, Vector3::x() * load)];
    let world = LineEnvironment { forces: &forces, ..LineEnvironment::new(&fluid, 0.0) };
    let (a, b) = (Vector3::zeros(), Vector3::x() * LENGTH);
    let mut state = RodState::along_points(&rod, &[a, b]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    let ends = [RodEnd::pin(a), RodEnd::FREE];
    let made = RodEndForces { force: [Vector3::zeros(); 2], moment: [Vector3::zeros(); 2], iterations: 0, parts: 1 };
    let mut balance = RodEnergyBalance::open(&rod, &state, &world, &solver, &made);
    let h = 0.01;
    for i in 1..=10_000 {
        let t = i as f64 * h;
        let made = solver.step(&rod, &mut state, &world, t, ends).unwrap();
        // the load that comes at once is an impact, of which the balance knows as little as the step
        if i == 10 {
            balance = RodEnergyBalance::open(&rod, &state, &world, &solver, &made);
        }
        balance.enter(&rod, &state, &world, &solver, &made);
        let stretch = state.position[4].x / LENGTH - 1.0;
        let wanted = load / slow - (load / slow - load / fast) * (-t * slow / (tau * fast)).exp();
        if t > 2.0 {
            // the internal damping takes 2e5 N s * 1.2e-4 / s = 24 N of the load
            assert!((stretch / wanted - 1.0).abs() < 1e-3, "{t}: {stretch} {wanted}");
        }
    }
    let nodes = rod.results(&state, &world, &ends);
    assert!((nodes[2].effective / load - 1.0).abs() < 1e-4, "{}", nodes[2].effective);
    assert!(balance.energy_error().abs() < 0.01 * balance.turnover, "{} {}", balance.energy_error(), balance.turnover);
    // and statics go to the static law at once
    solver.statics(&rod, &mut state, &world, ends).unwrap();
    assert!((state.position[4].x / (LENGTH * (1.0 + load / slow)) - 1.0).abs() < 1e-9);
}

#[test]
fn rope_released_slack_carries_no_compression() {
    let slow = TensionLaw::Linear(1e7);
    let axial = TensionLaw::Viscoelastic(Box::new(ViscoelasticRope { slow, fast: [3e7, 5.0], relaxation: 50.0 }));
    let segment = RodSegment { axial, ..RodSegment::line(LENGTH, 1, 10.0, 1.0, 0.1) };
    let rod = Rod::new("rope", vec![segment], vec![]).unwrap();
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment::new(&fluid, 0.0);
    let (a, b) = (Vector3::zeros(), Vector3::x() * (1.02 * LENGTH));
    let mut state = RodState::along_points(&rod, &[a, b]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    let made = solver.statics(&rod, &mut state, &world, [RodEnd::pin(a), RodEnd::pin(b)]).unwrap();
    let mut balance = RodEnergyBalance::open(&rod, &state, &world, &solver, &made);
    for i in 1..=400 {
        let t = i as f64 * 0.05;
        let (s, c) = (0.5 * t).sin_cos();
        let (r, w) = (0.03 * LENGTH, 0.5);
        let motion = RodEndMotion {
            position: b - Vector3::x() * (r * (1.0 - c)),
            velocity: Vector3::x() * (-r * w * s),
            acceleration: Vector3::x() * (-r * w * w * c),
        };
        let made = solver.step(&rod, &mut state, &world, t, [RodEnd::pin(a), RodEnd::from_motion(motion)]).unwrap();
        // one massless element but for 50 kg at an acceleration of 0.075 m/s2
        assert!(made.force[1].x < 4.0, "{t}: {}", made.force[1].x);
        balance.enter(&rod, &state, &world, &solver, &made);
    }
    assert!(balance.work.damping < 0.0, "{balance:?}");
    assert!(balance.energy_error().abs() < 0.01 * balance.turnover, "{} {}", balance.energy_error(), balance.turnover);
}

#[test]
fn invalid_viscoelastic_law_is_refused() {
    let message = |slow: TensionLaw, fast, relaxation| {
        let axial = TensionLaw::Viscoelastic(Box::new(ViscoelasticRope { slow, fast, relaxation }));
        let segment = RodSegment { axial, ..RodSegment::line(10.0, 1, 1.0, 1.0, 0.1) };
        Rod::new("rope", vec![segment], vec![]).unwrap_err().to_string()
    };
    assert!(message(TensionLaw::Linear(2e7), [1e7, 1.0], 10.0).contains("no less than the static one"));
    assert!(message(TensionLaw::Linear(1e7), [f64::NAN, 1.0], 10.0).contains("no less than the static one"));
    assert!(message(TensionLaw::Linear(1e7), [2e7, -1.0], 10.0).contains("mean tension"));
    assert!(message(TensionLaw::Linear(1e7), [2e7, 1.0], 0.0).contains("relaxation time"));
    assert!(message(TensionLaw::Linear(0.0), [2e7, 1.0], 1.0).contains("positive"));
    let inner = TensionLaw::Viscoelastic(Box::new(ViscoelasticRope {
        slow: TensionLaw::Linear(1.0),
        fast: [2.0, 0.0],
        relaxation: 1.0,
    }));
    assert!(message(inner, [2e7, 1.0], 1.0).contains("viscoelastic itself"));
}

#[test]
fn viscoelastic_rod_tangent_matches_finite_difference() {
    let slow = TensionLaw::Polynomial(vec![1e6, 4e6]);
    let axial = TensionLaw::Viscoelastic(Box::new(ViscoelasticRope { slow, fast: [2e6, 9.0], relaxation: 5.0 }));
    let segment = RodSegment { axial, axial_damping: 1e4, ..RodSegment::line(20.0, 4, 30.0, 1.0, 0.1) };
    let rod = Rod::new("rope", vec![segment], vec![]).unwrap();
    let mut state = RodState::along_points(&rod, &[Vector3::zeros(), Vector3::new(20.0, 3.0, 8.0)]).unwrap();
    for i in 0..rod.nodes() {
        let s = i as f64;
        state.position[i] += Vector3::new((s * 1.3).sin(), (s * 2.1).cos(), (s * 0.7).sin()) * 0.1;
        state.velocity[i] = Vector3::new((s * 0.9).cos(), (s * 1.7).sin(), 0.5 * (s * 2.3).cos());
    }
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    solver.trial.memory.fill(MaxwellMemory { kept: -0.04, follows: 0.7 });
    let fluid = UniformFluid::vacuum();
    compare(&rod, &state, &LineEnvironment::new(&fluid, 9.81), &mut solver);
}

#[test]
fn fast_slackening_rope_carries_no_compression_through_damper() {
    // one massless element let in at a steady speed: T = EA e - c v / L, but never less than nothing; its balance adds up
    let (ea, damping, speed, strain) = (1e7, 2e6, 0.05, 0.01);
    for rope in [None, Some(ViscoelasticRope { slow: TensionLaw::Linear(ea), fast: [ea, 0.0], relaxation: 5.0 })] {
        let axial = rope.map_or(TensionLaw::Linear(ea), |rope| TensionLaw::Viscoelastic(Box::new(rope)));
        let segment = RodSegment { axial, axial_damping: damping, ..RodSegment::line(LENGTH, 1, 1e-6, 1.0, 0.1) };
        let rod = Rod::new("rope", vec![segment], vec![]).unwrap();
        let fluid = UniformFluid::vacuum();
        let world = LineEnvironment::new(&fluid, 0.0);
        let held = RodEnd::pin(Vector3::zeros());
        let at = |t: f64| RodEndMotion {
            position: Vector3::x() * (LENGTH * (1.0 + strain) - speed * t),
            velocity: Vector3::x() * -speed,
            acceleration: Vector3::zeros(),
        };
        let mut state = RodState::along_points(&rod, &[Vector3::zeros(), at(0.0).position]).unwrap();
        state.velocity[1] = at(0.0).velocity;
        let mut solver = RodSolver::new(&rod, RodSettings::default());
        let made = solver.start(&rod, &mut state, &world, [held, RodEnd::from_motion(at(0.0))]).unwrap();
        let mut balance = RodEnergyBalance::open(&rod, &state, &world, &solver, &made);
        let mut slack = 0;
        for i in 1..=250 {
            let t = i as f64 * 0.01;
            let ends = [held, RodEnd::from_motion(at(t))];
            let made = solver.step(&rod, &mut state, &world, t, ends).unwrap();
            balance.enter(&rod, &state, &world, &solver, &made);
            let exact = (ea * (strain - speed * t / LENGTH) - damping * speed / LENGTH).max(0.0);
            slack += usize::from(exact == 0.0);
            // a mass of a hundred-thousandth of a kilogram; rounding of 1e5 N
            assert!((made.force[0].x - exact).abs() < 1e-5, "{t}: {} {exact}", made.force[0].x);
            let nodes = rod.results(&state, &world, &ends);
            assert!((nodes[0].effective - exact).abs() < 1e-5 && nodes[1].effective >= 0.0, "{t}: {nodes:?}");
        }
        assert!((69..72).contains(&slack), "{slack}");
        // what its stretch held went into the damper and the holder; the trapezoidal rule is out at the kink by one step's
        // power, 1e4 N * 0.05 m/s * 0.01 s
        assert!(balance.energy_error().abs() < 5.0, "{} {:?}", balance.energy_error(), balance.work);
        assert!(balance.work.damping < -1.0);
    }
}
