//! Rainflow counting [ASTM-E1049 5.4.4]: ranges that no later reversal closes count as half
//! cycles.

use super::{SeriesError, finite};

/// Cycles of one range and mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RainflowCycle {
    /// Peak to valley.
    pub range: f64,
    /// Mean of peak and valley.
    pub mean: f64,
    /// 1, or 0.5 for what the series does not close.
    pub count: f64,
}

impl RainflowCycle {
    fn from_extremes(a: f64, b: f64, count: f64) -> Self {
        RainflowCycle { range: (a - b).abs(), mean: a.midpoint(b), count }
    }
}

/// The reversals of a series, in its unit: its first and last value and the turning points between them; of a flat turning point the
/// first sample.
pub fn reversals(values: &[f64]) -> Vec<f64> {
    let mut out: Vec<f64> = Vec::new();
    for value in values {
        match out.as_slice() {
            [.., last] if last == value => {}
            [.., before, last] if (last > before) == (value > last) => {
                out.pop();
                out.push(*value);
            }
            _ => out.push(*value),
        }
    }
    out
}

/// The cycles of a series in the order they close, then the residual as half cycles.
///
/// # Errors
/// A value that is not finite.
pub fn cycles(values: &[f64]) -> Result<Vec<RainflowCycle>, SeriesError> {
    finite(values)?;
    let mut out = Vec::new();
    let mut open: Vec<f64> = Vec::new();
    // reversals before this place have been discarded at the start, as rule 5 of the standard does
    let mut start = 0;
    for point in reversals(values) {
        open.push(point);
        while let [.., a, b, c] = open.get(start..).unwrap_or_default() {
            let (latest, previous) = ((c - b).abs(), (b - a).abs());
            if latest < previous {
                break;
            }
            if open.len() - start == 3 {
                // the range holds the starting point: half a cycle, and the start moves on
                out.push(RainflowCycle::from_extremes(*a, *b, 0.5));
                start += 1;
            } else {
                out.push(RainflowCycle::from_extremes(*a, *b, 1.0));
                let keep = open.len() - 3;
                let last = *c;
                open.truncate(keep);
                open.push(last);
            }
        }
    }
    let residual = open.get(start..).unwrap_or_default().windows(2);
    out.extend(residual.filter_map(|w| match w {
        [a, b] => Some(RainflowCycle::from_extremes(*a, *b, 0.5)),
        _ => None,
    }));
    Ok(out)
}

/// Cycles counted into bins of range and mean.
#[derive(Clone, Debug, PartialEq)]
pub struct RangeMean {
    /// Width of a range bin; the first begins at 0.
    pub range_width: f64,
    /// Lower end of the first mean bin.
    pub mean_start: f64,
    /// Width of a mean bin.
    pub mean_width: f64,
    /// Counts: one row a range bin, one place a mean bin.
    pub counts: Vec<Vec<f64>>,
}

/// Most bins in either direction: a table larger than that has no reader.
pub const MAX_BINS: usize = 1000;

