//! Statistics of a Gaussian response.
//!
//! Maxima of a narrow-banded Gaussian process have Rayleigh's distribution [LONGUET-HIGGINS-1952]: of N of them the most probable
//! largest is `sigma sqrt(2 ln N)` [DNV-RP-C205 3.5.11], with `N = duration / Tz`, `Tz = 2 pi sqrt(m0/m2)`.

use super::quantity::{Derivative, LinearQuantity};
use super::response::{FrequencyResponse, ResponsePoint};
use std::f64::consts::TAU;

/// Which amplitude about the mean is reported as the extreme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ExtremeKind {
    /// The most probable largest one in a time (s).
    MostProbable(f64),
    /// A multiple of the standard deviation.
    Times(f64),
    /// The one that this share of the amplitudes exceeds, `sigma sqrt(-2 ln p)` by Rayleigh's distribution.
    Exceeded(f64),
}

/// Statistics of a quantity about its mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResponseStatistics {
    /// Its mean; zero of a derivative.
    pub mean: f64,
    /// Standard deviation at the frequencies of the waves.
    pub waves: f64,
    /// Standard deviation of slow drift.
    pub slow: f64,
    /// Standard deviation of both.
    pub deviation: f64,
    /// Mean period between zero up-crossings (s); `None` without motion.
    pub period: Option<f64>,
}

impl ResponseStatistics {
    /// Those of a quantity, or a derivative of it, in a response.
    pub fn new(response: &FrequencyResponse, quantity: &LinearQuantity, derivative: Derivative) -> Self {
        let moments = |points: &[ResponsePoint]| {
            points.iter().fold([0.0; 2], |[m0, m2], p| {
                let [own, own_2] = p.moments(quantity, derivative);
                [m0 + own, m2 + own_2]
            })
        };
        let ([waves, waves_2], [slow, slow_2]) = (moments(&response.waves), moments(&response.slow));
        let mean = if derivative == Derivative::Place { quantity.mean } else { 0.0 };
        ResponseStatistics::from_moments(mean, [waves, slow], waves_2 + slow_2)
    }

    /// Those of variances of waves and slow drift, and the second moment of both together.
    pub fn from_moments(mean: f64, [waves, slow]: [f64; 2], second: f64) -> Self {
        let all = waves + slow;
        let period = (all > 0.0 && second > 0.0).then(|| TAU * (all / second).sqrt());
        ResponseStatistics { mean, waves: waves.sqrt(), slow: slow.sqrt(), deviation: all.sqrt(), period }
    }

    /// The mean of the highest third of the amplitudes, in the SI unit of the quantity: twice the deviation.
    pub fn significant(&self) -> f64 {
        2.0 * self.deviation
    }

    /// An extreme amplitude about the mean, in the quantity's unit; `None` where it is not defined.
    pub fn extreme(&self, extreme: ExtremeKind) -> Option<f64> {
        match extreme {
            ExtremeKind::MostProbable(duration) => self.most_probable(duration),
            ExtremeKind::Times(factor) => Some(factor * self.deviation),
            ExtremeKind::Exceeded(share) => Some(self.deviation * (-2.0 * share.ln()).sqrt()),
        }
    }

    /// The most probable largest amplitude in a time (s), about the mean; `None` where that is no more than one period.
    pub fn most_probable(&self, duration: f64) -> Option<f64> {
        let count = duration / self.period?;
        (count > 1.0).then(|| self.deviation * (2.0 * count.ln()).sqrt())
    }
}
