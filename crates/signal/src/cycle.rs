//! Harmonics of one cycle of a response that still drifts, as AQWA-NAUT reports them.
//!
//! The cycle from a start is sampled at equal times by cubics through four samples of the series; what it drifts from its start to its end is
//! taken off as a straight line about the middle; the discrete Fourier sum gives mean and harmonics. Sixteen samples are those of AQWA
//! ([W-INSTALLED 4]: with sixty the higher harmonics are off).

use super::harmonics::Harmonic;
use super::{SeriesError, check_times};
use std::f64::consts::TAU;

/// Samples of a cycle that AQWA takes.
pub const AQWA_SAMPLES: usize = 16;
/// Most samples of a cycle.
const MAX_CYCLE_SAMPLES: usize = 4096;

/// One cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct HarmonicCycle {
    /// Its start (s).
    pub start: f64,
    /// Its period (s).
    pub period: f64,
    /// Mean.
    pub mean: f64,
    /// Value at the end less that at the start.
    pub drift: f64,
    /// The harmonics from the first; phases count from time 0 of the series.
    pub harmonics: Vec<Harmonic>,
}

impl HarmonicCycle {
    /// The cycle of a period (s) from a start (s), with as many harmonics as `orders`.
    ///
    /// # Errors
    /// Times that do not grow or values that are not finite; a cycle that the series does not hold; fewer than two samples for each harmonic.
    pub fn new(
        times: &[f64],
        values: &[f64],
        (start, period): (f64, f64),
        orders: usize,
        samples: usize,
    ) -> Result<Self, SeriesError> {
        check_times(times, values)?;
        if times.len() < 4 {
            return Err(SeriesError::TooFew { what: "a cycle by cubics", need: 4, got: times.len() });
        }
        if !(period.is_finite() && period > 0.0) {
            return Err(SeriesError::Setting { what: "the period", expected: "greater than zero", value: period });
        }
        if orders == 0 || 2 * orders >= samples || samples > MAX_CYCLE_SAMPLES {
            let text = format!("{samples} samples of a cycle do not give {orders} harmonics");
            return Err(SeriesError::Refused(text));
        }
        let (first, last) = (times.first().copied().unwrap_or(0.0), times.last().copied().unwrap_or(0.0));
        let room = 1e-9 * period;
        if !(start >= first - room && start + period <= last + room) {
            let text = format!("the cycle from {start} s to {} s is not within the series", start + period);
            return Err(SeriesError::Refused(text));
        }
        let at = |t: f64| cubic(times, values, t);
        let drift = at(start + period) - at(start);
        let share = |i: usize| i as f64 / samples as f64;
        let kept: Vec<f64> = (0..samples).map(|i| at(start + period * share(i)) - drift * (share(i) - 0.5)).collect();
        let count = samples as f64;
        let harmonics = (1..=orders).map(|order| {
            let (mut c, mut s) = (0.0, 0.0);
            for (i, x) in kept.iter().enumerate() {
                let angle = TAU * order as f64 * share(i);
                c += x * angle.cos() * 2.0 / count;
                s += x * angle.sin() * 2.0 / count;
            }
            let phase = (-s).atan2(c) - TAU * order as f64 * start / period;
            Harmonic { order, amplitude: c.hypot(s), phase: phase - TAU * (phase / TAU).round() }
        });
        Ok(HarmonicCycle {
            start,
            period,
            mean: kept.iter().sum::<f64>() / count,
            drift,
            harmonics: harmonics.collect(),
        })
    }
}

/// The value at a time by the cubic through the four samples about it.
fn cubic(times: &[f64], values: &[f64], at: f64) -> f64 {
    let after = times.partition_point(|t| *t <= at);
    let from = after.saturating_sub(2).min(times.len().saturating_sub(4));
    let about: Vec<(f64, f64)> = times.iter().copied().zip(values.iter().copied()).skip(from).take(4).collect();
    let mut sum = 0.0;
    for (i, (t, x)) in about.iter().enumerate() {
        let mut weight = 1.0;
        for (j, (other, _)) in about.iter().enumerate() {
            if i != j {
                weight *= (at - other) / (t - other);
            }
        }
        sum += weight * x;
    }
    sum
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn drifting_cosine_gives_mean_drift_and_harmonic() {
        let times: Vec<f64> = (0..161).map(|i| 0.125 * f64::from(i)).collect();
        let value = |t: f64| 3.0 + 0.2 * (t - 10.0) + 2.0 * (TAU * t / 12.0 - 0.7).cos();
        let values: Vec<f64> = times.iter().map(|t| value(*t)).collect();
        let found = HarmonicCycle::new(&times, &values, (4.0, 12.0), 3, 16).unwrap();
        // cubics over w h = 0.065: (w h)^4/24 of the amplitude, 1.5e-6
        assert!((found.mean - 3.0).abs() < 2e-6 && (found.drift - 2.4).abs() < 1e-5, "{found:?}");
        // what a straight line leaves between 16 samples of it goes into the mean alone when it is about the middle
        let line = 2.4 / 16.0 / 2.0;
        assert!((found.harmonics[0].amplitude - 2.0).abs() < 2.0 * line, "{found:?}");
    }

    #[test]
    fn periodic_series_phase_is_relative_to_time_zero() {
        let times: Vec<f64> = (0..301).map(|i| 0.1 * f64::from(i)).collect();
        let values: Vec<f64> = times.iter().map(|t| 2.0 * (TAU * t / 12.0 + 0.9).cos()).collect();
        let found = HarmonicCycle::new(&times, &values, (7.0, 12.0), 2, 16).unwrap();
        let [one, two] = [found.harmonics[0], found.harmonics[1]];
        assert!(
            (one.amplitude - 2.0).abs() < 1e-6 && (one.phase - 0.9).abs() < 1e-6 && two.amplitude < 1e-6,
            "{found:?}"
        );
    }

    #[test]
    fn cycle_outside_series_or_too_few_samples_are_refused() {
        let times: Vec<f64> = (0..21).map(f64::from).collect();
        let values = vec![0.0; 21];
        assert!(HarmonicCycle::new(&times, &values, (10.0, 12.0), 2, 16).is_err());
        assert!(
            HarmonicCycle::new(&times, &values, (0.0, 12.0), 8, 16).is_err()
                && HarmonicCycle::new(&times, &values, (0.0, 0.0), 2, 16).is_err()
        );
    }
}
