//! Statistics of a series that is not kept: one pass, flat memory.
//!
//! Moments by the stable updates of T. B. Terriberry (2008) as given by [PEBAY-2008 eqs. 1.1 to 1.6] for one value.

use super::SeriesError;
use super::statistics::{Peak, meeting, shape};

/// An accumulator of samples in the order of time.
#[derive(Clone, Debug, PartialEq)]
pub struct Running {
    level: f64,
    count: u64,
    mean: f64,
    sums: [f64; 3],
    minimum: Option<Peak>,
    maximum: Option<Peak>,
    before: Option<Peak>,
    up: u64,
    down: u64,
    first_up: Option<f64>,
    last_up: Option<f64>,
}

/// What an accumulator has seen; the same numbers as [`super::statistics`] but for rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunningSummary {
    /// Number of samples.
    pub count: u64,
    /// Mean.
    pub mean: f64,
    /// Root of the mean of the squares, about zero.
    pub rms: f64,
    /// Standard deviation (divided by the number).
    pub deviation: f64,
    /// Skewness; 0 of a constant series.
    pub skewness: f64,
    /// EXCESS kurtosis, 0 of a Gaussian and of a constant series.
    pub kurtosis: f64,
    /// Smallest sample with its time.
    pub minimum: Peak,
    /// Largest sample with its time.
    pub maximum: Peak,
    /// Up-crossings of the level.
    pub up: u64,
    /// Down-crossings of the level.
    pub down: u64,
    /// Mean time between up-crossings (s); `None` with fewer than two.
    pub period: Option<f64>,
}

impl Running {
    /// An empty accumulator that counts crossings of a level, as the mean expected of the series.
    pub fn with_level(level: f64) -> Self {
        Running {
            level,
            count: 0,
            mean: 0.0,
            sums: [0.0; 3],
            minimum: None,
            maximum: None,
            before: None,
            up: 0,
            down: 0,
            first_up: None,
            last_up: None,
        }
    }

    /// Takes one sample: its time (s) and value.
    ///
    /// # Errors
    /// A time or value that is not finite, a time that is not later than the last; the sample is not taken.
    pub fn push(&mut self, time: f64, value: f64) -> Result<(), SeriesError> {
        let row = usize::try_from(self.count).unwrap_or(usize::MAX);
        if !time.is_finite() || !value.is_finite() {
            return Err(SeriesError::NotFinite { row: row.saturating_add(1) });
        }
        let now = Peak { time, value };
        if let Some(last) = self.before {
            if time <= last.time {
                return Err(SeriesError::NotGrowing { row });
            }
            let (was_above, above) = (last.value >= self.level, value >= self.level);
            if above && !was_above {
                let at = meeting(last, now, self.level);
                self.up += 1;
                self.first_up = self.first_up.or(Some(at));
                self.last_up = Some(at);
            } else if was_above && !above {
                self.down += 1;
            }
        }
        self.before = Some(now);
        let before = self.count as f64;
        self.count += 1;
        let count = self.count as f64;
        let delta = value - self.mean;
        let part = delta / count;
        let grown = delta * part * before;
        let [m2, m3, m4] = self.sums;
        self.mean += part;
        self.sums = [
            m2 + grown,
            m3 + grown * part * (count - 2.0) - 3.0 * part * m2,
            m4 + grown * part * part * (count * count - 3.0 * count + 3.0) + 6.0 * part * part * m2 - 4.0 * part * m3,
        ];
        if self.minimum.is_none_or(|m| value < m.value) {
            self.minimum = Some(now);
        }
        if self.maximum.is_none_or(|m| value > m.value) {
            self.maximum = Some(now);
        }
        Ok(())
    }

    /// What it has seen; `None` without a sample.
    pub fn summary(&self) -> Option<RunningSummary> {
        let (minimum, maximum) = (self.minimum?, self.maximum?);
        let count = self.count as f64;
        let variance = self.sums[0] / count;
        let (skewness, kurtosis) = shape(count, self.sums, maximum.value.abs().max(minimum.value.abs()));
        let period = match (self.first_up, self.last_up) {
            (Some(first), Some(last)) if self.up > 1 => Some((last - first) / (self.up - 1) as f64),
            _ => None,
        };
        Some(RunningSummary {
            count: self.count,
            mean: self.mean,
            rms: (self.mean * self.mean + variance).sqrt(),
            deviation: variance.sqrt(),
            skewness,
            kurtosis,
            minimum,
            maximum,
            up: self.up,
            down: self.down,
            period,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::statistics::{crossings, moments};
    use super::*;
    use proptest::prelude::*;

    fn is_near(a: f64, b: f64, tolerance: f64) -> bool {
        (a - b).abs() <= tolerance * (1.0 + b.abs())
    }

    proptest! {
        #[test]
        fn running_statistics_match_two_pass_statistics(x in prop::collection::vec(-10.0f64..10.0, 2..300), shift in -1e3f64..1e3) {
            let x: Vec<f64> = x.iter().map(|v| v + shift).collect();
            let t: Vec<f64> = (0..x.len()).map(|i| i as f64 * 0.5).collect();
            let m = moments(&x).unwrap();
            let c = crossings(&t, &x, m.mean).unwrap();
            let mut r = Running::with_level(m.mean);
            for (t, x) in t.iter().zip(&x) {
                r.push(*t, *x).unwrap();
            }
            let s = r.summary().unwrap();
            // rounding of 300 values of up to 1e3 with a spread near 5
            prop_assert!(is_near(s.mean, m.mean, 1e-13) && is_near(s.rms, m.rms, 1e-12));
            prop_assume!(m.deviation > 0.1);
            prop_assert!(is_near(s.deviation, m.deviation, 1e-11) && is_near(s.skewness, m.skewness, 1e-9));
            prop_assert!(is_near(s.kurtosis, m.kurtosis, 1e-8), "{} {}", s.kurtosis, m.kurtosis);
            prop_assert_eq!((s.minimum.value, s.maximum.value), (m.minimum.1, m.maximum.1));
            prop_assert_eq!((s.up, s.down), (c.up as u64, c.down as u64));
        }
    }

    #[test]
    fn long_offset_series_keeps_its_standard_deviation() {
        // 1e6 samples of +-1 about 1e6: naive sums of squares lose ten digits of the variance
        let mut r = Running::with_level(1e6);
        for i in 0..1_000_000u32 {
            r.push(f64::from(i), 1e6 + if i % 2 == 0 { 1.0 } else { -1.0 }).unwrap();
        }
        let s = r.summary().unwrap();
        assert!((s.deviation - 1.0).abs() < 1e-9 && (s.kurtosis + 2.0).abs() < 1e-7, "{s:?}");
        assert_eq!(s.period, Some(2.0));
    }

    #[test]
    fn sample_not_a_number_or_not_later_is_refused() {
        let mut r = Running::with_level(0.0);
        assert!(r.summary().is_none());
        r.push(0.0, 1.0).unwrap();
        let before = r.clone();
        assert_eq!(r.push(0.0, 1.0), Err(SeriesError::NotGrowing { row: 1 }));
        assert_eq!(r.push(1.0, f64::INFINITY), Err(SeriesError::NotFinite { row: 2 }));
        assert_eq!(r, before);
    }
}
