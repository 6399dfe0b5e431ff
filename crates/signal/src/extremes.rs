//! Largest values of a stationary process in a duration: Rayleigh from its spectrum's moments, Weibull fitted to its maxima,
//! Gumbel fitted to the maxima of blocks.
//!
//! Confidence intervals are asymptotic, from the Fisher information of the fitted parameters carried to the result by the
//! delta method; they take maxima, or blocks, for independent, which the maxima of a narrow-banded process are not.
//! Simulated (tests/data/post/intervals.py) they hold the true value in 94.3 per cent of samples of 300 maxima, in 93.4 of 30 blocks.

use super::{SeriesError, finite};
use std::f64::consts::PI;

/// Euler's constant: the mean of a standard Gumbel variable.
pub const EULER: f64 = 0.577_215_664_901_532_9;
/// Fewest maxima a Weibull distribution is fitted to: below, its exponent is off by more than 15 per cent (one deviation).
pub const FEWEST_MAXIMA: usize = 30;
/// Fewest blocks a Gumbel distribution is fitted to.
pub const FEWEST_BLOCKS: usize = 10;
/// Two-sided 95 per cent of a normal variable, in deviations.
const NINETY_FIVE: f64 = 1.959_963_984_540_054;

/// The largest value in a duration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExpectedExtreme {
    /// Most probable maximum, the mode of its distribution.
    pub most_probable: f64,
    /// Expected maximum, the mean of its distribution.
    pub expected: f64,
    /// 95 per cent confidence interval of the most probable maximum; `None` where the distribution is taken as known.
    pub interval: Option<(f64, f64)>,
}

/// Number of cycles, or blocks, in a duration.
fn number(duration: f64, period: f64) -> Result<f64, SeriesError> {
    for (what, value) in [("the duration", duration), ("the period", period)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(SeriesError::Setting { what, expected: "greater than zero", value });
        }
    }
    let n = duration / period;
    if n < 2.0 {
        return Err(SeriesError::Refused(format!("the duration holds {n:.3} cycles; an extreme needs at least two")));
    }
    Ok(n)
}

/// Largest crest of a narrow-banded Gaussian process in a duration (s), crests being Rayleigh distributed: with
/// N = duration / mean up-crossing period, mode `mean + s sqrt(2 ln N)` and mean `mean + s (sqrt(2 ln N) + 0.5772 / sqrt(2
/// ln N))`. [LONGUET-HIGGINS-1952; DNV-RP-C205 Extreme values].
///
/// # Errors
/// A duration with fewer than two cycles; a deviation that is negative or not finite.
pub fn rayleigh(mean: f64, deviation: f64, period: f64, duration: f64) -> Result<ExpectedExtreme, SeriesError> {
    if !(deviation.is_finite() && deviation >= 0.0 && mean.is_finite()) {
        let expected = "finite and not negative";
        return Err(SeriesError::Setting { what: "the standard deviation", expected, value: deviation });
    }
    let root = (2.0 * number(duration, period)?.ln()).sqrt();
    Ok(ExpectedExtreme {
        most_probable: mean + deviation * root,
        expected: mean + deviation * (root + EULER / root),
        interval: None,
    })
}

/// A Weibull distribution of maxima above a level: F(x) = 1 - exp(-((x - location) / scale)^shape).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weibull {
    /// The level the maxima lie above.
    pub location: f64,
    /// Scale.
    pub scale: f64,
    /// Exponent: 2 of Rayleigh maxima, 1 of an exponential tail.
    pub shape: f64,
    /// Maxima it was fitted to.
    pub count: usize,
}

/// Largest and smallest exponent sought.
const SHAPES: (f64, f64) = (1e-2, 1e3);

