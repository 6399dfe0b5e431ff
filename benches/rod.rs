//! Rods in time, steps of 0.1 s: the 900 m chain of tests/data/moordyn_chain900.csv with its fairlead driven in surge, by the engine
//! alone, as a body at the fairlead asks for it, and by the runs of TDOM; a free vessel on eight such chains, by TDOM.
//!
//! In a form that a program can read: name, elements of a line, seconds of the sea a second of the processor on one thread,
//! largest error of the fairlead force as a share of its range, and Newton's iterations (the engine) or evaluations of all forces
//! (TDOM) a step; tab between. Of TDOM also seconds of the sea a second of the clock with all threads. Errors are from 20 s on,
//! against a run of 400 elements and 0.0125 s; with the vessel of 200 elements and 0.025 s.
//! Then the same by MoorDyn 2.7.2 (benches/moordyn.py, where Python and a network or the wheel are there), and how many times
//! quicker this is. With words after `--`, only what has one of them in its name.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

#[path = "eight/mod.rs"]
mod eight;
mod measured;
#[allow(dead_code)]
#[path = "../crates/line-dynamics/tests/it/moordyn.rs"]
mod moordyn;
#[path = "rods/mod.rs"]
mod rods;

use nalgebra::Vector3;
use std::process::Command;
use std::time::Instant;
use windlass_line_dynamics::{RodEnd, RodEndMotion, RodSettings};

const SPAN: f64 = 120.0;
const STEP: f64 = 0.1;
/// How many times each piece of work is done: the quickest counts, as other work on the machine only ever adds.
const PASSES: usize = 5;

/// Seconds of the processor in this thread where the system reports them, else those of the clock.
fn seconds(since: Instant) -> f64 {
    measured::thread_time().unwrap_or_else(|| since.elapsed().as_secs_f64())
}

/// Fairlead force at each step, seconds it took, iterations. With `body` as a body at the fairlead asks for it: a trial
/// at a motion a centimetre off, the end tangent there, and a second trial.
fn run(elements: usize, step: f64, tolerance: f64, body: bool) -> (Vec<f64>, f64, usize) {
    let settings = RodSettings { tolerance, ..RodSettings::default() };
    moordyn::chain((elements, settings), |rod, solver, state, world, anchor, _| {
        let (since, mut iterations) = (Instant::now(), 0);
        let start = seconds(since);
        let mut force = |i: usize| {
            let t = i as f64 * step;
            let motion = moordyn::driven(t);
            if body {
                let off = Vector3::new(0.006, 0.0, -0.008);
                let guess = RodEndMotion {
                    position: motion.position + off,
                    velocity: motion.velocity + off * (2.0 / step),
                    acceleration: motion.acceleration + off * (4.0 / step / step),
                };
                let made = solver.trial(rod, state, world, t, [anchor, RodEnd::from_motion(guess)]).unwrap();
                iterations += made.iterations;
                assert!(solver.end_tangent_from_factors(rod, world).unwrap().position[(6, 6)] < 0.0);
            }
            let made = solver.step(rod, state, world, t, [anchor, RodEnd::from_motion(motion)]).unwrap();
            iterations += made.iterations;
            made.force[1].norm()
        };
        let forces = (1..=(SPAN / step).round() as usize).map(&mut force).collect();
        (forces, seconds(since) - start, iterations)
    })
}

/// The fairlead force against which others are measured: times of one step (s), and its range from 20 s on (N).
struct Converged {
    step: f64,
    forces: Vec<f64>,
    range: f64,
}

impl Converged {
    fn compute() -> Self {
        let step = 0.0125;
        let (forces, _, _) = run(400, step, 1e-6, false);
        let late = &forces[(20.0 / step) as usize..];
        let most = late.iter().fold(0.0, |m: f64, f| m.max(*f));
        let range = most - late.iter().fold(f64::INFINITY, |m: f64, f| m.min(*f));
        Converged { step, forces, range }
    }

    /// The largest difference from 20 s on of forces at times, as a share of the range.
    fn error(&self, forces: impl Iterator<Item = (f64, f64)>) -> f64 {
        let away = |(t, f): (f64, f64)| {
            let at = t / self.step - 1.0;
            let (i, share) = (at.floor() as usize, at.fract());
            let next = self.forces.get(i + 1).unwrap_or(&self.forces[i]);
            (f - self.forces[i] * (1.0 - share) - next * share).abs() / self.range
        };
        forces.filter(|(t, _)| *t >= 20.0 - 1e-9).map(|(t, f)| away((t + 1e-9, f))).fold(0.0, f64::max)
    }
}

/// What MoorDyn made: name, segments, scheme, times real time; and the forces of the chain, by segments, at times.
#[derive(Default)]
struct Peer {
    rows: Vec<(String, usize, String, f64)>,
    forces: Vec<(usize, f64, f64)>,
}

