//! Post-processing against other programs: numpy, scipy, and the rainflow and FLife packages of PyPI. `tests/data/make.py` made the
//! signal and the numbers; it needs them, the tests do not.

use windlass_model::FatigueKind;
use windlass_signal::extremes::{Gumbel, Weibull, block_maxima};
use windlass_signal::fatigue::{CurveBranch, SnCurve, spectral};
use windlass_signal::rainflow::cycles;
use windlass_signal::running::Running;
use windlass_signal::spectra::{Window, amplitudes, welch};
use windlass_signal::statistics::{crossings, moments};

/// Step of the signal (s).
const STEP: f64 = 0.5;

fn signal() -> Vec<f64> {
    include_str!("../data/series.csv").lines().map(|l| l.parse().unwrap()).collect()
}

fn expected_value(name: &str) -> f64 {
    let text = include_str!("../data/expected.txt");
    let line = text.lines().find_map(|l| l.strip_prefix(name)?.strip_prefix(' '));
    line.unwrap().parse().unwrap()
}

#[track_caller]
fn same(name: &str, found: f64, tolerance: f64) {
    let want = expected_value(name);
    assert!((found - want).abs() <= tolerance * want.abs().max(1e-6), "{name}: {found} is not {want}");
}

#[test]
fn moments_match_scipy_in_one_and_two_passes() {
    let x = signal();
    let m = moments(&x).unwrap();
    let mut running = Running::with_level(m.mean);
    for (i, v) in x.iter().enumerate() {
        running.push(STEP * i as f64, *v).unwrap();
    }
    let r = running.summary().unwrap();
    // rounding of 4096 values near 100 with a spread of 3; the kurtosis is small against the 3 it is less of
    for (name, two, one, tolerance) in [
        ("mean", m.mean, r.mean, 1e-13),
        ("deviation", m.deviation, r.deviation, 1e-12),
        ("rms", m.rms, r.rms, 1e-12),
        ("skewness", m.skewness, r.skewness, 1e-10),
        ("kurtosis", m.kurtosis, r.kurtosis, 1e-8),
    ] {
        same(name, two, tolerance);
        same(name, one, tolerance);
    }
}

#[test]
fn densities_match_scipy_welch() {
    let d = welch(&signal(), STEP, 512, Window::Hann).unwrap();
    // ten digits of ordinates; those near the highest frequency are 1e-15 of the peak and all rounding
    for i in [1, 10, 25, 40, 60, 100] {
        same(&format!("welch_{i}"), d.values[i], 1e-10);
    }
    assert!((d.values[256] - expected_value("welch_256")).abs() < 1e-15);
    same("welch_sum", d.values.iter().sum::<f64>() * d.frequencies[1], 1e-12);
}

#[test]
fn amplitudes_match_numpy_fft() {
    let a = amplitudes(&signal(), STEP).unwrap();
    for i in [0, 200, 205, 210] {
        same(&format!("fft_{i}"), a.amplitudes[i], 1e-11);
    }
}

#[test]
fn cycles_match_rainflow_package() {
    let found = cycles(&signal()).unwrap();
    let sum = |of: &dyn Fn(f64, f64, f64) -> f64| found.iter().map(|c| of(c.range, c.mean, c.count)).sum::<f64>();
    same("rainflow_cycles", sum(&|_, _, n| n), 0.0);
    same("rainflow_halves", sum(&|_, _, n| if n == 0.5 { 1.0 } else { 0.0 }), 0.0);
    same("rainflow_range3", sum(&|r, _, n| n * r.powi(3)), 1e-12);
    same("rainflow_range_mean", sum(&|r, m, n| n * r * m), 1e-12);
    same("rainflow_largest", found.iter().map(|c| c.range).fold(0.0, f64::max), 0.0);
}

#[test]
fn maxima_and_fitted_distributions_match_scipy() {
    let x = signal();
    let t: Vec<f64> = (0..x.len()).map(|i| STEP * i as f64).collect();
    let mean = moments(&x).unwrap().mean;
    let c = crossings(&t, &x, mean).unwrap();
    same("maxima", c.maxima.len() as f64, 0.0);
    same("minima", c.minima.len() as f64, 0.0);
    same("maxima_sum", c.maxima.iter().map(|p| p.value).sum(), 1e-13);
    same("minima_sum", c.minima.iter().map(|p| p.value).sum(), 1e-13);
    let maxima: Vec<f64> = c.maxima.iter().map(|p| p.value).collect();
    let w = Weibull::fit(&maxima, mean).unwrap();
    // scipy's optimizer stops at about 1e-5 of its parameters
    same("weibull_shape", w.shape, 1e-4);
    same("weibull_scale", w.scale, 1e-4);
    let g = Gumbel::fit(&block_maxima(&x, 32).unwrap()).unwrap();
    same("gumbel_location", g.location, 1e-7);
    same("gumbel_scale", g.scale, 1e-5);
}

#[test]
fn damage_of_spectrum_matches_flife() {
    let m = [0, 1, 2, 4].map(|i| expected_value(&format!("fatigue_m{i}")));
    for (slope, log_a) in [(3.0, 11.687), (5.0, 15.606)] {
        let curve = SnCurve {
            name: "straight".into(),
            kind: FatigueKind::Stress,
            branches: vec![CurveBranch { slope, log_a, from: 0.0 }],
            limit: 0.0,
            mean_slope: 0.0,
            legs: 1.0,
            unconfirmed: false,
        };
        // FLife integrates its moments by Simpson's rule, the moments here are trapezoids: 1e-6 of them
        same(&format!("narrow_{slope:.0}"), spectral::narrow_band(&m, &curve, 0.0).unwrap(), 1e-5);
        same(&format!("dirlik_{slope:.0}"), spectral::dirlik(&m, &curve, 0.0).unwrap(), 1e-5);
    }
}
