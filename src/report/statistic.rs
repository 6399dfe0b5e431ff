//! `STATISTIC`: what a column amounts to.

use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_signal::SeriesError;
use windlass_signal::extremes::rayleigh;
use windlass_signal::statistics::{self, Crossings, Moments};
use windlass_signal::tables::{self, SeriesRecord};

/// Count, mean, standard deviation, and the extremes with the value of the independent column where they occur.
///
/// `independent` is the column of `table` that positions are given in; `columns` those described. The standard
/// deviation is that of the values themselves (divided by their number).
pub fn table(table: &Table, independent: Option<usize>, columns: &[usize]) -> Table {
    let at = independent.and_then(|i| table.columns().get(i));
    let (at_name, at_dim) = at.map_or(("Row".to_string(), Dim::None), |c| (format!("at {}", c.name), c.dim));
    let at_digits = if at.is_some() { Digits::Usual } else { Digits::Decimals(0) };
    let position = |extreme: Option<(usize, f64)>| match (extreme, at) {
        (Some((row, _)), Some(c)) => c.cells.get(row).cloned().unwrap_or(Cell::Missing),
        (Some((row, _)), None) => Cell::from(row + 1),
        (None, _) => Cell::Missing,
    };
    let rows: Vec<ColumnRange> = columns.iter().filter_map(|i| table.columns().get(*i)).map(ColumnRange::new).collect();
    Table::new(format!("Statistics of {}", table.title))
        .with_rows(&rows)
        .text("Column", |row| super::columns::long_name(row.column))
        .text("Unit", |_| Cell::Missing)
        .column("", "Count", Dim::None, Digits::Usual, |row| row.count)
        .column("", "Mean", Dim::None, Digits::Scientific(6), |row| row.moments.map(|(mean, _)| mean))
        .column("", "Std. Dev.", Dim::None, Digits::Scientific(6), |row| row.moments.map(|(_, deviation)| deviation))
        .column("", "Minimum", Dim::None, Digits::Scientific(6), |row| row.low.map(|(_, value)| value))
        .column("", &at_name, at_dim, at_digits, |row| position(row.low))
        .column("", "Maximum", Dim::None, Digits::Scientific(6), |row| row.high.map(|(_, value)| value))
        .column("", &at_name, at_dim, at_digits, |row| position(row.high))
        .build()
}

/// What the numbers of a column come to.
struct ColumnRange<'t> {
    column: &'t Column,
    /// Cells with a number.
    count: usize,
    /// Mean and standard deviation, of a column with numbers.
    moments: Option<(f64, f64)>,
    /// Row and value of the least number, and of the greatest.
    low: Option<(usize, f64)>,
    high: Option<(usize, f64)>,
}

impl<'t> ColumnRange<'t> {
    fn new(column: &'t Column) -> Self {
        let numbered = column.cells.iter().enumerate();
        let values: Vec<(usize, f64)> = numbered.filter_map(|(row, cell)| Some((row, cell.number()?))).collect();
        let count = values.len();
        let mean = values.iter().map(|(_, v)| v).sum::<f64>() / count as f64;
        let variance = values.iter().map(|(_, v)| (v - mean).powi(2)).sum::<f64>() / count as f64;
        ColumnRange {
            column,
            count,
            moments: (count > 0).then(|| (mean, variance.sqrt())),
            low: values.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1)),
            high: values.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1)),
        }
    }
}

/// The same in user units, for printing: each described column keeps its own unit, named in the `Unit` column.
pub fn in_units(source: &Table, independent: Option<usize>, columns: &[usize], units: UnitSystem) -> Table {
    let dims: Vec<Dim> = columns.iter().filter_map(|i| source.columns().get(*i)).map(|c| c.dim).collect();
    by_row(table(source, independent, columns), &["Mean", "Std. Dev.", "Minimum", "Maximum"], &dims, units)
}

