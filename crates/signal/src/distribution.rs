//! How values are distributed: histogram and exceedance.

use super::{SeriesError, finite};

/// Most bins or levels: a table larger than that has no reader.
pub const MAX_LEVELS: usize = 10_000;

/// A bin of a histogram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bin {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Values in it: from the lower end up to, not on, the upper one; the last bin holds both its ends.
    pub count: usize,
}

fn span(values: &[f64], parts: usize, what: &'static str) -> Result<(f64, f64), SeriesError> {
    finite(values)?;
    if !(1..=MAX_LEVELS).contains(&parts) {
        return Err(SeriesError::Setting { what, expected: "between 1 and 10000", value: parts as f64 });
    }
    if values.is_empty() {
        return Err(SeriesError::TooFew { what: "a distribution of values", need: 1, got: 0 });
    }
    let (low, high) = values.iter().fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(*v), h.max(*v)));
    if (high - low).is_finite() {
        Ok((low, high))
    } else {
        Err(SeriesError::Refused("the values span more than a number holds".into()))
    }
}

/// Values counted into equal bins from the smallest to the largest.
///
/// # Errors
/// No values, one that is not finite, a number of bins out of range.
pub fn histogram(values: &[f64], bins: usize) -> Result<Vec<Bin>, SeriesError> {
    let (low, high) = span(values, bins, "the number of bins")?;
    let width = (high - low) / bins as f64;
    let edge = |i: usize| if i == bins { high } else { low + width * i as f64 };
    let mut out: Vec<Bin> = (0..bins).map(|i| Bin { low: edge(i), high: edge(i + 1), count: 0 }).collect();
    for value in values {
        let position = if width > 0.0 { (((value - low) / width) as usize).min(bins - 1) } else { 0 };
        if let Some(bin) = out.get_mut(position) {
            bin.count += 1;
        }
    }
    Ok(out)
}

/// Share of values above each of a number of equally spaced levels, from the smallest value to the largest.
///
/// # Errors
/// No values, one that is not finite, a number of levels out of range.
pub fn levels(values: &[f64], count: usize) -> Result<Vec<f64>, SeriesError> {
    let (low, high) = span(values, count, "the number of levels")?;
    let last = count.saturating_sub(1).max(1) as f64;
    Ok((0..count).map(|i| low + (high - low) * (i as f64 / last)).collect())
}

/// Share (0 to 1) of values that are greater than each level, in the unit of the values; 0 of no values.
pub fn exceedance(values: &[f64], levels: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let share = |level: &f64| {
        let at_most = sorted.partition_point(|v| v <= level);
        (sorted.len() - at_most) as f64 / sorted.len().max(1) as f64
    };
    levels.iter().map(share).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_is_in_one_bin() {
        let bins = histogram(&[0.0, 1.0, 1.9, 2.0, 3.9, 4.0], 4).unwrap();
        assert_eq!(bins.iter().map(|b| b.count).collect::<Vec<_>>(), [1, 2, 1, 2]);
        assert_eq!((bins[0].low, bins[3].high), (0.0, 4.0));
        assert_eq!(histogram(&[5.0; 3], 2).unwrap()[0].count, 3);
        assert!(histogram(&[], 2).is_err() && histogram(&[1.0], 0).is_err() && histogram(&[1.0], 20_000).is_err());
        assert!(histogram(&[-1e308, 1e308], 2).is_err());
    }

    #[test]
    fn exceedance_of_ramp_falls_evenly() {
        let ramp: Vec<f64> = (1..=100).map(f64::from).collect();
        assert_eq!(exceedance(&ramp, &[0.0, 25.0, 99.5, 100.0]), [1.0, 0.75, 0.01, 0.0]);
        let l = levels(&ramp, 4).unwrap();
        assert_eq!(l, [1.0, 34.0, 67.0, 100.0]);
        assert_eq!(exceedance(&[], &[1.0]), [0.0]);
    }
}
