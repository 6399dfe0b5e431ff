//! Trials of one step after each other, and the forces with which a run starts.

use super::super::*;
use nalgebra::Vector3;

const A: Vector3<f64> = Vector3::new(-800.0, 0.0, -300.0);
const B: Vector3<f64> = Vector3::new(0.0, 0.0, -10.0);

fn chain(bending: f64) -> (Rod, RodState) {
    let segment = RodSegment {
        axial_damping: 1e6,
        drag_normal: 1.333,
        drag_tangential: 0.639,
        added_normal: 1.0,
        added_tangential: 0.5,
        compression: bending > 0.0,
        bending,
        ..RodSegment::line(900.0, 50, 199.0, 8.54e8, 0.18)
    };
    let rod = Rod::new("chain", vec![segment], vec![]).unwrap();
    let state = RodState::along_points(&rod, &[A, Vector3::new(-350.0, 0.0, -300.0), B]).unwrap();
    (rod, state)
}

/// A current over a rough bottom.
fn sea() -> (UniformFluid, PlaneBottom, SeabedLaw) {
    let ground = SeabedLaw { damping: 3e5, friction_along: 0.5, friction_across: 0.5, ..SeabedLaw::elastic(3e6) };
    let bottom = PlaneBottom { height: -300.0, slope: [0.0, 0.0] };
    (UniformFluid::moving(1025.0, Vector3::new(0.2, 0.5, 0.0)), bottom, ground)
}

fn surge(t: f64) -> RodEndMotion {
    let (s, c) = (0.6 * t).sin_cos();
    RodEndMotion {
        position: B + Vector3::x() * (5.0 * (1.0 - c)),
        velocity: Vector3::x() * (3.0 * s),
        acceleration: Vector3::x() * (1.8 * c),
    }
}

#[test]
fn repeated_step_trial_takes_one_iteration_to_same_result() {
    let (fluid, bottom, ground) = sea();
    let world = LineEnvironment { bottom: Some((&bottom, ground)), ..LineEnvironment::new(&fluid, 9.80665) };
    for bending in [0.0, 1e5] {
        let (rod, mut state) = chain(bending);
        let clamp = |m: RodEndMotion, tilt: f64| RodEnd::from_motion(m).with_clamp(Vector3::new(0.6, tilt, 0.7));
        let mut solver = RodSolver::new(&rod, RodSettings::default());
        solver.statics(&rod, &mut state, &world, [RodEnd::pin(A), clamp(surge(0.0), 0.0)]).unwrap();
        let mut alone = RodSolver::new(&rod, RodSettings::default());
        let mut exact = RodSolver::new(&rod, RodSettings { tolerance: 1e-8, ..RodSettings::default() });
        let h = 0.1;
        let (mut iterations, mut worst, mut apart): (usize, [f64; 2], f64) = (0, [0.0; 2], 0.0);
        for i in 1..=200 {
            let t = i as f64 * h;
            let to = surge(t);
            // a body's guess that is a centimetre off, in a scheme of its own
            let off = Vector3::new(0.006, -0.003, 0.008);
            let guess = RodEndMotion {
                position: to.position + off,
                velocity: to.velocity + off * (2.0 / h),
                acceleration: to.acceleration + off * (4.0 / h / h),
            };
            solver.trial(&rod, &state, &world, t, [RodEnd::pin(A), clamp(guess, 0.001)]).unwrap();
            if i % 2 == 0 {
                let near = *solver.end_tangent_from_factors(&rod, &world).unwrap();
                let b = |t: &EndTangent| t.by_position(20.0, 400.0).fixed_view::<6, 6>(6, 6).into_owned();
                let exact = solver.end_tangent(&rod, &world).unwrap();
                apart = apart.max(b(&near).metric_distance(&b(exact)) / b(exact).norm());
            }
            let made = solver.trial(&rod, &state, &world, t, [RodEnd::pin(A), clamp(to, 0.0)]).unwrap();
            iterations += made.iterations;
            let other = alone.trial(&rod, &state, &world, t, [RodEnd::pin(A), clamp(to, 0.0)]).unwrap();
            let wanted = exact.trial(&rod, &state, &world, t, [RodEnd::pin(A), clamp(to, 0.0)]).unwrap();
            for (worst, found) in worst.iter_mut().zip([made, other]).filter(|_| wanted.parts == 1) {
                *worst = worst.max((found.force[1] - wanted.force[1]).norm() / wanted.force[1].norm());
            }
            solver.accept(&mut state);
        }
        println!("EI {bending}: {} {worst:?} {apart}", iterations as f64 / 200.0);
        // an iteration is left when moves are 1e-5 of an element, and forces are taken on to it by their tangent
        assert!(worst[0] < 1e-4 && worst[1] < 1e-4, "{worst:?}");
        // factors of a position a thousandth of an element away, where friction is taken by its secant
        assert!(apart < 0.02, "{apart}");
        assert!(iterations <= 300, "{iterations}");
    }
}