/// A table of one row a quantity in user units: the columns named measure what the row's dimension says, and `Unit` names it.
fn by_row(mut table: Table, names: &[&str], dims: &[Dim], units: UnitSystem) -> Table {
    table.map_cells(|column, row, cell| match (dims.get(row), cell) {
        (Some(dim), Cell::Number(value)) if names.contains(&column.name.as_str()) => {
            Cell::Number(dim.from_si(*value, units))
        }
        (Some(dim), _) if column.name == "Unit" => Cell::Text(dim.label(units)),
        _ => cell.clone(),
    });
    table
}

/// A column of a table as a series over the first one; rows without a number are left out. `None` for times where the first
/// column does not grow, or is the only one.
struct ColumnSeries<'a> {
    column: &'a Column,
    values: Vec<f64>,
    times: Option<Vec<f64>>,
}

fn describe_columns(table: &Table) -> Vec<ColumnSeries<'_>> {
    let (first, rest) = match table.columns().split_first() {
        Some((only, [])) => (None, std::slice::from_ref(only)),
        Some((first, rest)) => (Some(first), rest),
        None => (None, &[][..]),
    };
    let of = |column| {
        let rows = |c: &Column| c.cells.iter().map(Cell::number).collect::<Vec<_>>();
        let values: Vec<Option<f64>> = rows(column);
        let times = first.map(rows).and_then(|times| {
            times.into_iter().zip(&values).filter(|(_, v)| v.is_some()).map(|(t, _)| t).collect::<Option<Vec<f64>>>()
        });
        let times = times.filter(|t| t.windows(2).all(|w| matches!(w, [a, b] if a < b)));
        ColumnSeries { column, values: values.into_iter().flatten().collect(), times }
    };
    rest.iter().map(of).collect()
}

impl ColumnSeries<'_> {
    /// Its moments, and its crossings of the mean where times grow; `None` without a value.
    fn moments_and_crossings(&self) -> Result<Option<(Moments, Option<Crossings>)>, SeriesError> {
        if self.values.is_empty() {
            return Ok(None);
        }
        let moments = statistics::moments(&self.values)?;
        let crossed = |times: &Vec<f64>| statistics::crossings(times, &self.values, moments.mean);
        Ok(Some((moments, self.times.as_ref().map(crossed).transpose()?)))
    }
}

/// Dimension of the first column of several.
fn independent(table: &Table) -> Dim {
    table.columns().first().filter(|_| table.columns().len() > 1).map_or(Dim::None, |c| c.dim)
}

/// Shape, and cycles about the mean, in user units. The first column is the independent one.
///
/// # Errors
/// A value that is not finite or too large.
pub fn cycles(table: &Table, units: UnitSystem) -> Result<Table, SeriesError> {
    let (mut rows, mut dims) = (Vec::new(), Vec::new());
    for series in describe_columns(table) {
        dims.push(series.column.dim);
        let known = series.moments_and_crossings()?;
        let (moments, crossings) = known.map_or((None, None), |(moments, crossings)| (Some(moments), crossings));
        rows.push((series.column, moments, crossings));
    }
    let out = Table::new("Shape and Cycles about the Mean")
        .with_rows(&rows)
        .text("Column", |(column, ..)| super::columns::long_name(column))
        .text("Unit", |_| Cell::Missing)
        .column("", "RMS", Dim::None, Digits::Scientific(6), |(_, m, _)| m.as_ref().map(|m| m.rms))
        .column("", "Skewness", Dim::None, Digits::Decimals(4), |(_, m, _)| m.as_ref().map(|m| m.skewness))
        .column("", "Kurtosis", Dim::None, Digits::Decimals(4), |(_, m, _)| m.as_ref().map(|m| m.kurtosis))
        .column("", "Cycles", Dim::None, Digits::Usual, |(.., c)| c.as_ref().map(|c| c.waves.len()))
        .column("", "Period", independent(table), Digits::Decimals(4), |(.., c)| c.as_ref().and_then(Crossings::period))
        .column("", "2 Std. Dev.", Dim::None, Digits::Scientific(6), |(_, m, _)| m.as_ref().map(|m| 2.0 * m.deviation))
        .column("", "1/3 Range", Dim::None, Digits::Scientific(6), |(.., c)| {
            c.as_ref().and_then(|c| c.mean_of_highest(1.0 / 3.0))
        })
        .column("", "1/10 Range", Dim::None, Digits::Scientific(6), |(.., c)| {
            c.as_ref().and_then(|c| c.mean_of_highest(0.1))
        })
        .build();
    Ok(by_row(out, &["RMS", "2 Std. Dev.", "1/3 Range", "1/10 Range"], &dims, units))
}