impl Weibull {
    /// The distribution of greatest likelihood with a known location: the exponent solves
    /// `sum x^b ln x / sum x^b - 1/b = mean of ln x` [COHEN-1965], whose left side grows with b.
    /// The location is the level whose up-crossings part the maxima (their mean, as for global maxima in [DNV-RP-C205]).
    ///
    /// # Errors
    /// Fewer maxima than [`FEWEST_MAXIMA`], a maximum at or below the level, maxima that are all alike.
    pub fn fit(maxima: &[f64], location: f64) -> Result<Weibull, SeriesError> {
        finite(maxima)?;
        let got = maxima.len();
        if got < FEWEST_MAXIMA {
            let what = "a Weibull fit (of maxima between up-crossings of the mean)";
            return Err(SeriesError::TooFew { what, need: FEWEST_MAXIMA, got });
        }
        let largest = maxima.iter().fold(0.0, |m: f64, x| m.max(x - location));
        if let Some(x) = maxima.iter().find(|x| **x <= location) {
            return Err(SeriesError::Refused(format!("the maximum {x} is not above the level {location}")));
        }
        // over the largest, so that no power overflows
        let logs: Vec<f64> = maxima.iter().map(|x| ((x - location) / largest).ln()).collect();
        let mean_log = logs.iter().sum::<f64>() / got as f64;
        let sums = |b: f64| {
            logs.iter().fold((0.0, 0.0), |(s, sl), l| {
                let power = (b * l).exp();
                (s + power, sl + power * l)
            })
        };
        let excess = |b: f64| {
            let (s, sl) = sums(b);
            sl / s - 1.0 / b - mean_log
        };
        let (mut low, mut high) = SHAPES;
        if excess(high) < 0.0 {
            return Err(SeriesError::Constant);
        }
        while high / low > 1.0 + 4.0 * f64::EPSILON {
            let middle = (low * high).sqrt();
            if middle <= low || middle >= high {
                break;
            }
            if excess(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let shape = (low * high).sqrt();
        let scale = largest * (sums(shape).0 / got as f64).powf(1.0 / shape);
        Ok(Weibull { location, scale, shape, count: got })
    }

    /// Largest maximum in a duration (s), the maxima coming every `period` (s): with N of them, the mode of the largest is
    /// `location + scale (ln N)^(1/shape)` and its distribution tends to a Gumbel one with the scale
    /// `scale / shape (ln N)^(1/shape - 1)`, which gives the mean [DNV-RP-C205 Extreme values; GUMBEL-1958].
    ///
    /// # Errors
    /// A duration with fewer than two cycles.
    pub fn extreme(&self, period: f64, duration: f64) -> Result<ExpectedExtreme, SeriesError> {
        let log = number(duration, period)?.ln();
        let above = self.scale * log.powf(1.0 / self.shape);
        let spread = above / (self.shape * log);
        // inverse information of (ln scale, shape): 6/pi^2 and Euler's constant make 1.1087, 0.2570 and 0.6079
        let n = self.count as f64;
        let (b, slope) = (self.shape, -log.ln() / (self.shape * self.shape));
        let six = 6.0 / (PI * PI);
        let var_scale = (1.0 + six * (1.0 - EULER).powi(2)) / (n * b * b);
        let covariance = six * (1.0 - EULER) / n;
        let var_shape = six * b * b / n;
        let deviation = (var_scale + 2.0 * slope * covariance + slope * slope * var_shape).max(0.0).sqrt();
        let factor = (NINETY_FIVE * deviation).exp();
        Ok(ExpectedExtreme {
            most_probable: self.location + above,
            expected: self.location + above + EULER * spread,
            interval: Some((self.location + above / factor, self.location + above * factor)),
        })
    }
}

/// A Gumbel distribution of the largest value in a block: F(x) = exp(-exp(-(x - location) / scale)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gumbel {
    /// Mode.
    pub location: f64,
    /// Scale.
    pub scale: f64,
    /// Blocks it was fitted to.
    pub count: usize,
}

impl Gumbel {
    /// The distribution of greatest likelihood of the maxima of blocks.
    ///
    /// # Errors
    /// Fewer blocks than [`FEWEST_BLOCKS`], maxima that are all alike.
    pub fn fit(maxima: &[f64]) -> Result<Gumbel, SeriesError> {
        finite(maxima)?;
        let got = maxima.len();
        if got < FEWEST_BLOCKS {
            return Err(SeriesError::TooFew { what: "a Gumbel fit (of maxima of blocks)", need: FEWEST_BLOCKS, got });
        }
        Gumbel::fit_likelihood(maxima)
    }