#[test]
fn initial_forces_satisfy_momentum_balance() {
    let (rod, mut state) = chain(0.0);
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment::new(&fluid, 9.80665);
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    let made = solver.statics(&rod, &mut state, &world, [RodEnd::pin(A), RodEnd::pin(B)]).unwrap();
    // at rest they are those of statics
    let again = solver.start(&rod, &mut state, &world, [RodEnd::pin(A), RodEnd::pin(B)]).unwrap();
    assert!((made.force[1] - again.force[1]).norm() < 1e-7 * made.force[1].norm());
    // a holder that is jerked feels the half element in its hand at once, and nothing else yet
    let jerk = Vector3::new(0.5, -0.2, 0.3);
    let jerked = RodEnd::from_motion(RodEndMotion { acceleration: jerk, ..RodEndMotion::at_rest(B) });
    let hit = solver.start(&rod, &mut state, &world, [RodEnd::pin(A), jerked]).unwrap();
    assert!((hit.force[1] - again.force[1] + jerk * (199.0 * 9.0)).norm() < 1e-9 * made.force[1].norm());
    // end B parts: what the holder of A still gives and weight are the change of momentum
    let parted = solver.start(&rod, &mut state, &world, [RodEnd::pin(A), RodEnd::FREE]).unwrap();
    let mass = |i: usize| 199.0 * 18.0 * if i == 50 { 0.5 } else { 1.0 };
    let change: Vector3<f64> = (1..=50).map(|i| state.acceleration[i] * mass(i)).sum();
    let outer = -parted.force[0] - Vector3::z() * (199.0 * 900.0 * 9.80665);
    assert!((change - outer).norm() < 1e-9 * outer.norm().max(made.force[1].norm()), "{change} {outer}");
    assert!(parted.force[1].norm() < 1e-6 * made.force[1].norm());
}

#[test]
fn slightly_moved_trial_needs_no_iteration_and_matches_new_one() {
    let (fluid, bottom, ground) = sea();
    let world = LineEnvironment { bottom: Some((&bottom, ground)), ..LineEnvironment::new(&fluid, 9.80665) };
    for bending in [0.0, 1e5] {
        let (rod, mut state) = chain(bending);
        // so that what is left of the first trial is less than what the move makes
        let settings = RodSettings { tolerance: 1e-6, ..RodSettings::default() };
        let (mut solver, mut alone) = (RodSolver::new(&rod, settings), RodSolver::new(&rod, settings));
        solver.statics(&rod, &mut state, &world, [RodEnd::pin(A), RodEnd::pin(surge(0.0).position)]).unwrap();
        for i in 1..=50 {
            let t = 0.1 * i as f64;
            let at = |by: f64| {
                let (to, off) = (surge(t), Vector3::new(0.6, -0.3, 0.8) * by);
                let moved = RodEndMotion {
                    position: to.position + off,
                    velocity: to.velocity + off * 20.0,
                    acceleration: to.acceleration + off * 400.0,
                };
                [RodEnd::pin(A), RodEnd::from_motion(moved)]
            };
            solver.trial(&rod, &state, &world, t, at(0.0)).unwrap();
            let first = solver.trial(&rod, &state, &world, t, at(0.0)).unwrap();
            let made = solver.trial(&rod, &state, &world, t, at(1e-8)).unwrap();
            assert_eq!((first.iterations, made.iterations), (0, 0));
            let start = alone.trial(&rod, &state, &world, t, at(0.0)).unwrap();
            alone = RodSolver::new(&rod, settings);
            let wanted = alone.trial(&rod, &state, &world, t, at(1e-8)).unwrap();
            for side in [0, 1] {
                let away = (made.force[side] - wanted.force[side] - (first.force[side] - start.force[side])).norm();
                let change = (wanted.force[side] - start.force[side]).norm();
                // the factors at hand are those of a place a thousandth of an element away at most
                assert!(away < 0.02 * change + 1e-4, "{bending} {i} {side}: {away} of {change}");
            }
            solver.accept(&mut state);
            alone = RodSolver::new(&rod, settings);
        }
    }
}

#[test]
fn end_with_another_velocity_is_not_a_slightly_moved_trial() {
    let (rod, mut state) = chain(0.0);
    let fluid = UniformFluid::still_water(1025.0);
    let world = LineEnvironment::new(&fluid, 9.80665);
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    let end = |velocity: f64| {
        let still = RodEndMotion::at_rest(B);
        [RodEnd::pin(A), RodEnd::from_motion(RodEndMotion { velocity: Vector3::y() * velocity, ..still })]
    };
    solver.statics(&rod, &mut state, &world, end(0.0)).unwrap();
    solver.trial(&rod, &state, &world, 0.1, end(0.0)).unwrap();
    // drag goes by the square of the velocity
    assert!(solver.trial(&rod, &state, &world, 0.1, end(0.5)).unwrap().iterations > 0);
}