/// Most probable and expected largest and smallest value in a duration (s) by Rayleigh, in user units.
///
/// # Errors
/// A first column that is no time or does not grow; fewer than two cycles in the record or the duration.
pub fn expected_extremes(table: &Table, duration: f64, units: UnitSystem) -> Result<Table, SeriesError> {
    if table.columns().len() < 2 || independent(table) != Dim::Time {
        return Err(SeriesError::Refused("-DURATION asks for a first column of time".into()));
    }
    let (mut rows, mut dims) = (Vec::new(), Vec::new());
    for series in describe_columns(table) {
        let name = super::columns::long_name(series.column);
        let Some((m, Some(period))) = series.moments_and_crossings()?.map(|(m, c)| (m, c.and_then(|c| c.period())))
        else {
            return Err(SeriesError::Refused(format!("{name} has no two up-crossings of its mean over growing times")));
        };
        let above = rayleigh(0.0, m.deviation, period, duration)?;
        let (most, expected) = (above.most_probable, above.expected);
        dims.push(series.column.dim);
        rows.push((name, [m.mean + most, m.mean + expected, m.mean - most, m.mean - expected]));
    }
    let names = ["Prob. Max.", "Exp. Max.", "Prob. Min.", "Exp. Min."];
    let out = Table::new(format!("Extremes in {} hours by Rayleigh", duration / 3600.0))
        .with_rows(&rows)
        .text("Column", |(name, _)| name)
        .text("Unit", |_| Cell::Missing)
        .columns("", names, Dim::None, Digits::Scientific(6), |(_, values)| *values)
        .build();
    Ok(by_row(out, &names, &dims, units))
}

/// The maxima and minima between crossings of the mean with their places, one group of columns a series.
///
/// # Errors
/// A first column that does not grow; a value that is not finite.
pub fn peaks(table: &Table) -> Result<Table, SeriesError> {
    let mut columns = Vec::new();
    let at = independent(table);
    for series in describe_columns(table) {
        let name = super::columns::long_name(series.column);
        let Some((_, Some(found))) = series.moments_and_crossings()? else {
            return Err(SeriesError::Refused(format!("the peaks of {name} need a first column that grows")));
        };
        for (head, peaks) in [("Maximum", &found.maxima), ("Minimum", &found.minima)] {
            columns.push(Column::new(&name, "at", at, Digits::Usual, peaks.iter().map(|p| p.time)));
            columns.push(Column::new(&name, head, series.column.dim, Digits::Usual, peaks.iter().map(|p| p.value)));
        }
    }
    Ok(Table::from_columns("Maxima and Minima between Crossings of the Mean", columns))
}

