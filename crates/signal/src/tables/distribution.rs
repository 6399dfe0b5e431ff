//! Histograms, exceedance and rainflow of series as tables.

use super::{SIX_DIGITS, SeriesRecord, numbers};
use crate::distribution::{self, levels};
use crate::rainflow::{cycles, range_mean};
use crate::{SeriesError, statistics};
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::Dim;

/// Values counted into equal bins, with the share of each.
///
/// # Errors
/// As [`distribution::histogram`].
pub fn histogram(record: &SeriesRecord, bins: usize) -> Result<Table, SeriesError> {
    let mut columns = Vec::new();
    for series in &record.series {
        let found = distribution::histogram(&series.values, bins)?;
        let (name, count) = (&series.name, series.values.len() as f64);
        columns.push(Column::new(name, "From", series.dim, SIX_DIGITS, numbers(found.iter().map(|b| b.low))));
        columns.push(Column::new(name, "To", series.dim, SIX_DIGITS, numbers(found.iter().map(|b| b.high))));
        columns.push(Column::new(name, "Count", Dim::None, Digits::Usual, found.iter().map(|b| b.count)));
        let shares = numbers(found.iter().map(|b| b.count as f64 / count));
        columns.push(Column::new(name, "Share", Dim::None, Digits::Decimals(6), shares));
    }
    Ok(Table::from_columns(format!("Histogram of {}", record.title), columns))
}

/// Share of values, and of maxima between crossings of the mean, above equally spaced levels; beside them what a Gaussian
/// process of the same deviation has of maxima: exp(-x^2 / 2 s^2) above the mean.
///
/// # Errors
/// As [`distribution::levels`].
pub fn exceedance(record: &SeriesRecord, count: usize) -> Result<Table, SeriesError> {
    let mut columns = Vec::new();
    for series in &record.series {
        let at = levels(&series.values, count)?;
        let moments = statistics::moments(&series.values)?;
        let crossings = statistics::crossings(&record.times, &series.values, moments.mean)?;
        let maxima: Vec<f64> = crossings.maxima.iter().map(|p| p.value).collect();
        let of_maxima = if maxima.is_empty() {
            vec![Cell::Missing; at.len()]
        } else {
            numbers(distribution::exceedance(&maxima, &at))
        };
        let rayleigh = |x: &f64| {
            let over = (x - moments.mean).max(0.0) / moments.deviation;
            if moments.deviation > 0.0 { Cell::Number((-0.5 * over * over).exp()) } else { Cell::Missing }
        };
        let name = &series.name;
        columns.push(Column::new(name, "Level", series.dim, SIX_DIGITS, numbers(at.iter().copied())));
        columns.push(Column::new(
            name,
            "Values",
            Dim::None,
            SIX_DIGITS,
            numbers(distribution::exceedance(&series.values, &at)),
        ));
        columns.push(Column::new(name, "Maxima", Dim::None, SIX_DIGITS, of_maxima));
        columns.push(Column::new(name, "Rayleigh", Dim::None, SIX_DIGITS, at.iter().map(rayleigh)));
    }
    let mut table = Table::from_columns(format!("Exceedance of {}", record.title), columns);
    table.note("shares of values and of maxima between crossings of the mean that are greater than the level");
    Ok(table)
}

/// Rainflow cycles of each series. With bins, counted by range and, when `means` is above 1, by mean, one row a bin that holds
/// any; without (`bins` 0) every cycle in the order it closes, the residual as half cycles behind.
///
/// # Errors
/// As [`range_mean`].
pub fn rainflow(record: &SeriesRecord, bins: usize, means: usize) -> Result<Table, SeriesError> {
    let mut columns = Vec::new();
    for series in &record.series {
        let found = cycles(&series.values)?;
        let (name, dim) = (&series.name, series.dim);
        let mut add = |head: &str, dim: Dim, digits: Digits, cells: Vec<Cell>| {
            columns.push(Column::new(name, head, dim, digits, cells));
        };
        let count = Digits::Decimals(1);
        if bins == 0 {
            add("Range", dim, SIX_DIGITS, numbers(found.iter().map(|c| c.range)));
            add("Mean", dim, SIX_DIGITS, numbers(found.iter().map(|c| c.mean)));
            add("Cycles", Dim::None, count, numbers(found.iter().map(|c| c.count)));
            continue;
        }
        let counted = range_mean(&found, bins, means)?;
        let mut rows: Vec<[f64; 5]> = Vec::new();
        for (i, row) in counted.counts.iter().enumerate() {
            for (j, cycles) in row.iter().enumerate().filter(|(_, c)| **c > 0.0) {
                let range = counted.range_width * i as f64;
                let mean = counted.mean_start + counted.mean_width * j as f64;
                rows.push([range, range + counted.range_width, mean, mean + counted.mean_width, *cycles]);
            }
        }
        let of = |position: usize| numbers(rows.iter().filter_map(|r| r.get(position).copied()));
        add("Range from", dim, SIX_DIGITS, of(0));
        add("Range to", dim, SIX_DIGITS, of(1));
        if means > 1 {
            add("Mean from", dim, SIX_DIGITS, of(2));
            add("Mean to", dim, SIX_DIGITS, of(3));
        }
        add("Cycles", Dim::None, count, of(4));
    }
    let mut table = Table::from_columns(format!("Rainflow Cycles of {}", record.title), columns);
    table.note("ASTM E1049, rainflow counting; ranges the series does not close are half cycles");
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::super::TableSeries;
    use super::*;

    fn record() -> SeriesRecord {
        let values = vec![-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0];
        let times = (0..9).map(f64::from).collect();
        SeriesRecord {
            title: "t".into(),
            series: vec![TableSeries { name: "S".into(), dim: Dim::Force, values }],
            times,
        }
    }

    #[test]
    fn rainflow_table_matches_standard_example_as_cycles_and_bins() {
        let all = rainflow(&record(), 0, 1).unwrap();
        assert_eq!(all.get("Cycles").unwrap().numbers().iter().sum::<f64>(), 4.0);
        // ranges 3 4 6 8 9 in bins of 1 from 0 to 9: those of 8 and 9 share the last
        let binned = rainflow(&record(), 9, 1).unwrap();
        assert_eq!(binned.columns()[0].numbers(), [3.0, 4.0, 6.0, 8.0]);
        assert_eq!(binned.get("Cycles").unwrap().numbers(), [0.5, 1.5, 0.5, 1.5]);
        let by_mean = rainflow(&record(), 9, 4).unwrap();
        assert_eq!(by_mean.get("Cycles").unwrap().numbers().iter().sum::<f64>(), 4.0);
    }

    #[test]
    fn exceedance_shares_fall_with_level() {
        let t = exceedance(&record(), 5).unwrap();
        assert_eq!(t.columns()[0].numbers(), [-4.0, -1.75, 0.5, 2.75, 5.0]);
        // maxima between crossings of the mean 1/9: 1, 5, 3 and 4
        assert_eq!(t.columns()[2].numbers(), [1.0, 1.0, 1.0, 0.75, 0.0]);
        let h = histogram(&record(), 3).unwrap();
        assert_eq!(h.get("Count").unwrap().numbers().iter().sum::<f64>(), 9.0);
        assert!((h.get("Share").unwrap().numbers().iter().sum::<f64>() - 1.0).abs() < 1e-15);
    }
}