    /// The same of however many maxima: the scale solves `s = mean x - sum x e^(-x/s) / sum e^(-x/s)`, and the
    /// location is `-s ln(mean e^(-x/s))` (N. L. Johnson, S. Kotz, "Continuous Univariate Distributions", ch. 22).
    ///
    /// # Errors
    /// Maxima that are not finite, all alike, or none.
    pub fn fit_likelihood(maxima: &[f64]) -> Result<Gumbel, SeriesError> {
        finite(maxima)?;
        let got = maxima.len();
        if got == 0 {
            return Err(SeriesError::TooFew { what: "a Gumbel fit", need: 1, got });
        }
        let least = maxima.iter().fold(f64::INFINITY, |m, x| m.min(*x));
        let mean = maxima.iter().map(|x| x - least).sum::<f64>() / got as f64;
        let spread = maxima.iter().fold(0.0, |m: f64, x| m.max(x - least));
        if mean <= 0.0 {
            return Err(SeriesError::Constant);
        }
        // above the least, so that no exponential overflows
        let sums = |s: f64| {
            maxima.iter().fold((0.0, 0.0), |(sum, weighted), x| {
                let e = (-(x - least) / s).exp();
                (sum + e, weighted + e * (x - least))
            })
        };
        let excess = |s: f64| {
            let (sum, weighted) = sums(s);
            s - mean + weighted / sum
        };
        // the weighted mean lies between the least and the mean: the scale is between 0 and the mean
        let (mut low, mut high) = (spread * 1e-9, mean);
        for _ in 0..200 {
            let middle = low.midpoint(high);
            if middle <= low || middle >= high {
                break;
            }
            if excess(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let scale = low.midpoint(high);
        let location = least - scale * (sums(scale).0 / got as f64).ln();
        Ok(Gumbel { location, scale, count: got })
    }

    /// Largest value in a duration (s), blocks being `block` (s) long: the mode grows by `scale ln(duration / block)`.
    ///
    /// # Errors
    /// A duration or block that is not greater than zero.
    pub fn extreme(&self, block: f64, duration: f64) -> Result<ExpectedExtreme, SeriesError> {
        for (what, value) in [("the duration", duration), ("the length of a block", block)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(SeriesError::Setting { what, expected: "greater than zero", value });
            }
        }
        let growth = (duration / block).ln();
        let six = 6.0 / (PI * PI);
        let part = 1.0 - EULER + growth;
        // variances 1.1087 and 0.6079, covariance 0.2570, in scale^2 / count
        let deviation = self.scale * ((1.0 + six * part * part) / self.count as f64).sqrt();
        let mode = self.location + self.scale * growth;
        Ok(ExpectedExtreme {
            most_probable: mode,
            expected: mode + EULER * self.scale,
            interval: Some((mode - NINETY_FIVE * deviation, mode + NINETY_FIVE * deviation)),
        })
    }
}

/// The largest value of each of a number of blocks of equal samples; the samples left over at the end are in none.
///
/// # Errors
/// No blocks, or more blocks than values.
pub fn block_maxima(values: &[f64], blocks: usize) -> Result<Vec<f64>, SeriesError> {
    finite(values)?;
    if blocks == 0 || blocks > values.len() {
        let expected = "at least 1 and at most the number of values";
        return Err(SeriesError::Setting { what: "the number of blocks", expected, value: blocks as f64 });
    }
    let length = values.len() / blocks;
    Ok(values.chunks_exact(length).take(blocks).map(|b| b.iter().copied().fold(f64::MIN, f64::max)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Plotting positions (i + 1/2) / n through an inverse distribution: a sample without chance.
    fn sample(n: usize, inverse: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..n).map(|i| inverse((i as f64 + 0.5) / n as f64)).collect()
    }

    #[test]
    fn largest_of_1000_rayleigh_crests_is_3_7_standard_deviations() {
        // sqrt(2 ln 1000) = 3.7169; 3.7169 + 0.5772/3.7169 = 3.8722 [LONGUET-HIGGINS-1952]
        let e = rayleigh(10.0, 2.0, 10.0, 1e4).unwrap();
        assert!((e.most_probable - 17.4338).abs() < 1e-4, "{e:?}");
        assert!((e.expected - 17.7444).abs() < 1e-4, "{e:?}");
        assert!(rayleigh(0.0, 1.0, 10.0, 15.0).is_err() && rayleigh(0.0, -1.0, 1.0, 100.0).is_err());
        assert!(rayleigh(0.0, 1.0, 0.0, 100.0).is_err());
    }

    #[test]
    fn fit_recovers_parent_distribution() {
        let x = sample(2000, |p| 5.0 + 3.0 * (-(1.0 - p).ln()).powf(1.0 / 1.5));
        let w = Weibull::fit(&x, 5.0).unwrap();
        // 2000 plotting positions cut the tail off: a per cent of the exponent
        assert!((w.shape - 1.5).abs() < 0.01 && (w.scale - 3.0).abs() < 0.01, "{w:?}");
        let x = sample(2000, |p| 7.0 - 2.0 * (-p.ln()).ln());
        let g = Gumbel::fit(&x).unwrap();
        assert!((g.location - 7.0).abs() < 0.01 && (g.scale - 2.0).abs() < 0.01, "{g:?}");
    }

    #[test]
    fn rayleigh_maxima_give_rayleigh_extreme() {
        let w = Weibull { location: 10.0, scale: 2.0 * 2.0f64.sqrt(), shape: 2.0, count: 1000 };
        let (e, r) = (w.extreme(10.0, 1e4).unwrap(), rayleigh(10.0, 2.0, 10.0, 1e4).unwrap());
        assert!((e.most_probable - r.most_probable).abs() < 1e-12 && (e.expected - r.expected).abs() < 1e-12);
        let (low, high) = e.interval.unwrap();
        assert!(low < e.most_probable && high > e.most_probable);
    }

    #[test]
    fn mode_interval_of_one_block_matches_location_interval() {
        // variance of the fitted location 1.1087 s^2 / n (Johnson and Kotz, ch. 22)
        let g = Gumbel { location: 4.0, scale: 2.0, count: 100 };
        let (low, high) = g.extreme(60.0, 60.0).unwrap().interval.unwrap();
        let want = 1.959964 * 2.0 * (1.1087f64 / 100.0).sqrt();
        assert!(((high - low) / 2.0 - want).abs() < 1e-4);
        let doubled = g.extreme(60.0, 120.0).unwrap();
        assert!((doubled.most_probable - (4.0 + 2.0 * 2.0f64.ln())).abs() < 1e-14);
        assert!((doubled.expected - doubled.most_probable - 2.0 * EULER).abs() < 1e-14);
    }

    #[test]
    fn too_few_or_equal_maxima_are_refused() {
        let few = Weibull::fit(&[1.0; 5], 0.0).unwrap_err().to_string();
        assert!(few.contains("at least 30") && few.contains("there are 5"), "{few}");
        assert_eq!(Weibull::fit(&[1.0; 50], 0.0), Err(SeriesError::Constant));
        assert!(Weibull::fit(&[1.0; 50], 1.0).is_err());
        assert_eq!(Gumbel::fit(&[1.0; 50]), Err(SeriesError::Constant));
        assert!(Gumbel::fit(&[1.0; 3]).is_err());
    }

    #[test]
    fn blocks_share_samples_evenly() {
        assert_eq!(block_maxima(&[1.0, 5.0, 2.0, 3.0, 9.0], 2), Ok(vec![5.0, 3.0]));
        assert!(block_maxima(&[1.0], 2).is_err() && block_maxima(&[], 0).is_err());
    }
}
