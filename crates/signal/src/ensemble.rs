//! The largest value of a storm from the maxima of several seeds of it: one maximum each, a Gumbel distribution of them.
//!
//! The most probable maximum (MPM) is the mode of that distribution, which is its fractile 1/e = 0.368; the mean of the maxima is
//! the fractile 0.570. Fits: moments, and greatest likelihood ([`crate::extremes::Gumbel`]). Intervals are asymptotic with Student's t
//! of n - 1 degrees of freedom in place of the normal deviate: simulated (`tests/data/ensemble.py`), an interval of 95 per cent holds
//! the true MPM in 93.5 to 94.6 per cent of samples of 3 to 40 seeds by moments, in 92 to 94.7 per cent by greatest likelihood. The seeds are independent; each record is the storm,
//! or all are equally long.

use super::extremes::{EULER, Gumbel};
use super::{SeriesError, finite};
use statrs::distribution::{ContinuousCDF, StudentsT};
use std::cell::RefCell;
use std::collections::HashMap;
use std::f64::consts::PI;
use windlass_base::choices;

/// Fewest seeds a distribution is fitted to: two leave no degree of freedom to tell how sure a deviation is.
pub const FEWEST_SEEDS: usize = 3;
/// Most seeds that [`seeds_for_scatter`] answers with.
pub const MOST_SEEDS: usize = 1_000_000;
/// Skewness of a Gumbel variable, 12 sqrt(6) zeta(3) / pi^3.
const SKEWNESS: f64 = 1.139_547_099_404_648_7;
/// Its kurtosis, 3 + 12/5.
const KURTOSIS: f64 = 5.4;

choices! {
    /// How a Gumbel distribution is fitted to maxima.
    #[derive(Default)]
    pub enum GumbelFit {
        /// By mean and standard deviation of the sample (n - 1).
        #[default]
        Moments = "MOMENTS",
        /// By greatest likelihood.
        Likelihood = "LIKELIHOOD",
    }
}

/// An estimate with its two-sided confidence interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The estimate, in the unit of the maxima.
    pub value: f64,
    /// Lower and upper end of the interval.
    pub interval: (f64, f64),
}

/// The maxima of the seeds of one case, and the distribution fitted to them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeedExtremes {
    /// Number of seeds.
    pub count: usize,
    /// Mean of their maxima.
    pub mean: f64,
    /// Standard deviation of their maxima, with n - 1.
    pub deviation: f64,
    /// Largest of them.
    pub largest: f64,
    /// How the distribution was fitted.
    pub fit: GumbelFit,
    /// The distribution of the maximum of one seed.
    pub gumbel: Gumbel,
}

