//! Tangents are the differences of what they are tangents of.

use super::super::system::Weights;
use super::super::trial::StaticFriction;
use super::super::*;
use nalgebra::Vector3;

/// A rod with everything on it that has a tangent, in a bent and moving position through surface and bottom.
fn everything(bending: f64) -> (Rod, RodState) {
    let segment = |law, tube| RodSegment {
        axial: law,
        axial_damping: 2e4,
        compression: true,
        bending,
        drag_normal: 1.2,
        drag_tangential: 0.1,
        added_normal: 1.0,
        added_tangential: 0.3,
        wind_drag: 1.1,
        tube,
        ..RodSegment::line(20.0, 4, 80.0, 1e6, 0.4)
    };
    let tube =
        TubeSection { warmer: 40.0, expansion: 1e-5, pressure: 2e5, contents: 800.0, ..TubeSection::empty(0.4, 0.3) };
    let segments =
        vec![segment(TensionLaw::Linear(1e6), Some(tube)), segment(TensionLaw::Polynomial(vec![1e6, 3e6]), None)];
    let buoy = super::buoy(7);
    let rod = Rod::new("all", segments, vec![buoy]).unwrap();
    let mut state =
        RodState::along_points(&rod, &[Vector3::new(0.0, 0.0, -9.0), Vector3::new(30.0, 5.0, 8.0)]).unwrap();
    state.move_origin(Vector3::zeros());
    for i in 0..rod.nodes() {
        let s = i as f64;
        state.position[i] += Vector3::new((s * 1.3).sin(), (s * 2.1).cos(), (s * 0.7).sin() * 1.5);
        state.velocity[i] = Vector3::new((s * 0.9).cos(), (s * 1.7).sin(), 0.5 * (s * 2.3).cos());
        state.acceleration[i] = Vector3::new((s * 1.9).cos(), (s * 0.4).sin(), (s * 1.3).cos());
    }
    (rod, state)
}

#[test]
fn whole_rod_tangent_matches_residual_finite_difference() {
    let fluid = UniformFluid(FluidState {
        velocity: Vector3::new(0.7, -0.2, 0.1),
        acceleration: Vector3::new(0.1, 0.3, -0.2),
        surface: 0.3,
        head: -0.1,
        density: 1025.0,
        wind: Vector3::new(12.0, -5.0, 1.0),
        air_density: 1.226,
    });
    let bottom = PlaneBottom { height: -8.0, slope: [0.05, -0.02] };
    let ground = SeabedLaw {
        damping: 1e3,
        penetration_scale: 0.1,
        friction_along: 0.3,
        friction_across: 0.6,
        ..SeabedLaw::elastic(1e5)
    };
    let world = LineEnvironment { bottom: Some((&bottom, ground)), slam: true, ..LineEnvironment::new(&fluid, 9.81) };
    for bending in [0.0, 4e5] {
        let (mut rod, state) = everything(bending);
        rod.elements.change(|elements| elements[2].rate = 0.3);
        let mut solver = RodSolver::new(&rod, RodSettings::default());
        solver.trial.ends[0] = RodEnd::FREE.with_clamp(Vector3::new(0.8, 0.3, 0.5));
        solver.trial.ends[1] = RodEnd { rotation: Some(2e5), ..RodEnd::FREE.with_clamp(Vector3::new(0.5, -0.3, 0.5)) };
        compare(&rod, &state, &world, &mut solver);
        for side in [0, 1] {
            solver.trial.friction = StaticFriction::Pulled { end: side, drags: true };
            compare(&rod, &state, &world, &mut solver);
        }
    }
}

/// Compares the tangent of a rod in a state, by each of position, velocity and acceleration, with differences.
pub(super) fn compare(rod: &Rod, state: &RodState, world: &LineEnvironment, solver: &mut RodSolver) {
    let mut at = |position: &[Vector3<f64>], velocity: &[Vector3<f64>], acceleration: &[Vector3<f64>], w: Weights| {
        solver.trial.x.copy_from_slice(position);
        solver.trial.v.copy_from_slice(velocity);
        solver.trial.a.copy_from_slice(acceleration);
        solver.trial.exact_friction_tangent = true;
        trial::sample_fluid(world, 0.0, &mut solver.trial);
        trial::set_friction_directions(rod, state, world, &mut solver.trial.friction_direction);
        trial::set_seabed_penetration_scales(state, world, &mut solver.trial.seabed_penetration_scale);
        let last = rod.elements.len();
        solver.system.work.assemble(rod, world, &solver.trial, w, 0..last);
        solver.system.work.clone()
    };
    for (kind, w) in [(0, [1.0, 0.0, 0.0]), (1, [0.0, 1.0, 0.0]), (2, [0.0, 0.0, 1.0])] {
        let weights = Weights { k: w[0], c: w[1], m: w[2] };
        let whole = at(&state.position, &state.velocity, &state.acceleration, weights);
        for column in 0..rod.nodes() {
            for axis in 0..3 {
                let h = 1e-6;
                let mut moved = |by: f64| {
                    let mut s = [state.position.clone(), state.velocity.clone(), state.acceleration.clone()];
                    s[kind][column][axis] += by;
                    at(&s[0], &s[1], &s[2], weights)
                };
                let (plus, minus) = (moved(h), moved(-h));
                for row in 0..rod.nodes() {
                    let difference = (plus.residual(row) - minus.residual(row)) / (2.0 * h);
                    let tangent = whole.block(row, column).column(axis).into_owned();
                    // forces of 1e6 N to 1e-16 over 1e-6 m: 1e-4; second derivatives 1e7 times h squared are less
                    let most = 2e-3 + 1e-7 * tangent.norm();
                    assert!(
                        (difference - tangent).norm() < most,
                        "kind {kind} {row} {column} {axis}: {difference} {tangent}"
                    );
                }
            }
        }
    }
}

