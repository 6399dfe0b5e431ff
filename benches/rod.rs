//! Rods in time: the 900 m chain of shared/validation with its fairlead driven in surge, steps of 0.1 s, one thread.
//! In a form that a program can read: name, elements, seconds of the sea a second of the processor, largest error of
//! the fairlead force from 20 s on against a run of 400 elements and 0.0125 s as a share of its range, Newton
//! iterations a step; tab between. Then the same as a body at the fairlead asks for it.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use nalgebra::Vector3;
use std::f64::consts::PI;
use std::time::Instant;
use windlass::rod::{End, Ground, Motion, PlaneBottom, Rod, Segment, Settings, Solver, State, UniformFluid, World};

const SPAN: f64 = 120.0;

/// Seconds of the processor in this thread where the system tells them, else those of the clock.
fn seconds(since: Instant) -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| since.elapsed().as_secs_f64(), |n| n * 1e-9)
}

/// Surge of the fairlead: 5 m, 10 s, brought up over 20 s.
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

/// Fairlead force at each step, seconds it took, iterations. With `body` as a body at the fairlead asks for it: a trial
/// at a motion a centimetre off, the end tangent there, and a second trial.
fn run(elements: usize, step: f64, tolerance: f64, body: bool) -> (Vec<f64>, f64, usize) {
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
    let mut solver = Solver::new(&rod, Settings { tolerance, ..Settings::default() });
    let ends = [End::pinned(a), End::pinned(b)];
    solver.statics(&rod, &mut state, &world, ends).unwrap();
    let (since, mut iterations) = (Instant::now(), 0);
    let start = seconds(since);
    let forces = (1..=(SPAN / step).round() as usize)
        .map(|i| {
            let t = i as f64 * step;
            let motion = driven(t);
            if body {
                let off = Vector3::new(0.006, 0.0, -0.008);
                let guess = Motion {
                    position: motion.position + off,
                    velocity: motion.velocity + off * (2.0 / step),
                    acceleration: motion.acceleration + off * (4.0 / step / step),
                };
                let made = solver.trial(&rod, &state, &world, t, [ends[0], End::moved(guess)]).unwrap();
                iterations += made.iterations;
                assert!(solver.end_tangent_at_hand(&rod, &world).unwrap().position[(6, 6)] < 0.0);
            }
            let made = solver.step(&rod, &mut state, &world, t, [ends[0], End::moved(motion)]).unwrap();
            iterations += made.iterations;
            made.force[1].norm()
        })
        .collect();
    (forces, seconds(since) - start, iterations)
}

fn main() {
    let (fine, _, _) = run(400, 0.0125, 1e-6, false);
    let late = &fine[1600..];
    let range = late.iter().fold(0.0, |m: f64, f| m.max(*f)) - late.iter().fold(f64::INFINITY, |m: f64, f| m.min(*f));
    let cases = [false, true].map(|body| [20, 50, 100, 200, 400].map(|elements| (body, elements)));
    for (body, elements) in cases.into_iter().flatten() {
        let step = 0.1;
        let runs: Vec<_> = (0..5).map(|_| run(elements, step, Settings::default().tolerance, body)).collect();
        let least = runs.iter().map(|r| r.1).fold(f64::INFINITY, f64::min);
        let (forces, _, iterations) = &runs[0];
        let away = |(i, f): (usize, &f64)| (f - fine[8 * (i + 1) - 1]).abs() / range;
        let error = forces.iter().enumerate().skip(200).map(away).fold(0.0, f64::max);
        let each = *iterations as f64 / forces.len() as f64;
        let name = if body { "chain900 with a body" } else { "chain900" };
        println!("{name}\t{elements}\t{:.0}\t{error:.5}\t{each:.2}", SPAN / least);
    }
}
