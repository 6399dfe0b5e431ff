//! Harmonic analysis of a response to a regular wave: least squares on the harmonics of one period.

use super::spectra::amplitudes;
use super::{SeriesError, check_times, sampling};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;
use windlass_base::dense::{Cholesky, never};

/// Most harmonics that are fitted.
pub const MAX_HARMONICS: usize = 50;

/// One harmonic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// 1 of the period itself, 2 of half of it, and so on.
    pub order: usize,
    /// Amplitude.
    pub amplitude: f64,
    /// Phase (rad, -pi to pi): amplitude cos(order w t + phase), t being the times given.
    pub phase: f64,
}

/// The harmonics of a series.
#[derive(Clone, Debug, PartialEq)]
pub struct Harmonics {
    /// Period (s).
    pub period: f64,
    /// Whole cycles that were used, the last ones of the series.
    pub cycles: usize,
    /// Mean.
    pub mean: f64,
    /// The harmonics from the first.
    pub harmonics: Vec<Harmonic>,
    /// Root mean square of what they leave.
    pub residual: f64,
}

/// The harmonics of a known period (s) over the last whole cycles of a series, at most `cycles` of them when given: what is
/// before them, as a start from rest, stays out.
///
/// # Errors
/// A series shorter than one cycle or with too few samples for the harmonics; times that do not grow; values that are not
/// finite; a number of harmonics out of range.
pub fn analyse(
    times: &[f64],
    values: &[f64],
    period: f64,
    orders: usize,
    cycles: Option<usize>,
) -> Result<Harmonics, SeriesError> {
    check_times(times, values)?;
    if !(1..=MAX_HARMONICS).contains(&orders) {
        let expected = "between 1 and 50";
        return Err(SeriesError::Setting { what: "the number of harmonics", expected, value: orders as f64 });
    }
    if !(period.is_finite() && period > 0.0) {
        return Err(SeriesError::Setting { what: "the period", expected: "greater than zero", value: period });
    }
    let (first, last) = (times.first().copied().unwrap_or(0.0), times.last().copied().unwrap_or(0.0));
    // the last sample of a whole number of cycles may be missing: it is the first again
    let step = (last - first) / times.len().saturating_sub(1).max(1) as f64;
    let length = (last - first + step) / period;
    let held = (length + 1e-9).floor();
    let used = cycles.map_or(held, |most| held.min(most as f64));
    if used < 1.0 {
        let text = format!("the series holds {length:.3} cycles of the period, and whole cycles are needed");
        return Err(SeriesError::Refused(text));
    }
    // half a step is the room between the last sample that is left out and the first that is kept
    let from = last - used * period + 0.5 * step;
    let kept: Vec<(f64, f64)> = times.iter().copied().zip(values.iter().copied()).filter(|(t, _)| *t >= from).collect();
    let (rows, columns) = (kept.len(), 2 * orders + 1);
    if rows < columns + 2 || step * 2.0 * orders as f64 >= period {
        let text = format!("{rows} samples in {used} cycles are too few for {orders} harmonics");
        return Err(SeriesError::Refused(text));
    }
    let w = TAU / period;
    let basis = |t: f64, column: usize| {
        let angle = w * (t - last) * column.div_ceil(2) as f64;
        if column == 0 {
            1.0
        } else if column % 2 == 1 {
            angle.cos()
        } else {
            angle.sin()
        }
    };
    let matrix = DMatrix::from_fn(rows, columns, |row, column| basis(kept[row].0, column));
    let right = DVector::from_iterator(rows, kept.iter().map(|(_, x)| *x));
    let normal = Cholesky::new(matrix.tr_mul(&matrix), &never);
    let Ok(found) = normal.and_then(|factor| factor.solve(&matrix.tr_mul(&right))) else {
        return Err(SeriesError::Refused("the samples do not determine the harmonics".into()));
    };
    let left = &right - &matrix * &found;
    let harmonics = (1..=orders).map(|order| {
        let (c, s) = (found[2 * order - 1], found[2 * order]);
        // a cos(k w (t - last) + p) with c = a cos p, s = -a sin p; the phase is moved to t = 0
        let phase = (-s).atan2(c) - w * last * order as f64;
        Harmonic { order, amplitude: c.hypot(s), phase: wrap_angle(phase) }
    });
    Ok(Harmonics {
        period,
        cycles: used as usize,
        mean: found[0],
        harmonics: harmonics.collect(),
        residual: (left.norm_squared() / rows as f64).sqrt(),
    })
}