impl SeedExtremes {
    /// Fits the maxima of some seeds.
    ///
    /// # Errors
    /// Fewer than [`FEWEST_SEEDS`] maxima, one that is not finite, maxima that are all alike.
    pub fn fit(maxima: &[f64], fit: GumbelFit) -> Result<SeedExtremes, SeriesError> {
        finite(maxima)?;
        let count = maxima.len();
        if count < FEWEST_SEEDS {
            return Err(SeriesError::TooFew {
                what: "a distribution of the maxima of seeds",
                need: FEWEST_SEEDS,
                got: count,
            });
        }
        let (least, largest) = maxima.iter().fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(*x), h.max(*x)));
        if largest <= least {
            return Err(SeriesError::Constant);
        }
        let n = count as f64;
        let mean = least + maxima.iter().map(|x| x - least).sum::<f64>() / n;
        let deviation = (maxima.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
        let gumbel = match fit {
            GumbelFit::Moments => {
                let scale = deviation * 6f64.sqrt() / PI;
                Gumbel { location: mean - EULER * scale, scale, count }
            }
            GumbelFit::Likelihood => Gumbel::fit_likelihood(maxima)?,
        };
        Ok(SeedExtremes { count, mean, deviation, largest, fit, gumbel })
    }

    /// The value that the maximum of a seed does not exceed with a probability (0..1), with the interval of a confidence level (0..1).
    ///
    /// # Errors
    /// A probability or level that is not between 0 and 1.
    pub fn fractile(&self, probability: f64, level: f64) -> Result<Estimate, SeriesError> {
        self.at_reduced_variate(reduced_variate(probability)?, level)
    }

    /// The value at a reduced variate y = -ln(-ln F) of the distribution, location + y scale, with the interval of a confidence level (0..1).
    /// 0 is the most probable maximum, Euler's constant the mean; ln(D/T) is the most probable maximum of a storm of duration D where the records
    /// last T.
    ///
    /// # Errors
    /// A level that is not between 0 and 1.
    pub fn at_reduced_variate(&self, reduced: f64, level: f64) -> Result<Estimate, SeriesError> {
        let value = self.gumbel.location + self.gumbel.scale * reduced;
        let half = student_t(self.count, level)? * self.deviation_of_estimate(reduced);
        Ok(Estimate { value, interval: (value - half, value + half) })
    }

    /// The most probable maximum with the interval of a confidence level (0..1).
    ///
    /// # Errors
    /// A level that is not between 0 and 1.
    pub fn most_probable(&self, level: f64) -> Result<Estimate, SeriesError> {
        self.fractile(std::f64::consts::E.recip(), level)
    }

    /// The mean of the maxima plus so many standard deviations of them: the design value of [BV-NR493].
    pub fn mean_plus(&self, deviations: f64) -> f64 {
        self.mean + deviations * self.deviation
    }

    /// Standard deviation of the estimated fractile whose reduced variate is y.
    fn deviation_of_estimate(&self, y: f64) -> f64 {
        let n = self.count as f64;
        match self.fit {
            // mean + k s: variance s^2 / n (1 + k skewness + k^2 (kurtosis - 1) / 4)
            GumbelFit::Moments => self.deviation * (moments_variance((y - EULER) * 6f64.sqrt() / PI) / n).sqrt(),
            // the Fisher information of location and scale, as in `Gumbel::extreme`
            GumbelFit::Likelihood => {
                let part = 1.0 - EULER + y;
                self.gumbel.scale * ((1.0 + 6.0 / (PI * PI) * part * part) / n).sqrt()
            }
        }
    }
}

/// Variance of mean + k s over n samples, times n, over the variance of one sample.
fn moments_variance(k: f64) -> f64 {
    1.0 + k * SKEWNESS + k * k * (KURTOSIS - 1.0) / 4.0
}

/// -ln(-ln q).
fn reduced_variate(probability: f64) -> Result<f64, SeriesError> {
    if !(probability > 0.0 && probability < 1.0) {
        return Err(SeriesError::Setting { what: "the probability", expected: "between 0 and 1", value: probability });
    }
    Ok(-(-probability.ln()).ln())
}

/// Deviates of Student's t that a thread keeps at most.
const MOST_KNOWN_DEVIATES: usize = 1 << 12;

/// The two-sided deviate of Student's t with count - 1 degrees of freedom.
fn student_t(count: usize, level: f64) -> Result<f64, SeriesError> {
    if !(level > 0.0 && level < 1.0) {
        return Err(SeriesError::Setting { what: "the confidence level", expected: "between 0 and 1", value: level });
    }
    thread_local! {
        // a study asks for the same few a million times, and each takes an iteration over incomplete beta functions
        static KNOWN: RefCell<HashMap<(usize, u64), f64>> = RefCell::new(HashMap::new());
    }
    let key = (count, level.to_bits());
    if let Some(known) = KNOWN.with_borrow(|known| known.get(&key).copied()) {
        return Ok(known);
    }
    let freedom = count.saturating_sub(1).max(1) as f64;
    let t = StudentsT::new(0.0, 1.0, freedom).map_err(|e| SeriesError::Refused(format!("Student's t: {e}")))?;
    let deviate = t.inverse_cdf(0.5 + 0.5 * level);
    KNOWN.with_borrow_mut(|known| {
        if known.len() < MOST_KNOWN_DEVIATES {
            known.insert(key, deviate);
        }
    });
    Ok(deviate)
}