#[test]
fn batched_elements_match_single_elements() {
    let fluid = UniformFluid(FluidState {
        velocity: Vector3::new(0.7, -0.2, 0.1),
        acceleration: Vector3::new(0.1, 0.3, -0.2),
        head: 0.4,
        ..UniformFluid::still_water(1025.0).0
    });
    let world = LineEnvironment::new(&fluid, 9.81);
    let full =
        TubeSection { expansion: 1e-5, warmer: 40.0, pressure: 2e6, contents: 800.0, ..TubeSection::empty(0.4, 0.36) };
    for (bending, compression, tube) in
        [(0.0, false, None), (0.0, true, None), (4e5, true, None), (0.0, false, Some(full)), (4e5, true, Some(full))]
    {
        let segment = RodSegment {
            axial_damping: 2e4,
            compression,
            bending,
            tube,
            drag_normal: 1.2,
            drag_tangential: 0.1,
            added_normal: 1.0,
            added_tangential: 0.3,
            ..RodSegment::line(95.0, 19, 80.0, 1e6, 0.4)
        };
        let mut rod = Rod::new("plain", vec![segment], vec![]).unwrap();
        // the top comes out of the water, some elements are slack, one is wound, one node stands still in the water
        let mut state =
            RodState::along_points(&rod, &[Vector3::new(0.0, 0.0, -90.0), Vector3::new(30.0, 5.0, 6.0)]).unwrap();
        state.move_origin(Vector3::zeros());
        for i in 0..rod.nodes() {
            let s = i as f64;
            state.position[i] += Vector3::new((s * 1.3).sin(), (s * 2.1).cos(), (s * 0.7).sin() * 1.5);
            state.velocity[i] = Vector3::new((s * 0.9).cos(), (s * 1.7).sin(), 0.5 * (s * 2.3).cos());
            state.acceleration[i] = Vector3::new((s * 1.9).cos(), (s * 0.4).sin(), (s * 1.3).cos());
        }
        state.velocity[4] = fluid.0.velocity;
        rod.elements.change(|elements| elements[2].rate = 0.3);
        let weights = Weights { k: 1.0, c: 30.0, m: 900.0 };
        let mut made = [true, false].map(|plain| {
            rod.elements.change(|elements| elements.iter_mut().for_each(|e| e.plain = plain));
            let mut solver = RodSolver::new(&rod, RodSettings::default());
            solver.trial.x.copy_from_slice(&state.position);
            solver.trial.v.copy_from_slice(&state.velocity);
            solver.trial.a.copy_from_slice(&state.acceleration);
            trial::sample_fluid(&world, 0.0, &mut solver.trial);
            assert_eq!(
                super::super::element_batch::count_batchable(&rod, &solver.trial, 0..19),
                if plain { 8 } else { 0 }
            );
            solver.system.work.assemble(&rod, &world, &solver.trial, weights, 0..19);
            solver
        });
        let [at_once, alone] = &made;
        for row in 0..rod.nodes() {
            // forces of 1e6 N, and stiffnesses of 1e7 N/m, to rounding
            assert!(
                (at_once.system.work.residual(row) - alone.system.work.residual(row)).norm() < 1e-8,
                "{bending} {row}"
            );
            for column in 0..rod.nodes() {
                let away = (at_once.system.work.block(row, column) - alone.system.work.block(row, column)).norm();
                assert!(away < 1e-7, "{bending} {row} {column}: {away}");
            }
        }
        for (solver, plain) in made.iter_mut().zip([true, false]) {
            rod.elements.change(|elements| elements.iter_mut().for_each(|e| e.plain = plain));
            solver.system.work.forces(&rod, &world, &solver.trial);
        }
        let [at_once, alone] = &made;
        for row in 0..rod.nodes() {
            assert!((at_once.system.work.residual(row) - alone.system.work.residual(row)).norm() < 1e-8);
        }
    }
}
