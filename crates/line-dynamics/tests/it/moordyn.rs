//! The chain of 900 m of tests/data/moordyn_chain900.csv, its driven fairlead, and what MoorDyn 2.7.2 [MOORDYN-2] found.

use nalgebra::Vector3;
use std::f64::consts::PI;
use windlass_line_dynamics::{
    LineEnvironment, PlaneBottom, Rod, RodEnd, RodEndForces, RodEndMotion, RodSegment, RodSettings, RodSolver,
    RodState, SeabedLaw, UniformFluid,
};

/// The fairlead: 5 m of surge, 10 s of period, brought up over 20 s.
pub fn driven(t: f64) -> RodEndMotion {
    let (w, p) = (2.0 * PI / 10.0, PI / 20.0);
    let (r, rate, bend) = if t < 20.0 {
        (0.5 * (1.0 - (p * t).cos()), 0.5 * p * (p * t).sin(), 0.5 * p * p * (p * t).cos())
    } else {
        (1.0, 0.0, 0.0)
    };
    let (s, c) = (w * t).sin_cos();
    RodEndMotion {
        position: Vector3::new(5.0 * r * s, 0.0, -10.0),
        velocity: Vector3::x() * (5.0 * (rate * s + r * w * c)),
        acceleration: Vector3::x() * (5.0 * (bend * s + 2.0 * rate * w * c - r * w * w * s)),
    }
}

/// Acceleration of gravity (m/s2).
pub const GRAVITY: f64 = 9.80665;
/// Anchor and fairlead at rest (m).
pub const ENDS: [Vector3<f64>; 2] = [Vector3::new(-800.0, 0.0, -300.0), Vector3::new(0.0, 0.0, -10.0)];

/// The chain in so many elements.
pub fn rod(elements: usize) -> Rod {
    let chain = RodSegment {
        axial_damping: 1e6,
        drag_normal: 1.333,
        drag_tangential: 0.639,
        added_normal: 1.0,
        added_tangential: 0.5,
        ..RodSegment::line(900.0, elements, 199.0, 8.54e8, 0.18)
    };
    Rod::new("chain", vec![chain], vec![]).unwrap()
}

/// The water about it.
pub fn water() -> UniformFluid {
    UniformFluid::still_water(1025.0)
}

/// The bottom below it.
pub fn bottom() -> (PlaneBottom, SeabedLaw) {
    (PlaneBottom { height: -300.0, slope: [0.0, 0.0] }, SeabedLaw { damping: 3e5, ..SeabedLaw::elastic(3e6) })
}

/// Gives the chain at rest in its world to `act`: its rod, solver and state, the end at the anchor, and the forces at rest.
pub fn chain<T>(
    (elements, settings): (usize, RodSettings),
    act: impl FnOnce(&Rod, &mut RodSolver, &mut RodState, &LineEnvironment, RodEnd, RodEndForces) -> T,
) -> T {
    let rod = rod(elements);
    let (water, (bottom, ground)) = (water(), bottom());
    let world = LineEnvironment { bottom: Some((&bottom, ground)), ..LineEnvironment::new(&water, GRAVITY) };
    let [a, b] = ENDS;
    let mut state = RodState::along_points(&rod, &[a, Vector3::new(-350.0, 0.0, -300.0), b]).unwrap();
    let mut solver = RodSolver::new(&rod, settings);
    let rest = solver.statics(&rod, &mut state, &world, [RodEnd::pin(a), RodEnd::pin(b)]).unwrap();
    act(&rod, &mut solver, &mut state, &world, RodEnd::pin(a), rest)
}

/// MoorDyn's force on the fairlead from 20 s on: time (s), size (N); and its range (N).
pub fn reference() -> (Vec<(f64, f64)>, f64) {
    let text = std::fs::read_to_string("../../tests/data/moordyn_chain900.csv")
        .or_else(|_| std::fs::read_to_string("tests/data/moordyn_chain900.csv"))
        .unwrap();
    let rows: Vec<(f64, f64)> = text
        .lines()
        .skip(2)
        .map(|line| {
            let v: Vec<f64> = line.split(',').map(|c| c.parse().unwrap()).collect();
            (v[0], v[1].hypot(v[2]))
        })
        .collect();
    let high = rows.iter().fold(f64::MIN, |m, r| m.max(r.1));
    let range = high - rows.iter().fold(f64::MAX, |m, r| m.min(r.1));
    (rows, range)
}
