//! A 900 m chain whose fairlead is driven in surge, against MoorDyn 2.7.2 [MOORDYN-2]: tests/data/moordyn_chain900.csv.

use crate::moordyn;

use moordyn::{chain, driven, reference};
use windlass_line_dynamics::{RodEnd, RodSettings};

/// Fairlead force at every step up to 120 s, and at rest.
fn run(elements: usize, step: f64) -> (f64, Vec<f64>) {
    chain((elements, RodSettings::default()), |rod, solver, state, world, anchor, rest| {
        let force = |i: usize| {
            let t = i as f64 * step;
            solver.step(rod, state, world, t, [anchor, RodEnd::from_motion(driven(t))]).unwrap().force[1].norm()
        };
        let count = (120.0 / step).round() as usize;
        (rest.force[1].norm(), (1..=count).map(force).collect())
    })
}

/// A history of the force at a time that is one of its steps.
fn interpolate_history(history: &[f64], step: f64, t: f64) -> f64 {
    history[(t / step).round() as usize - 1]
}

#[test]
fn driven_chain_fairlead_force_matches_moordyn() {
    let (reference, range) = reference();
    let (rest, fine) = run(400, 0.0125);
    // the exact catenary; 400 elements and 3 mm of sinking in
    assert!((rest / 1_248_715.534 - 1.0).abs() < 1e-4, "{rest}");
    let away = |step: f64, history: &[f64], t: f64, force: f64| (interpolate_history(history, step, t) - force) / range;
    let errors: Vec<f64> = reference.iter().map(|(t, f)| away(0.0125, &fine, *t, *f)).collect();
    let most = errors.iter().fold(0.0, |m: f64, e| m.max(e.abs()));
    let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    // MoorDyn with 100 segments is 0.33 % from MoorDyn with 200
    assert!(most < 0.01 && rms < 0.0015, "{most} {rms}");
    // mesh and step have converged: 0.05 % of the range
    let (_, medium) = run(300, 0.025);
    let own = |step: f64, history: &[f64]| {
        reference
            .iter()
            .map(|(t, _)| away(step, history, *t, interpolate_history(&fine, 0.0125, *t)).abs())
            .fold(0.0, f64::max)
    };
    assert!(own(0.025, &medium) < 5e-4, "{}", own(0.025, &medium));
    // what a user runs: 100 elements and a tenth of a second
    let (_, coarse) = run(100, 0.1);
    assert!(own(0.1, &coarse) < 0.005, "{}", own(0.1, &coarse));
}
