//! Uniform samples: what the Fourier transform needs.

use super::{SeriesError, check_times};
use std::borrow::Cow;

/// A series on a uniform grid of times.
#[derive(Clone, Debug, PartialEq)]
pub struct Uniform<'a> {
    /// Time of the first sample (s).
    pub start: f64,
    /// Step (s).
    pub step: f64,
    /// Samples.
    pub values: Cow<'a, [f64]>,
    /// Whether the samples were interpolated because the times given were not uniform.
    pub resampled: bool,
}

/// Share of a step that a time may be off its place: stored files round their times.
const STEP_TOLERANCE: f64 = 1e-3;

/// The series on a uniform grid. Times that are uniform within a thousandth of the step keep their samples; others are
/// interpolated linearly with the mean step, and [`Uniform::resampled`] says so.
///
/// # Errors
/// Fewer than two values, times that do not grow, a value that is not finite.
pub fn uniform<'a>(times: &[f64], values: &'a [f64]) -> Result<Uniform<'a>, SeriesError> {
    check_times(times, values)?;
    let (Some(first), Some(last), true) = (times.first(), times.last(), times.len() > 1) else {
        return Err(SeriesError::TooFew { what: "a uniform series of samples", need: 2, got: times.len() });
    };
    let count = times.len();
    let step = (last - first) / (count - 1) as f64;
    let position = |i: usize| first + step * i as f64;
    if times.iter().enumerate().all(|(i, t)| (t - position(i)).abs() <= STEP_TOLERANCE * step) {
        return Ok(Uniform { start: *first, step, values: Cow::Borrowed(values), resampled: false });
    }
    let mut out = Vec::with_capacity(count);
    let mut pairs = times.windows(2).zip(values.windows(2)).peekable();
    for i in 0..count {
        let t = position(i);
        while pairs.len() > 1 && pairs.peek().is_some_and(|(w, _)| matches!(w, [_, b] if *b < t)) {
            pairs.next();
        }
        if let Some(([a, b], [x, y])) = pairs.peek() {
            out.push(x + (y - x) * ((t - a) / (b - a)).clamp(0.0, 1.0));
        }
    }
    Ok(Uniform { start: *first, step, values: Cow::Owned(out), resampled: true })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_line_stays_straight_after_resampling() {
        let times = [0.0, 0.1, 0.5, 0.6, 1.3, 2.0];
        let values = times.map(|t| 3.0 * t - 1.0);
        let grid = uniform(&times, &values).unwrap();
        assert!(grid.resampled && grid.step == 0.4);
        for (i, v) in grid.values.iter().enumerate() {
            // rounding of one interpolation
            assert!((v - (1.2 * i as f64 - 1.0)).abs() < 1e-14, "{i}: {v}");
        }
    }

    #[test]
    fn uniform_samples_are_unchanged() {
        let grid = uniform(&[0.0, 0.5, 1.0], &[1.0, 2.0, 4.0]).unwrap();
        assert!(!grid.resampled && matches!(grid.values, Cow::Borrowed(_)));
        assert!(uniform(&[0.0, 0.0], &[1.0, 2.0]).is_err());
        assert!(uniform(&[0.0], &[1.0]).is_err());
    }
}
