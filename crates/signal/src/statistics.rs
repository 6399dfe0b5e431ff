//! What a series amounts to: moments, extremes, crossings of a level and the crests between them.
//!
//! All samples weigh alike: of a series with unlike steps the moments are those of the samples, not of time.

use super::{SeriesError, check_times, finite};

/// Moments and extremes of the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// Number of samples.
    pub count: usize,
    /// Mean.
    pub mean: f64,
    /// Root of the mean of the squares, about zero.
    pub rms: f64,
    /// Standard deviation, that of the samples themselves (divided by their number).
    pub deviation: f64,
    /// Third central moment over the cube of the standard deviation; 0 of a constant series.
    pub skewness: f64,
    /// EXCESS kurtosis: fourth central moment over the fourth power of the standard deviation, less 3 (a Gaussian has
    /// 0); 0 of a constant series.
    pub kurtosis: f64,
    /// Smallest value with its place (from 0).
    pub minimum: (usize, f64),
    /// Largest value with its place (from 0).
    pub maximum: (usize, f64),
}

/// Deviations below this share of the largest magnitude are rounding: their powers have no meaning.
const ROUNDING_SHARE: f64 = 1e-13;

/// Skewness and excess kurtosis from the sums of powers of the deviations from the mean.
pub(super) fn shape(count: f64, [m2, m3, m4]: [f64; 3], size: f64) -> (f64, f64) {
    let variance = m2 / count;
    if variance.sqrt() <= ROUNDING_SHARE * size {
        return (0.0, 0.0);
    }
    (m3 / count / variance.powf(1.5), m4 / count / (variance * variance) - 3.0)
}

/// Moments and extremes of a series.
///
/// # Errors
/// No values, or one that is not finite.
pub fn moments(values: &[f64]) -> Result<Moments, SeriesError> {
    finite(values)?;
    let Some(first) = values.first() else {
        return Err(SeriesError::TooFew { what: "a mean of values", need: 1, got: 0 });
    };
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let (mut sums, mut squares) = ([0.0; 3], 0.0);
    let (mut minimum, mut maximum) = ((0, *first), (0, *first));
    for (position, value) in values.iter().enumerate() {
        let d = value - mean;
        let d2 = d * d;
        sums = [sums[0] + d2, sums[1] + d2 * d, sums[2] + d2 * d2];
        squares += value * value;
        if *value < minimum.1 {
            minimum = (position, *value);
        }
        if *value > maximum.1 {
            maximum = (position, *value);
        }
    }
    let (skewness, kurtosis) = shape(count, sums, maximum.1.abs().max(minimum.1.abs()));
    let made = Moments {
        count: values.len(),
        mean,
        rms: (squares / count).sqrt(),
        deviation: (sums[0] / count).sqrt(),
        skewness,
        kurtosis,
        minimum,
        maximum,
    };
    if [made.rms, made.deviation, made.skewness, made.kurtosis].iter().all(|v| v.is_finite()) {
        Ok(made)
    } else {
        Err(SeriesError::Refused("the values are too large for their powers".into()))
    }
}

/// An extreme between two crossings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Time of its sample (s).
    pub time: f64,
    /// Value of its sample.
    pub value: f64,
}

/// One cycle: from an up-crossing of the level to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossingCycle {
    /// Time of the up-crossing it begins with, interpolated (s).
    pub start: f64,
    /// Time from that crossing to the next (s).
    pub period: f64,
    /// Its highest sample.
    pub crest: Peak,
    /// Its lowest sample.
    pub trough: Peak,
}

impl CrossingCycle {
    /// Crest to trough, in the unit of the series.
    pub fn range(&self) -> f64 {
        self.crest.value - self.trough.value
    }
}

/// The crossings of a level and what lies between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossings {
    /// The level.
    pub level: f64,
    /// Up-crossings: from below the level to it or above.
    pub up: usize,
    /// Down-crossings: from the level or above to below it.
    pub down: usize,
    /// The whole cycles, between successive up-crossings.
    pub waves: Vec<CrossingCycle>,
    /// The highest sample of each stay above the level, between two crossings.
    pub maxima: Vec<Peak>,
    /// The lowest sample of each stay below the level, between two crossings.
    pub minima: Vec<Peak>,
}

impl Crossings {
    /// Mean time from up-crossing to up-crossing (s); `None` with fewer than two of them.
    pub fn period(&self) -> Option<f64> {
        let (first, last) = (self.waves.first()?, self.waves.last()?);
        Some((last.start + last.period - first.start) / self.waves.len() as f64)
    }

    /// Mean of the highest share (0..=1) of the crest-to-trough ranges, at least one of them; `None` without cycles.
    ///
    /// One third gives the significant range, as the significant wave height of a record (zero up-crossing method).
    pub fn mean_of_highest(&self, share: f64) -> Option<f64> {
        let mut ranges: Vec<f64> = self.waves.iter().map(CrossingCycle::range).collect();
        ranges.sort_unstable_by(|a, b| b.total_cmp(a));
        let count = ((ranges.len() as f64 * share).round() as usize).clamp(1, ranges.len().max(1));
        let taken = ranges.get(..count)?;
        Some(taken.iter().sum::<f64>() / count as f64)
    }
}

/// Time at which the line between two samples meets a level.
pub(super) fn meeting(a: Peak, b: Peak, level: f64) -> f64 {
    a.time + (b.time - a.time) * ((level - a.value) / (b.value - a.value)).clamp(0.0, 1.0)
}

