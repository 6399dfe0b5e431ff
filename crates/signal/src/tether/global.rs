//! Global statistics of a tether record [AQWA-TETHER 7.5 to 7.8].

use crate::rainflow::reversals;
use crate::{SeriesError, finite};

/// The ten numbers of one column of the statistics of type 1.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct GlobalStatistics {
    /// Mean.
    pub mean: f64,
    /// Twice the root mean square about the mean, "significant" in the manual's words.
    pub significant: f64,
    /// Mean of the highest third of the maxima, above the mean. Every local maximum counts, also one below the mean.
    pub highest_third: f64,
    /// Mean of the lowest third of the minima, above the mean (a negative number).
    pub lowest_third: f64,
    /// The three largest maxima, largest first; 0 where there are fewer.
    pub maxima: [f64; 3],
    /// The three smallest minima, smallest first; 0 where there are fewer.
    pub minima: [f64; 3],
}

/// Mean and root mean square about it, in the unit of the values; zeros of no values.
pub fn spread(values: &[f64]) -> (f64, f64) {
    let count = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / count;
    let square = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / count;
    (mean, square.sqrt())
}

/// The statistics of one series, in its unit.
///
/// # Errors
/// No values, or one that is not finite.
pub fn global(values: &[f64]) -> Result<GlobalStatistics, SeriesError> {
    finite(values)?;
    if values.is_empty() {
        return Err(SeriesError::TooFew { what: "statistics of records", need: 1, got: 0 });
    }
    let (mean, rms) = spread(values);
    let points = reversals(values);
    let (mut maxima, mut minima) = (Vec::new(), Vec::new());
    for window in points.windows(3) {
        if let [before, here, _] = window {
            if here > before { maxima.push(*here) } else { minima.push(*here) }
        }
    }
    maxima.sort_by(|a, b| b.total_cmp(a));
    minima.sort_by(f64::total_cmp);
    // both lists begin with the extreme that lies furthest from the mean
    let third = |found: &[f64]| {
        let part = found.get(..found.len() / 3).unwrap_or_default();
        if part.is_empty() { 0.0 } else { part.iter().sum::<f64>() / part.len() as f64 - mean }
    };
    let (highest_third, lowest_third) = (third(&maxima), third(&minima));
    let three = |found: &[f64]| std::array::from_fn(|i| found.get(i).copied().unwrap_or(0.0));
    Ok(GlobalStatistics {
        mean,
        significant: 2.0 * rms,
        highest_third,
        lowest_third,
        maxima: three(&maxima),
        minima: three(&minima),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_significant_amplitude_is_root_two_and_third_is_amplitude() {
        let values: Vec<f64> =
            (0..4000).map(|i| 3.0 + 2.0 * (f64::from(i) * std::f64::consts::TAU / 40.0).sin()).collect();
        let found = global(&values).unwrap_or_default();
        assert!((found.mean - 3.0).abs() < 1e-12 && (found.significant - 2.0 * 2.0_f64.sqrt()).abs() < 1e-12);
        assert!((found.highest_third - 2.0).abs() < 1e-12 && (found.lowest_third + 2.0).abs() < 1e-12);
        assert!(found.maxima.iter().all(|m| (m - 5.0).abs() < 1e-12));
    }

    /// Six maxima 4 to 9 between minima at 0 and -1: the highest third of the maxima is 8 and 9. Of all thirteen extremes, maxima and minima in
    /// one list, the highest third is 6 to 9.
    #[test]
    fn thirds_are_of_maxima_and_of_minima_apart() {
        let values = [0.0, 4.0, -1.0, 5.0, 0.0, 6.0, -2.0, 7.0, 0.0, 8.0, -3.0, 9.0, 0.0];
        let found = global(&values).unwrap_or_default();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        assert!((found.highest_third + mean - 8.5).abs() < 1e-12);
        // minima inside the series: -1, 0, -2, 0, -3; a third of five is one
        assert!((found.lowest_third + mean + 3.0).abs() < 1e-12);
    }

    #[test]
    fn constant_record_has_no_peaks() {
        assert_eq!(
            global(&[1.0; 5]).unwrap_or_default(),
            GlobalStatistics { mean: 1.0, ..GlobalStatistics::default() }
        );
    }
}