/// What each series of a record comes to by the moments of its spectrum, in user units.
///
/// # Errors
/// As [`tables::moments`].
pub fn spectral(record: &SeriesRecord, length: Option<usize>, units: UnitSystem) -> Result<Table, SeriesError> {
    let dims: Vec<Dim> = record.series.iter().map(|s| s.dim).collect();
    let rows: Vec<_> = tables::moments(record, length)?.into_iter().zip(&dims).collect();
    let square = |dim: &Dim, m: f64| dim.from_si(dim.from_si(m, units), units);
    let out = Table::new("Moments of the Spectrum")
        .with_rows(&rows)
        .text("Column", |((name, _), _)| name)
        .text("Unit", |_| Cell::Missing)
        .column("", "Std. Dev.", Dim::None, Digits::Scientific(6), |((_, found), _)| {
            let [m0, ..] = found.m;
            m0.sqrt()
        })
        .column("", "Tp", Dim::Time, Digits::Decimals(4), |((_, found), _)| found.peak_period)
        .column("", "T1", Dim::Time, Digits::Decimals(4), |((_, found), _)| found.mean_period)
        .column("", "Tz", Dim::Time, Digits::Decimals(4), |((_, found), _)| found.zero_crossing_period)
        .column("", "Bandwidth", Dim::None, Digits::Decimals(4), |((_, found), _)| found.bandwidth)
        .column("", "Width", Dim::None, Digits::Decimals(4), |((_, found), _)| found.width)
        .columns("", ["m0", "m1", "m2", "m4"], Dim::None, Digits::Scientific(6), |((_, found), dim)| {
            found.m.map(|m| square(dim, m))
        })
        .build();
    Ok(by_row(out, &["Std. Dev."], &dims, units))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_deviation_and_extremes_have_their_positions() {
        let t = Table::new("t")
            .with_rows(&[(10.0, 1.0), (20.0, 5.0), (30.0, 3.0)])
            .column("", "X", Dim::None, Digits::Usual, |(x, _)| *x)
            .column("", "Y", Dim::None, Digits::Usual, |(_, y)| *y)
            .build();
        let s = table(&t, Some(0), &[1]);
        let values: Vec<Option<f64>> = s.row(0).iter().map(|c| c.number()).collect();
        assert_eq!(values[3], Some(3.0));
        assert!((values[4].unwrap() - (8.0f64 / 3.0).sqrt()).abs() < 1e-15);
        assert_eq!(&values[5..], [Some(1.0), Some(10.0), Some(5.0), Some(20.0)]);
    }

    #[test]
    fn cycles_extremes_and_peaks_of_sine_in_feet() {
        let us = UnitSystem::default();
        let times: Vec<f64> = (0..=1000).map(|i| 0.1 * f64::from(i)).collect();
        let mut t = Table::new("t")
            .with_rows(&times)
            .column("", "Time", Dim::Time, Digits::Usual, |time| *time)
            .column("", "Z", Dim::Length, Digits::Usual, |time| {
                Dim::Length.to_si(3.0 + 2.0 * (std::f64::consts::TAU * time / 10.0 + 0.5).sin(), us)
            })
            .build();
        let number = |t: &Table, name: &str| t.get(name).unwrap().numbers()[0];
        let c = cycles(&t, us).unwrap();
        // the samples miss the crest by half a step of 0.1 s at most
        assert!((number(&c, "1/3 Range") - 4.0).abs() < 4.0 * 0.0005 && number(&c, "Cycles") == 9.0);
        assert!((number(&c, "Period") - 10.0).abs() < 1e-4);
        assert!((number(&c, "2 Std. Dev.") - 8f64.sqrt()).abs() < 0.01);
        let e = expected_extremes(&t, 10_800.0, us).unwrap();
        let want = 3.0 + 2f64.sqrt() * (2.0 * 1080f64.ln()).sqrt();
        assert!((number(&e, "Prob. Max.") - want).abs() < 0.02, "{e:?}");
        let p = peaks(&t).unwrap();
        assert_eq!((p.columns().len(), p.columns()[1].numbers().len()), (4, 9));
        let mut columns = t.columns().to_vec();
        columns[0].dim = Dim::Length;
        t = t.with_columns(columns.clone());
        assert!(expected_extremes(&t, 10_800.0, us).is_err());
        columns[0].cells.reverse();
        t = t.with_columns(columns);
        assert!(peaks(&t).is_err() && cycles(&t, us).unwrap().get("Period").unwrap().numbers().is_empty());
    }
}
