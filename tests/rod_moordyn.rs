//! A 900 m chain whose fairlead is driven in surge, against MoorDyn: shared/validation/moordyn_chain900.

#![allow(clippy::unwrap_used)]

use nalgebra::Vector3;
use std::f64::consts::PI;
use windlass::rod::{End, Ground, Motion, PlaneBottom, Rod, Segment, Settings, Solver, State, UniformFluid, World};

/// The fairlead: 5 m of amplitude, 10 s of period, brought up over 20 s.
fn driven(t: f64) -> Motion {
    let (w, p) = (2.0 * PI / 10.0, PI / 20.0);
    let (r, rate, bend) = if t < 20.0 {
        (0.5 * (1.0 - (p * t).cos()), 0.5 * p * (p * t).sin(), 0.5 * p * p * (p * t).cos())
    } else {
        (1.0, 0.0, 0.0)
    };
    let (s, c) = (w * t).sin_cos();
    Motion {
        position: Vector3::new(5.0 * r * s, 0.0, -10.0),
        velocity: Vector3::x() * (5.0 * (rate * s + r * w * c)),
        acceleration: Vector3::x() * (5.0 * (bend * s + 2.0 * rate * w * c - r * w * w * s)),
    }
}

/// Fairlead force at every step up to 120 s, and at rest.
fn run(elements: usize, step: f64) -> (f64, Vec<f64>) {
    let chain = Segment {
        axial_damping: 1e6,
        drag_normal: 1.333,
        drag_tangential: 0.639,
        added_normal: 1.0,
        added_tangential: 0.5,
        ..Segment::line(900.0, elements, 199.0, 8.54e8, 0.18)
    };
    let rod = Rod::new("chain", vec![chain], vec![]).unwrap();
    let fluid = UniformFluid::still(1025.0);
    let bottom = PlaneBottom { height: -300.0, slope: [0.0, 0.0] };
    let ground = Ground { damping: 3e5, ..Ground::elastic(3e6) };
    let world = World { bottom: Some((&bottom, ground)), ..World::new(&fluid, 9.80665) };
    let (a, b) = (Vector3::new(-800.0, 0.0, -300.0), Vector3::new(0.0, 0.0, -10.0));
    let mut state = State::along(&rod, &[a, Vector3::new(-350.0, 0.0, -300.0), b]).unwrap();
    let mut solver = Solver::new(&rod, Settings::default());
    let ends = [End::pinned(a), End::pinned(b)];
    let rest = solver.statics(&rod, &mut state, &world, ends).unwrap().force[1].norm();
    let count = (120.0 / step).round() as usize;
    let force = |i: usize| {
        let t = i as f64 * step;
        solver.step(&rod, &mut state, &world, t, [ends[0], End::moved(driven(t))]).unwrap().force[1].norm()
    };
    (rest, (1..=count).map(force).collect())
}

/// A history of the force at a time that is one of its steps.
fn at(history: &[f64], step: f64, t: f64) -> f64 {
    history[(t / step).round() as usize - 1]
}

#[test]
fn the_fairlead_force_of_a_driven_chain_is_that_of_moordyn() {
    let text = std::fs::read_to_string("tests/data/moordyn_chain900.csv").unwrap();
    let reference: Vec<(f64, f64)> = text
        .lines()
        .skip(2)
        .map(|line| {
            let v: Vec<f64> = line.split(',').map(|c| c.parse().unwrap()).collect();
            (v[0], v[1].hypot(v[2]))
        })
        .collect();
    let high = reference.iter().fold(0.0, |m: f64, r| m.max(r.1));
    let low = reference.iter().fold(f64::INFINITY, |m, r| m.min(r.1));
    let range = high - low;
    let (rest, fine) = run(400, 0.0125);
    // the exact catenary of moordyn_chain900.json; 400 elements and 3 mm of sinking in
    assert!((rest / 1_248_715.534 - 1.0).abs() < 1e-4, "{rest}");
    let away = |step: f64, history: &[f64], t: f64, force: f64| (at(history, step, t) - force) / range;
    let errors: Vec<f64> = reference.iter().map(|(t, f)| away(0.0125, &fine, *t, *f)).collect();
    let most = errors.iter().fold(0.0, |m: f64, e| m.max(e.abs()));
    let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    // the limits; MoorDyn with 100 segments is 0.33 % from MoorDyn with 200
    assert!(most < 0.01 && rms < 0.0015, "{most} {rms}");
    // mesh and step have converged: 0.05 % of the range
    let (_, medium) = run(300, 0.025);
    let own = |step: f64, history: &[f64]| {
        reference.iter().map(|(t, _)| away(step, history, *t, at(&fine, 0.0125, *t)).abs()).fold(0.0, f64::max)
    };
    assert!(own(0.025, &medium) < 5e-4, "{}", own(0.025, &medium));
    // what a user runs: 100 elements and a tenth of a second
    let (_, coarse) = run(100, 0.1);
    assert!(own(0.1, &coarse) < 0.005, "{}", own(0.1, &coarse));
}
