//! Friction of the bottom: at rest, at its limit and beyond.

use super::super::*;
use nalgebra::Vector3;

const GRAVITY: f64 = 9.81;
/// Of the chain (kg/m).
const MASS: f64 = 100.0;

fn chain(length: f64, elements: usize) -> Rod {
    let segment = RodSegment { axial_damping: 1e6, ..RodSegment::line(length, elements, MASS, 1e8, 0.1) };
    Rod::new("chain", vec![segment], vec![]).unwrap()
}

fn rough(friction: f64) -> SeabedLaw {
    SeabedLaw { damping: 1e5, friction_along: friction, friction_across: friction, ..SeabedLaw::elastic(1e6) }
}

#[test]
fn line_in_friction_equilibrium_stays_and_anchor_is_unloaded() {
    let rod = chain(400.0, 80);
    let fluid = UniformFluid::vacuum();
    let bottom = PlaneBottom { height: 0.0, slope: [0.0, 0.0] };
    let world = LineEnvironment { bottom: Some((&bottom, rough(0.8))), ..LineEnvironment::new(&fluid, GRAVITY) };
    // drawn toward either end
    for side in [0, 1] {
        let (near, far) = (Vector3::zeros(), Vector3::new(350.0, 0.0, 100.0));
        let foot = Vector3::new(280.0, 0.0, 0.0);
        let mut points = [near, foot, far];
        if side == 0 {
            points.reverse();
        }
        let ends = [RodEnd::pin(points[0]), RodEnd::pin(points[2])];
        let mut state = RodState::along_points(&rod, &points).unwrap();
        let mut solver = RodSolver::new(&rod, RodSettings::default());
        // once for how softly nodes meet the bottom from then on
        solver.statics(&rod, &mut state, &world, ends).unwrap();
        let rested = solver.statics(&rod, &mut state, &world, ends).unwrap();
        let held = rested.force[1 - side].x.abs();
        // 1 % of the friction of a node, 3900 N, is left to hold the nodes in line
        assert!(held < 0.012 * 0.8 * MASS * GRAVITY * 5.0, "{held}");
        let pull = rested.force[side].norm();
        let before = state.clone();
        let mut balance = RodEnergyBalance::open(&rod, &state, &world, &solver, &rested);
        for i in 1..=600 {
            let made = solver.step(&rod, &mut state, &world, i as f64 * 0.1, ends).unwrap();
            balance.enter(&rod, &state, &world, &solver, &made);
            assert!((made.force[side].norm() / pull - 1.0).abs() < 1e-4, "{i}: {} {pull}", made.force[side].norm());
        }
        let moved = state.position.iter().zip(&before.position).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        println!("{side}: {pull} {held} {moved:e} {:?}", balance.energy_error());
        // what the touchdown settles by where statics soften the bottom
        assert!(moved < 1e-3, "{moved}");
    }
}

#[test]
fn dragged_line_keeps_position_and_friction_tension() {
    let (length, friction) = (100.0, 0.6);
    let rod = chain(length, 20);
    let fluid = UniformFluid::vacuum();
    let bottom = PlaneBottom { height: 0.0, slope: [0.0, 0.0] };
    let world = LineEnvironment { bottom: Some((&bottom, rough(friction))), ..LineEnvironment::new(&fluid, GRAVITY) };
    let sunk = -Vector3::z() * (MASS * GRAVITY / (1e6 * 0.1));
    let b = Vector3::x() * length + sunk;
    let mut state = RodState::along_points(&rod, &[sunk, b]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    let at = |x: f64, v: f64, a: f64| {
        let motion =
            RodEndMotion { position: b + Vector3::x() * x, velocity: Vector3::x() * v, acceleration: Vector3::x() * a };
        [RodEnd::FREE, RodEnd::from_motion(motion)]
    };
    let made = solver.start(&rod, &mut state, &world, at(0.0, 0.0, 0.0)).unwrap();
    let mut balance = RodEnergyBalance::open(&rod, &state, &world, &solver, &made);
    let (h, mut pull) = (0.02, 0.0);
    let whole = friction * MASS * GRAVITY * length;
    for i in 1..=3000 {
        let t = i as f64 * h;
        // to 0.2 m/s in 4 s, on for 16 s, to a stand in 4 s
        let (x, v, a) = match t {
            t if t < 4.0 => (0.025 * t * t, 0.05 * t, 0.05),
            t if t < 20.0 => (0.4 + 0.2 * (t - 4.0), 0.2, 0.0),
            t if t < 24.0 => (4.0 - 0.025 * (24.0 - t).powi(2), 0.05 * (24.0 - t), -0.05),
            _ => (4.0, 0.0, 0.0),
        };
        let made = solver.step(&rod, &mut state, &world, t, at(x, v, a)).unwrap();
        balance.enter(&rod, &state, &world, &solver, &made);
        // the mean of waves along it that only its own damping ends while all of it slides
        if (800..1000).contains(&i) {
            pull -= made.force[1].x / 200.0;
        }
    }
    println!("{pull} {whole} {:?}", balance);
    assert!((pull / whole - 1.0).abs() < 1e-3, "{pull} {whole}");
    assert!(balance.energy_error().abs() < 2e-3 * balance.turnover, "{balance:?}");
    let left = state.position[0].x;
    assert!(state.velocity.iter().all(|v| v.norm() < 1e-6));
    // pulled by less than all of its friction at the other end it stays
    let forces = [(0, Vector3::x() * (-0.5 * whole))];
    let pulled = LineEnvironment { forces: &forces, ..world };
    let positions: Vec<f64> = (1..=1000)
        .map(|i| {
            solver.step(&rod, &mut state, &pulled, 60.0 + i as f64 * 0.1, at(4.0, 0.0, 0.0)).unwrap();
            state.position[0].x
        })
        .collect();
    println!("{} {} {}", left, positions[499], positions[999]);
    assert!((positions[999] - positions[499]).abs() < 1e-6, "{left} {} {}", positions[499], positions[999]);
}

#[test]
fn friction_equilibrium_stiffness_matches_force_finite_difference() {
    let rod = chain(400.0, 80);
    let fluid = UniformFluid::vacuum();
    let bottom = PlaneBottom { height: 0.0, slope: [0.0, 0.0] };
    let world = LineEnvironment { bottom: Some((&bottom, rough(0.4))), ..LineEnvironment::new(&fluid, GRAVITY) };
    let (near, far) = (Vector3::zeros(), Vector3::new(360.0, 0.0, 100.0));
    let mut state = RodState::along_points(&rod, &[near, Vector3::new(280.0, 0.0, 0.0), far]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    let mut rest = |by: Vector3<f64>| {
        let ends = [RodEnd::pin(near), RodEnd::pin(far + by)];
        let made = solver.statics(&rod, &mut state, &world, ends).unwrap();
        (made.force[1], solver.end_tangent(&rod, &world).unwrap().position)
    };
    rest(Vector3::zeros());
    let result = rest(Vector3::zeros()).1;
    for axis in 0..3 {
        let mut by = Vector3::zeros();
        by[axis] = 1e-4;
        let [plus, minus] = [by, -by].map(|by| rest(by).0);
        let found = (plus - minus) / 2e-4;
        let column = Vector3::from_column_slice(result.fixed_view::<3, 1>(6, 6 + axis).as_slice());
        println!("{axis}: {found:?} {column:?}");
        // a touchdown that moves by a tenth of a millimetre takes its softness along
        assert!((found - column).norm() < 1e-3 * result.norm(), "{axis}: {found} {column}");
    }
}