/// How many seeds it takes until the interval of the most probable maximum, at a confidence level (0..1), is no wider than a share of it
/// on either side, when the maxima have a coefficient of variation (standard deviation over mean). By moments.
///
/// # Errors
/// A share, level or coefficient out of range; more than [`MOST_SEEDS`].
pub fn seeds_for_scatter(variation: f64, share: f64, level: f64) -> Result<usize, SeriesError> {
    seeds_for_mode(variation, -EULER * 6f64.sqrt() / PI, share, level)
}

/// The same for the most probable minimum of minima, which lies as far above their mean as that of maxima lies below theirs.
///
/// # Errors
/// As [`seeds_for_scatter`].
pub fn seeds_for_scatter_of_minima(variation: f64, share: f64, level: f64) -> Result<usize, SeriesError> {
    seeds_for_mode(variation, EULER * 6f64.sqrt() / PI, share, level)
}

/// Seeds until the interval of a mode that is so many deviations above the mean is within a share of it.
fn seeds_for_mode(variation: f64, above: f64, share: f64, level: f64) -> Result<usize, SeriesError> {
    for (what, value) in [("the coefficient of variation", variation), ("the share", share)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(SeriesError::Setting { what, expected: "greater than zero", value });
        }
    }
    let mode = 1.0 + above * variation;
    if mode <= 0.0 {
        let expected = "small enough that the most probable maximum is above zero";
        return Err(SeriesError::Setting { what: "the coefficient of variation", expected, value: variation });
    }
    let spread = moments_variance(-above.abs());
    let half = |n: usize| Ok(student_t(n, level)? * variation / mode * (spread / n as f64).sqrt());
    // the interval shrinks with every seed: doubled until it is narrow enough, then halved between
    let mut high = FEWEST_SEEDS;
    while half(high)? > share {
        high *= 2;
        if high > MOST_SEEDS {
            return Err(SeriesError::Refused(format!("more than {MOST_SEEDS} seeds would be needed")));
        }
    }
    let mut low = (high / 2).max(FEWEST_SEEDS - 1);
    while high - low > 1 {
        let middle = low.midpoint(high);
        if half(middle)? > share {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TENSION_5: &[f64] = &[2712.4, 2951.8, 2635.1, 3104.9, 2809.3];
    const TENSION_10: &[f64] = &[5210.0, 4987.5, 5534.2, 5105.8, 5078.4, 5391.0, 5640.7, 5012.3, 5166.9, 5288.6];
    const OFFSET_20: &[f64] = &[
        14.21, 15.02, 13.88, 16.4, 14.77, 14.95, 15.6, 13.71, 14.02, 17.35, 14.5, 14.63, 15.21, 14.11, 16.02, 13.95,
        14.38, 15.83, 14.87, 15.11,
    ];

    #[test]
    fn gumbel_fits_match_scipy() {
        // scipy 1.17, tests/data/ensemble.py; the search of its likelihood stops at 1e-7
        let table = include_str!("../tests/data/ensemble.csv");
        let mut count = 0;
        for line in table.lines().skip(1) {
            let cells: Vec<&str> = line.split(',').collect();
            let sample = match cells[0] {
                "tension5" => TENSION_5,
                "tension10" => TENSION_10,
                _ => OFFSET_20,
            };
            let number = |i: usize| cells[i].parse::<f64>().unwrap();
            let moments = SeedExtremes::fit(sample, GumbelFit::Moments).unwrap();
            let likelihood = SeedExtremes::fit(sample, GumbelFit::Likelihood).unwrap();
            let near = |got: f64, want: f64, tolerance: f64| {
                assert!((got / want - 1.0).abs() < tolerance, "{}: {got} is not {want}", cells[0]);
            };
            near(moments.mean, number(2), 1e-9);
            near(moments.deviation, number(3), 1e-9);
            near(moments.gumbel.location, number(4), 1e-9);
            near(moments.gumbel.scale, number(5), 1e-9);
            near(likelihood.gumbel.location, number(6), 1e-6);
            near(likelihood.gumbel.scale, number(7), 1e-6);
            near(moments.fractile(0.9, 0.95).unwrap().value, number(8), 1e-9);
            near(moments.most_probable(0.95).unwrap().value, number(4), 1e-9);
            count += 1;
        }
        assert_eq!(count, 3);
    }

    #[test]
    fn interval_of_mode_is_that_of_mean_less_0_45_deviations() {
        // k = 0.45005: 1 - 1.13955 k + 1.1 k^2 = 0.70994; t of 9 degrees of freedom 2.262157 (tables)
        let seeds = SeedExtremes::fit(TENSION_10, GumbelFit::Moments).unwrap();
        let found = seeds.most_probable(0.95).unwrap();
        let half = 2.262_157 * seeds.deviation * (0.709_94f64 / 10.0).sqrt();
        assert!(((found.interval.1 - found.value) / half - 1.0).abs() < 1e-4, "{found:?} {half}");
        assert!(((seeds.mean - 0.450_053 * seeds.deviation) / found.value - 1.0).abs() < 1e-6);
        // mean of the maxima and 0.3 deviations more, by hand: 5241.54 + 0.3 220.66181
        assert!((seeds.mean_plus(0.3) - 5_307.738_54).abs() < 1e-4);
        // the mean is the fractile exp(-exp(-Euler)) = 0.5703760
        assert!((seeds.fractile(0.570_376_002_1, 0.9).unwrap().value / seeds.mean - 1.0).abs() < 1e-9);
    }

    #[test]
    fn seeds_for_a_wanted_scatter_follow_from_the_interval() {
        // sd / mean 8 per cent and ten seeds: +-2.262 0.08 / (1 - 0.45 0.08) sqrt(0.70994 / 10) = 5.0 per cent; nine give 5.39
        assert_eq!(seeds_for_scatter(0.08, 0.0501, 0.95), Ok(10));
        // 20 seeds: 2.0930 0.08 / 0.963996 sqrt(0.70994 / 20) = 3.27 per cent; 19 give 3.37
        assert_eq!(seeds_for_scatter(0.08, 0.033, 0.95), Ok(20));
        assert_eq!(seeds_for_scatter(0.001, 0.5, 0.95), Ok(FEWEST_SEEDS));
        assert!(seeds_for_scatter(0.5, 1e-9, 0.95).is_err() && seeds_for_scatter(3.0, 0.1, 0.95).is_err());
        // minima: +-2.262 0.08 / (1 + 0.45 0.08) sqrt(0.70994 / 10) = 4.66 per cent; nine give 5.03
        assert_eq!(seeds_for_scatter_of_minima(0.08, 0.0467, 0.95), Ok(10));
        assert_eq!(seeds_for_scatter_of_minima(0.08, 0.0504, 0.95), Ok(9));
        assert!(seeds_for_scatter(0.0, 0.1, 0.95).is_err() && seeds_for_scatter(0.1, 0.1, 1.0).is_err());
    }

    #[test]
    fn too_few_or_equal_seeds_are_refused() {
        let few = SeedExtremes::fit(&[1.0, 2.0], GumbelFit::Moments).unwrap_err().to_string();
        assert!(few.contains("at least 3") && few.contains("there are 2"), "{few}");
        assert_eq!(SeedExtremes::fit(&[4.0; 9], GumbelFit::Likelihood), Err(SeriesError::Constant));
        assert!(SeedExtremes::fit(&[1.0, f64::NAN, 2.0], GumbelFit::Moments).is_err());
        assert!(SeedExtremes::fit(TENSION_5, GumbelFit::Moments).unwrap().fractile(1.0, 0.95).is_err());
    }
}