/// Two-way extreme of a stay: the higher of two with `above`, else the lower; the earlier of equals.
fn further(best: Peak, next: Peak, above: bool) -> Peak {
    let better = if above { next.value > best.value } else { next.value < best.value };
    if better { next } else { best }
}

/// The crossings of a level. A sample on the level counts as above it.
///
/// # Errors
/// Unlike numbers of times and values, times that do not grow, a value that is not finite.
pub fn crossings(times: &[f64], values: &[f64], level: f64) -> Result<Crossings, SeriesError> {
    check_times(times, values)?;
    let mut made = Crossings { level, up: 0, down: 0, waves: Vec::new(), maxima: Vec::new(), minima: Vec::new() };
    let mut before: Option<Peak> = None;
    // extreme of the stay on one side of the level, once it has begun with a crossing; the last crest with the crossing before
    let mut stay: Option<Peak> = None;
    let mut crest: Option<(f64, Peak)> = None;
    let mut start = None;
    for (time, value) in times.iter().zip(values) {
        let now = Peak { time: *time, value: *value };
        let Some(last) = before.replace(now) else { continue };
        let (was_above, above) = (last.value >= level, now.value >= level);
        if was_above == above {
            stay = stay.map(|best| further(best, now, above));
            continue;
        }
        let at = meeting(last, now, level);
        if above {
            made.up += 1;
            if let Some(trough) = stay {
                made.minima.push(trough);
                if let Some((begun, crest)) = crest.take() {
                    made.waves.push(CrossingCycle { start: begun, period: at - begun, crest, trough });
                }
            }
            start = Some(at);
        } else {
            made.down += 1;
            if let Some(best) = stay {
                made.maxima.push(best);
                crest = start.map(|begun| (begun, best));
            }
        }
        stay = Some(now);
    }
    Ok(made)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn close(a: f64, b: f64, tolerance: f64) {
        assert!((a - b).abs() <= tolerance, "{a} is not {b}");
    }

    #[test]
    fn sine_moments_match_closed_form() {
        let x: Vec<f64> = (0..1000).map(|i| 5.0 + 2.0 * (TAU * i as f64 / 100.0).sin()).collect();
        let m = moments(&x).unwrap();
        // sums of a sine over whole periods are exact but for rounding; its kurtosis is 3/2, excess -3/2
        close(m.mean, 5.0, 1e-13);
        close(m.deviation, 2.0f64.sqrt(), 1e-13);
        close(m.rms, 27.0f64.sqrt(), 1e-13);
        close(m.skewness, 0.0, 1e-13);
        close(m.kurtosis, -1.5, 1e-12);
        assert_eq!((m.maximum.0, m.minimum.0), (25, 75));
    }

    #[test]
    fn four_moments_match_textbook_values() {
        // discrete uniform on n = 4 points: variance (n2 - 1)/12, excess kurtosis -6/5 (n2 + 1)/(n2 - 1)
        let m = moments(&[1.0, 2.0, 3.0, 4.0]).unwrap();
        close(m.deviation * m.deviation, 1.25, 1e-15);
        close(m.kurtosis, -1.2 * 17.0 / 15.0, 1e-14);
        assert_eq!(m.skewness, 0.0);
    }

    #[test]
    fn constant_series_has_no_skewness_and_no_value_no_mean() {
        let m = moments(&[0.1; 7]).unwrap();
        assert_eq!((m.skewness, m.kurtosis), (0.0, 0.0));
        assert!(moments(&[]).is_err());
        assert_eq!(moments(&[1.0, f64::NAN]), Err(SeriesError::NotFinite { row: 2 }));
        assert!(moments(&[1e200, -1e200]).is_err());
    }

    #[test]
    fn sine_has_one_mean_crossing_a_period_and_double_amplitude_waves() {
        let t: Vec<f64> = (0..2001).map(|i| 0.05 * i as f64).collect();
        let x: Vec<f64> = t.iter().map(|t| 1.0 + 3.0 * (TAU * t / 8.0 + 0.3).sin()).collect();
        let c = crossings(&t, &x, 1.0).unwrap();
        // 100 s of an 8 s sine from 0.3 rad: up-crossings at 7.618 + 8 n, 12 of them
        assert_eq!((c.up, c.down, c.waves.len()), (12, 13, 11));
        // a chord of 0.05 s misses the crossing by less than step^3 w^2 / 15
        close(c.period().unwrap(), 8.0, 1e-5);
        // the highest sample is within half a step of the crest
        close(c.mean_of_highest(1.0 / 3.0).unwrap(), 6.0, 6.0 * (0.025f64 * TAU / 8.0).powi(2) / 2.0);
        assert!(c.maxima.iter().all(|p| p.value > 3.99) && c.minima.iter().all(|p| p.value < -1.99));
        // the first stay above began before the series: its highest sample is no maximum between crossings
        assert_eq!((c.maxima.len(), c.minima.len()), (12, 12));
    }

    #[test]
    fn highest_third_and_tenth_are_means_of_largest() {
        // waves with amplitudes 1..=10, two samples a side
        let mut x = vec![-1.0];
        for a in 1..=10 {
            x.extend([f64::from(a), -f64::from(a)]);
        }
        x.push(1.0);
        let t: Vec<f64> = (0..x.len()).map(|i| i as f64).collect();
        let c = crossings(&t, &x, 0.0).unwrap();
        assert_eq!(c.waves.len(), 10);
        assert_eq!(c.mean_of_highest(1.0 / 3.0), Some(18.0));
        assert_eq!(c.mean_of_highest(0.1), Some(20.0));
        assert_eq!(crossings(&[0.0], &[1.0], 0.0).unwrap().mean_of_highest(0.5), None);
    }
}