impl Peer {
    /// None where the script cannot run.
    fn run_moordyn() -> Option<Self> {
        let script = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/moordyn.py");
        let made = Command::new("python3").args([script, "--forces"]).output().ok().filter(|o| o.status.success())?;
        let mut peer = Peer::default();
        for line in String::from_utf8(made.stdout).ok()?.lines() {
            match line.split('\t').collect::<Vec<_>>().as_slice() {
                ["force", segments, time, force] => {
                    peer.forces.push((segments.parse().ok()?, time.parse().ok()?, force.parse().ok()?));
                }
                [name, segments, scheme, speed] => {
                    let row = (name.to_string(), segments.parse().ok()?, scheme.to_string(), speed.parse().ok()?);
                    peer.rows.push(row);
                }
                _ => return None,
            }
        }
        Some(peer)
    }
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|w| !w.starts_with('-')).collect();
    let wanted = |name: &str| words.is_empty() || words.iter().any(|w| name.contains(w.as_str()));
    let converged = Converged::compute();
    let timed = |(i, f): (usize, f64)| ((i + 1) as f64 * STEP, f);
    let mut speeds = Vec::new();
    for (name, body) in [("chain900", false), ("chain900 with a body", true)] {
        for elements in [20, 50, 100, 200, 400].into_iter().filter(|_| wanted(name)) {
            let runs: Vec<_> =
                (0..PASSES).map(|_| run(elements, STEP, RodSettings::default().tolerance, body)).collect();
            let speed = SPAN / runs.iter().map(|r| r.1).fold(f64::INFINITY, f64::min);
            let (forces, _, iterations) = &runs[0];
            let error = converged.error(forces.iter().copied().enumerate().map(timed));
            let each = *iterations as f64 / forces.len() as f64;
            println!("{name}\t{elements}\t{speed:.0}\t{error:.5}\t{each:.2}");
            speeds.push((name.to_string(), "chain900", elements, speed, error));
        }
    }
    for elements in [20, 50, 100, 200].into_iter().filter(|_| wanted("chain900 TDOM")) {
        let made = rods::run(&rods::driven(elements), (SPAN, STEP), 1, PASSES);
        let error = converged.error(made.forces.iter().copied().enumerate().skip(1).map(|(i, f)| timed((i - 1, f))));
        let [speed, clock] = made.seconds.map(|s| SPAN / s);
        let each = made.counts.evaluations as f64 / made.counts.steps as f64;
        println!("chain900 TDOM\t{elements}\t{speed:.0}\t{error:.5}\t{each:.2}\t{clock:.0}");
        speeds.push(("chain900 TDOM".to_string(), "chain900", elements, speed, error));
    }
    for (of, components) in [("vessel TDOM", 0), ("vessel TDOM, 100 waves", 100)].into_iter().filter(|v| wanted(v.0)) {
        let fine = rods::run(&rods::vessel(200, components), (60.0, 0.025), 0, 1).forces;
        let [most, least] = [f64::max, f64::min].map(|of| fine[800..].iter().copied().reduce(of).unwrap());
        let cases = [20, 50, 100]
            .map(|elements| [("", 0.1, 1), (", no nodes kept", 0.1, 0), (", 0.2 s", 0.2, 1)].map(|c| (elements, c)));
        for (elements, (how, step, along)) in cases.into_iter().flatten() {
            let made = rods::run(&rods::vessel(elements, components), (60.0, step), along, PASSES);
            let [speed, clock] = made.seconds.map(|s| 60.0 / s);
            let each = made.counts.evaluations as f64 / made.counts.steps as f64;
            let every = (step / 0.025_f64).round() as usize;
            let away = made.forces.iter().zip(fine.iter().step_by(every)).map(|(a, b)| (a - b).abs());
            let error = away.skip((20.0 / step) as usize).fold(0.0, f64::max) / (most - least);
            println!("{of}{how}\t{elements}\t{speed:.0}\t{error:.5}\t{each:.2}\t{clock:.0}");
            speeds.push((format!("{of}{how}"), "vessel", elements, speed, error));
        }
    }
    let Some(peer) = wanted("MoorDyn").then(Peer::run_moordyn).flatten() else {
        println!("MoorDyn is not here: benches/moordyn.py says what it needs");
        return;
    };
    println!(
        "\n{:<38}{:>9}{:>12}{:>9}{:>12}{:>9}{:>8}",
        "", "elements", "real time", "error", "MoorDyn", "error", "ratio"
    );
    for (name, of, elements, speed, error) in speeds {
        let Some((.., by)) = peer.rows.iter().find(|(n, count, ..)| n == of && *count == elements) else { continue };
        let shown = |error: f64| format!("{:.2} %", 100.0 * error);
        let theirs = peer.forces.iter().filter(|f| f.0 == elements).map(|f| (f.1, f.2));
        // that of the vessel is another hull
        let theirs = if of == "chain900" { shown(converged.error(theirs)) } else { String::new() };
        let (ours, ratio) = (shown(error), speed / by);
        println!("{name:<38}{elements:>9}{speed:>12.0}{ours:>9}{by:>12.0}{theirs:>9}{ratio:>8.1}");
    }
    for (name, segments, scheme, speed) in &peer.rows {
        println!("MoorDyn\t{name}\t{segments}\t{scheme}\t{speed}");
    }
}