/// Counts cycles into equal bins of range, from 0 to the largest, and of mean, from the least to the largest. A cycle on
/// an edge belongs to the bin above it, the largest to the last.
///
/// # Errors
/// No cycles; a number of bins that is 0 or above [`MAX_BINS`].
pub fn range_mean(cycles: &[RainflowCycle], ranges: usize, means: usize) -> Result<RangeMean, SeriesError> {
    for bins in [ranges, means] {
        if !(1..=MAX_BINS).contains(&bins) {
            let expected = "between 1 and 1000";
            return Err(SeriesError::Setting { what: "the number of bins", expected, value: bins as f64 });
        }
    }
    if cycles.is_empty() {
        return Err(SeriesError::TooFew { what: "a histogram of cycles", need: 1, got: 0 });
    }
    let largest = cycles.iter().map(|c| c.range).fold(0.0, f64::max);
    let (low, high) = cycles.iter().fold((f64::MAX, f64::MIN), |(l, h), c| (l.min(c.mean), h.max(c.mean)));
    let width = |span: f64, bins: usize| if span > 0.0 { span / bins as f64 } else { 1.0 };
    let (range_width, mean_width) = (width(largest, ranges), width(high - low, means));
    let mut counts = vec![vec![0.0; means]; ranges];
    for cycle in cycles {
        let row = ((cycle.range / range_width) as usize).min(ranges - 1);
        let position = (((cycle.mean - low) / mean_width) as usize).min(means - 1);
        if let Some(cell) = counts.get_mut(row).and_then(|r| r.get_mut(position)) {
            *cell += cycle.count;
        }
    }
    Ok(RangeMean { range_width, mean_start: low, mean_width, counts })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn count_cycles_of_range(cycles: &[RainflowCycle], range: f64) -> f64 {
        cycles.iter().filter(|c| c.range == range).map(|c| c.count).sum()
    }

    #[test]
    fn rainflow_counts_match_standard_example() {
        // [ASTM-E1049 figure 6]: A -2, B 1, C -3, D 5, E -1, F 3, G -4, H 4, I -2
        let found = cycles(&[-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0]).unwrap();
        let want = [(3.0, 0.5), (4.0, 1.5), (6.0, 0.5), (8.0, 1.0), (9.0, 0.5)];
        for (range, count) in want {
            assert_eq!(count_cycles_of_range(&found, range), count, "range {range}: {found:?}");
        }
        assert_eq!(found.iter().map(|c| c.count).sum::<f64>(), 4.0);
        // the whole cycle is E-F, from -1 to 3
        assert!(found.contains(&RainflowCycle { range: 4.0, mean: 1.0, count: 1.0 }));
    }

    #[test]
    fn samples_between_reversals_do_not_change_cycles() {
        let fine = [-2.0, -1.0, 0.0, 1.0, 1.0, -1.0, -3.0, 0.0, 5.0, 5.0, 2.0, -1.0, 3.0, -4.0, -4.0, 4.0, -2.0];
        let coarse = [-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0];
        assert_eq!(cycles(&fine), cycles(&coarse));
        assert_eq!(reversals(&fine), coarse);
    }

    #[test]
    fn series_without_reversals_has_at_most_half_cycle() {
        assert_eq!(cycles(&[1.0, 2.0, 4.0]), Ok(vec![RainflowCycle { range: 3.0, mean: 2.5, count: 0.5 }]));
        assert_eq!(cycles(&[2.0, 2.0]), Ok(vec![]));
        assert_eq!(cycles(&[]), Ok(vec![]));
        assert!(cycles(&[f64::NAN]).is_err());
    }

    #[test]
    fn histogram_keeps_every_cycle_in_its_bin() {
        let found = cycles(&[-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0]).unwrap();
        let table = range_mean(&found, 3, 2).unwrap();
        assert_eq!(table.range_width, 3.0);
        let rows: Vec<f64> = table.counts.iter().map(|r| r.iter().sum()).collect();
        // [0, 3) none; [3, 6) 3 and 4; [6, 9] 6, 8 and 9
        assert_eq!(rows, [0.0, 2.0, 2.0]);
        assert!(range_mean(&[], 3, 2).is_err() && range_mean(&found, 0, 2).is_err());
    }

    proptest! {
        #[test]
        fn every_reversal_is_counted_once(x in prop::collection::vec(-5i32..5, 0..200)) {
            let x: Vec<f64> = x.iter().map(|v| f64::from(*v)).collect();
            let found = cycles(&x).unwrap();
            let halves: f64 = found.iter().map(|c| 2.0 * c.count).sum();
            prop_assert_eq!(halves as usize, reversals(&x).len().saturating_sub(1));
            // nothing is lost of the travelled way: each cycle is its range there and back
            let way: f64 = x.windows(2).map(|w| (w[1] - w[0]).abs()).sum();
            let counted: f64 = found.iter().map(|c| 2.0 * c.count * c.range).sum();
            prop_assert!((way - counted).abs() < 1e-9);
        }
    }
}