/// An angle between -pi and pi.
fn wrap_angle(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// The period (s) whose one harmonic fits a series best: from the highest of its amplitudes, then by golden section between
/// its neighbours.
///
/// # Errors
/// As [`analyse`]; a series with fewer than two cycles of it, or that does not vary.
pub fn find_period(times: &[f64], values: &[f64]) -> Result<f64, SeriesError> {
    let grid = sampling::uniform(times, values)?;
    let found = amplitudes(&grid.values, grid.step)?;
    let mut peak = (0, 0.0);
    for (k, a) in found.amplitudes.iter().enumerate().skip(1) {
        if *a > peak.1 {
            peak = (k, *a);
        }
    }
    let size = grid.values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    if peak.1 <= 1e-13 * size {
        return Err(SeriesError::Constant);
    }
    if peak.0 < 2 {
        return Err(SeriesError::Refused("the series holds fewer than two cycles of its longest period".into()));
    }
    let spacing = found.frequencies.get(1).copied().unwrap_or(0.0);
    let centre = spacing * peak.0 as f64;
    let misfit = |w: f64| sine_misfit(&grid, w);
    let golden = 0.5 * (5.0f64.sqrt() - 1.0);
    let (mut low, mut high) = (centre - spacing, centre + spacing);
    for _ in 0..80 {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if misfit(a) <= misfit(b) {
            high = b;
        } else {
            low = a;
        }
    }
    Ok(TAU / low.midpoint(high))
}

/// Sum of squares that a mean and a sine of one frequency (rad/s) leave of all samples.
fn sine_misfit(grid: &sampling::Uniform, w: f64) -> f64 {
    let mut normal = nalgebra::Matrix3::<f64>::zeros();
    let mut right = nalgebra::Vector3::<f64>::zeros();
    let mut squares = 0.0;
    for (i, x) in grid.values.iter().enumerate() {
        let angle = w * grid.step * i as f64;
        let row = nalgebra::Vector3::new(1.0, angle.cos(), angle.sin());
        normal += row * row.transpose();
        right += row * *x;
        squares += x * x;
    }
    let solved = Cholesky::new(normal, &never).and_then(|factor| factor.solve(&right));
    solved.map_or(f64::INFINITY, |found| squares - right.dot(&found))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signal(t: f64) -> f64 {
        2.0 + 3.0 * (TAU * t / 12.0 + 0.4).cos() + 0.25 * (2.0 * TAU * t / 12.0 - 1.1).cos()
    }

    #[test]
    fn harmonics_of_known_period_are_exact_to_rounding() {
        // 0.7 s does not divide the period; 100 s hold 8 cycles
        let t: Vec<f64> = (0..143).map(|i| 5.0 + 0.7 * f64::from(i)).collect();
        let x: Vec<f64> = t.iter().map(|t| signal(*t)).collect();
        let h = analyse(&t, &x, 12.0, 3, None).unwrap();
        assert_eq!(h.cycles, 8);
        assert!((h.mean - 2.0).abs() < 1e-12 && h.residual < 1e-12, "{h:?}");
        let want = [(3.0, Some(0.4)), (0.25, Some(-1.1)), (0.0, None)];
        for (found, (amplitude, phase)) in h.harmonics.iter().zip(want) {
            assert!((found.amplitude - amplitude).abs() < 1e-12, "{found:?}");
            assert!(phase.is_none_or(|p| (found.phase - p).abs() < 1e-11), "{found:?}");
        }
    }

    #[test]
    fn last_cycles_exclude_start_from_rest() {
        let t: Vec<f64> = (0..1201).map(|i| 0.1 * f64::from(i)).collect();
        let x: Vec<f64> = t.iter().map(|t| signal(*t) * (t / 30.0).min(1.0)).collect();
        let h = analyse(&t, &x, 12.0, 2, Some(5)).unwrap();
        assert!((h.harmonics[0].amplitude - 3.0).abs() < 1e-12 && h.cycles == 5, "{h:?}");
    }

    #[test]
    fn non_harmonic_part_is_residual() {
        let t: Vec<f64> = (0..1200).map(|i| 0.1 * f64::from(i)).collect();
        let x: Vec<f64> = t.iter().map(|t| signal(*t) + 0.2 * (TAU * t / 3.0).sin()).collect();
        let h = analyse(&t, &x, 12.0, 2, None).unwrap();
        assert!((h.residual - 0.2 / 2.0f64.sqrt()).abs() < 1e-12, "{h:?}");
    }

    #[test]
    fn period_is_found_between_harmonics_of_record() {
        let t: Vec<f64> = (0..800).map(|i| 0.25 * f64::from(i)).collect();
        let x: Vec<f64> = t.iter().map(|t| 1.0 + 2.0 * (TAU * t / 13.37 + 1.0).sin()).collect();
        // golden section on a smooth minimum: half the digits of the sum of squares
        assert!((find_period(&t, &x).unwrap() - 13.37).abs() < 1e-6);
        assert_eq!(find_period(&t, &[2.0; 800]), Err(SeriesError::Constant));
    }

    #[test]
    fn too_short_or_too_coarse_series_is_refused() {
        let t: Vec<f64> = (0..20).map(f64::from).collect();
        assert!(analyse(&t, &[0.0; 20], 30.0, 1, None).is_err());
        assert!(analyse(&t, &[0.0; 20], 4.0, 2, None).is_err());
        assert!(analyse(&t, &[0.0; 20], 0.0, 1, None).is_err() && analyse(&t, &[0.0; 20], 5.0, 0, None).is_err());
        assert!(analyse(&[], &[], 5.0, 1, None).is_err());
    }
}
