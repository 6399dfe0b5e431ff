//! Harmonic analysis of series as a table.

use super::{SIX_DIGITS, SeriesRecord, numbers};
use crate::SeriesError;
use crate::harmonics::{Harmonic, analyse, find_period};
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::Dim;

/// What is asked of a harmonic analysis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Analysis {
    /// The period (s); `None`: found from the first series.
    pub period: Option<f64>,
    /// Number of harmonics.
    pub orders: usize,
    /// Most cycles used, the last ones; `None`: all whole ones.
    pub cycles: Option<usize>,
}

/// Share of the largest amplitude, or of the mean, below which an amplitude is rounding.
const ROUNDING_SHARE: f64 = 1e-12;

/// Amplitude and phase of the harmonics of each series, by order; order 0 is the mean.
///
/// # Errors
/// As [`analyse`] and [`find_period`].
pub fn harmonics(record: &SeriesRecord, asked: Analysis) -> Result<Table, SeriesError> {
    let first = record.series.first().ok_or(SeriesError::Constant)?;
    let period = asked.period.map_or_else(|| find_period(&record.times, &first.values), Ok)?;
    let orders: Vec<Cell> = (0..=asked.orders).map(Cell::from).collect();
    let periods = std::iter::once(Cell::Missing).chain((1..=asked.orders).map(|k| Cell::Number(period / k as f64)));
    let mut columns = vec![
        Column::new("", "Order", Dim::None, Digits::Usual, orders),
        Column::new("", "Period", Dim::Time, SIX_DIGITS, periods),
    ];
    let mut facts = Vec::new();
    let mut cycles = 0;
    for series in &record.series {
        let found = analyse(&record.times, &series.values, period, asked.orders, asked.cycles)?;
        let amplitudes = std::iter::once(found.mean).chain(found.harmonics.iter().map(|h| h.amplitude));
        columns.push(Column::new(&series.name, "Amplitude", series.dim, SIX_DIGITS, numbers(amplitudes)));
        // a harmonic that rounding left has no phase
        let size = found.harmonics.iter().fold(found.mean.abs(), |m, h| m.max(h.amplitude));
        let phase =
            |h: &Harmonic| if h.amplitude > ROUNDING_SHARE * size { Cell::Number(h.phase) } else { Cell::Missing };
        let phases = std::iter::once(Cell::Missing).chain(found.harmonics.iter().map(phase));
        columns.push(Column::new(&series.name, "Phase", Dim::Angle, Digits::Usual, phases));
        facts.push((format!("Residual rms of {}", series.name), found.residual, series.dim));
        cycles = found.cycles;
    }
    let mut table = Table::from_columns(format!("Harmonics of {}", record.title), columns)
        .fact("Period", period, Dim::Time)
        .fact("Cycles Used", cycles, Dim::None);
    for (name, value, dim) in facts {
        table = table.fact(&name, value, dim);
    }
    table.note("least squares over the last whole cycles: mean (order 0) + sum of amplitude cos(order 2 pi t / period + phase)");
    if asked.period.is_none() {
        table.note(format!("the period is that of the sine which fits {} best", first.name));
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::super::TableSeries;
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn period_of_first_series_applies_to_all() {
        let times: Vec<f64> = (0..400).map(|i| 0.25 * f64::from(i)).collect();
        let of = |a: f64, p: f64| times.iter().map(|t| 5.0 + a * (TAU * t / 10.0 + p).cos()).collect();
        let series = |name: &str, values| TableSeries { name: name.into(), dim: Dim::Force, values };
        let series = vec![series("A", of(2.0, 0.5)), series("B", of(3.0, -0.5))];
        let r = SeriesRecord { title: "t".into(), series, times };
        let t = harmonics(&r, Analysis { period: None, orders: 2, cycles: None }).unwrap();
        assert_eq!((t.columns().len(), t.rows()), (6, 3));
        let b = t.columns()[4].numbers();
        assert!((b[0] - 5.0).abs() < 1e-6 && (b[1] - 3.0).abs() < 1e-6 && b[2].abs() < 1e-6, "{b:?}");
    }
}
