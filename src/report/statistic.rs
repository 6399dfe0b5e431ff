//! `STATISTIC`: what a column amounts to.

use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_signal::SeriesError;
use windlass_signal::extremes::rayleigh;
use windlass_signal::statistics::{self, Crossings, Moments, Peak};
use windlass_signal::tables::{self, Record};

/// Count, mean, standard deviation, and the extremes with the value of the independent column where they occur.
///
/// `independent` is the column of `table` that positions are given in; `columns` those described. The standard
/// deviation is that of the values themselves (divided by their number).
pub fn table(table: &Table, independent: Option<usize>, columns: &[usize]) -> Table {
    let at = independent.and_then(|i| table.columns.get(i));
    let (at_name, at_dim) = at.map_or(("Row".to_string(), Dim::None), |c| (format!("at {}", c.name), c.dim));
    let mut out = Table::new(format!("Statistics of {}", table.title))
        .column("", "Column", Dim::None, Digits::Usual)
        .column("", "Unit", Dim::None, Digits::Usual)
        .column("", "Count", Dim::None, Digits::Usual);
    for name in ["Mean", "Std. Dev.", "Minimum", "Maximum"] {
        out = out.column("", name, Dim::None, Digits::Scientific(6));
        if name.ends_with("imum") {
            let digits = if at.is_some() { Digits::Usual } else { Digits::Decimals(0) };
            out = out.column("", &at_name, at_dim, digits);
        }
    }
    for column in columns.iter().filter_map(|i| table.columns.get(*i)) {
        let values: Vec<(usize, f64)> =
            column.cells.iter().enumerate().filter_map(|(row, cell)| Some((row, cell.number()?))).collect();
        let count = values.len();
        let mean = values.iter().map(|(_, v)| v).sum::<f64>() / count as f64;
        let variance = values.iter().map(|(_, v)| (v - mean).powi(2)).sum::<f64>() / count as f64;
        let low = values.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1));
        let high = values.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1));
        let place = |extreme: Option<(usize, f64)>| match (extreme, at) {
            (Some((row, _)), Some(c)) => c.cells.get(row).cloned().unwrap_or(Cell::Missing),
            (Some((row, _)), None) => Cell::from(row + 1),
            (None, _) => Cell::Missing,
        };
        let number = |v: f64| if count == 0 { Cell::Missing } else { Cell::Number(v) };
        let row = vec![
            Cell::Text(super::columns::long_name(column)),
            Cell::Missing,
            Cell::from(count),
            number(mean),
            number(variance.sqrt()),
            low.map(|l| l.1).into(),
            place(low),
            high.map(|h| h.1).into(),
            place(high),
        ];
        // the row has one cell a column, made just above
        let _ = out.push(row);
    }
    out
}

/// The same in user units, for printing: each described column keeps its own unit, named in the `Unit` column.
pub fn in_units(source: &Table, independent: Option<usize>, columns: &[usize], units: UnitSystem) -> Table {
    let dims: Vec<Dim> = columns.iter().filter_map(|i| source.columns.get(*i)).map(|c| c.dim).collect();
    by_row(table(source, independent, columns), &["Mean", "Std. Dev.", "Minimum", "Maximum"], &dims, units)
}

/// A table of one row a quantity in user units: the columns named measure what the row's dimension says, and `Unit` names it.
fn by_row(mut table: Table, names: &[&str], dims: &[Dim], units: UnitSystem) -> Table {
    for column in &mut table.columns {
        let describes = names.contains(&column.name.as_str());
        for (cell, dim) in column.cells.iter_mut().zip(dims) {
            if describes && let Cell::Number(value) = cell {
                *value = dim.from_si(*value, units);
            } else if column.name == "Unit" {
                *cell = Cell::Text(dim.label(units));
            }
        }
    }
    table
}

/// A column of a table as a series over the first one; rows without a number are left out. `None` for times where the first
/// column does not grow, or is the only one.
struct Described<'a> {
    column: &'a Column,
    values: Vec<f64>,
    times: Option<Vec<f64>>,
}

fn described(table: &Table) -> Vec<Described<'_>> {
    let (first, rest) = match table.columns.split_first() {
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
        Described { column, values: values.into_iter().flatten().collect(), times }
    };
    rest.iter().map(of).collect()
}

impl Described<'_> {
    /// Its moments, and its crossings of the mean where times grow; `None` without a value.
    fn known(&self) -> Result<Option<(Moments, Option<Crossings>)>, SeriesError> {
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
    table.columns.first().filter(|_| table.columns.len() > 1).map_or(Dim::None, |c| c.dim)
}

/// Shape, and cycles about the mean, in user units. The first column is the independent one.
///
/// # Errors
/// A value that is not finite or too large.
pub fn cycles(table: &Table, units: UnitSystem) -> Result<Table, SeriesError> {
    let mut out = Table::new("Shape and Cycles about the Mean")
        .column("", "Column", Dim::None, Digits::Usual)
        .column("", "Unit", Dim::None, Digits::Usual)
        .column("", "RMS", Dim::None, Digits::Scientific(6))
        .column("", "Skewness", Dim::None, Digits::Decimals(4))
        .column("", "Kurtosis", Dim::None, Digits::Decimals(4))
        .column("", "Cycles", Dim::None, Digits::Usual)
        .column("", "Period", independent(table), Digits::Decimals(4));
    for name in ["2 Std. Dev.", "1/3 Range", "1/10 Range"] {
        out = out.column("", name, Dim::None, Digits::Scientific(6));
    }
    let mut dims = Vec::new();
    for series in described(table) {
        let known = series.known()?;
        let moments = |of: fn(&Moments) -> f64| Cell::from(known.as_ref().map(|(m, _)| of(m)));
        let crossings = known.as_ref().and_then(|(_, c)| c.as_ref());
        dims.push(series.column.dim);
        let row = vec![
            Cell::Text(super::columns::long_name(series.column)),
            Cell::Missing,
            moments(|m| m.rms),
            moments(|m| m.skewness),
            moments(|m| m.kurtosis),
            crossings.map(|c| c.waves.len()).into(),
            crossings.and_then(Crossings::period).into(),
            moments(|m| 2.0 * m.deviation),
            crossings.and_then(|c| c.mean_of_highest(1.0 / 3.0)).into(),
            crossings.and_then(|c| c.mean_of_highest(0.1)).into(),
        ];
        // the row has one cell a column, made just above
        let _ = out.push(row);
    }
    Ok(by_row(out, &["RMS", "2 Std. Dev.", "1/3 Range", "1/10 Range"], &dims, units))
}

/// Most probable and expected largest and smallest value in a duration (s) by Rayleigh, in user units.
///
/// # Errors
/// A first column that is no time or does not grow; fewer than two cycles in the record or the duration.
pub fn expected_extremes(table: &Table, duration: f64, units: UnitSystem) -> Result<Table, SeriesError> {
    if table.columns.len() < 2 || independent(table) != Dim::Time {
        return Err(SeriesError::Refused("-DURATION asks for a first column of time".into()));
    }
    let mut out = Table::new(format!("Extremes in {} hours by Rayleigh", duration / 3600.0))
        .column("", "Column", Dim::None, Digits::Usual)
        .column("", "Unit", Dim::None, Digits::Usual);
    let names = ["Prob. Max.", "Exp. Max.", "Prob. Min.", "Exp. Min."];
    for name in names {
        out = out.column("", name, Dim::None, Digits::Scientific(6));
    }
    let mut dims = Vec::new();
    for series in described(table) {
        let name = super::columns::long_name(series.column);
        let Some((m, Some(period))) = series.known()?.map(|(m, c)| (m, c.and_then(|c| c.period()))) else {
            return Err(SeriesError::Refused(format!("{name} has no two up-crossings of its mean over growing times")));
        };
        let above = rayleigh(0.0, m.deviation, period, duration)?;
        let (most, expected) = (above.most_probable, above.expected);
        let values = [m.mean + most, m.mean + expected, m.mean - most, m.mean - expected];
        dims.push(series.column.dim);
        // the row has one cell a column, made just above
        let _ = out.push([Cell::Text(name), Cell::Missing].into_iter().chain(values.map(Cell::Number)).collect());
    }
    Ok(by_row(out, &names, &dims, units))
}

/// The maxima and minima between crossings of the mean with their places, one group of columns a series.
///
/// # Errors
/// A first column that does not grow; a value that is not finite.
pub fn peaks(table: &Table) -> Result<Table, SeriesError> {
    let mut out = Table::new("Maxima and Minima between Crossings of the Mean");
    let at = independent(table);
    for series in described(table) {
        let name = super::columns::long_name(series.column);
        let Some((_, Some(found))) = series.known()? else {
            return Err(SeriesError::Refused(format!("the peaks of {name} need a first column that grows")));
        };
        for (head, peaks) in [("Maximum", &found.maxima), ("Minimum", &found.minima)] {
            for (head, dim, of) in
                [("at", at, (|p| p.time) as fn(&Peak) -> f64), (head, series.column.dim, |p: &Peak| p.value)]
            {
                out = out.column(&name, head, dim, Digits::Usual);
                if let Some(column) = out.columns.last_mut() {
                    column.cells = peaks.iter().map(|p| Cell::Number(of(p))).collect();
                }
            }
        }
    }
    let rows = out.columns.iter().map(|c| c.cells.len()).max().unwrap_or(0);
    out.columns.iter_mut().for_each(|c| c.cells.resize(rows, Cell::Missing));
    Ok(out)
}

/// What each series of a record comes to by the moments of its spectrum, in user units.
///
/// # Errors
/// As [`tables::moments`].
pub fn spectral(record: &Record, length: Option<usize>, units: UnitSystem) -> Result<Table, SeriesError> {
    let mut out = Table::new("Moments of the Spectrum")
        .column("", "Column", Dim::None, Digits::Usual)
        .column("", "Unit", Dim::None, Digits::Usual)
        .column("", "Std. Dev.", Dim::None, Digits::Scientific(6));
    for name in ["Tp", "T1", "Tz"] {
        out = out.column("", name, Dim::Time, Digits::Decimals(4));
    }
    for name in ["Bandwidth", "Width"] {
        out = out.column("", name, Dim::None, Digits::Decimals(4));
    }
    let powers = ["m0", "m1", "m2", "m4"];
    for name in powers {
        out = out.column("", name, Dim::None, Digits::Scientific(6));
    }
    let mut dims = Vec::new();
    for ((name, found), series) in tables::moments(record, length)?.into_iter().zip(&record.series) {
        let square = |m: f64| Cell::Number(series.dim.from_si(series.dim.from_si(m, units), units));
        dims.push(series.dim);
        let [m0, ..] = found.m;
        let mut row = vec![Cell::Text(name), Cell::Missing, Cell::Number(m0.sqrt())];
        let rest = [found.peak_period, found.mean_period, found.zero_crossing_period, found.bandwidth, found.width];
        row.extend(rest.map(Cell::Number));
        row.extend(found.m.map(square));
        // the row has one cell a column, made just above
        let _ = out.push(row);
    }
    Ok(by_row(out, &["Std. Dev."], &dims, units))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_deviation_and_extremes_with_their_places() {
        let mut t = Table::new("t").column("", "X", Dim::None, Digits::Usual).column("", "Y", Dim::None, Digits::Usual);
        for (x, y) in [(10.0, 1.0), (20.0, 5.0), (30.0, 3.0)] {
            t.push(vec![x.into(), y.into()]).unwrap();
        }
        let s = table(&t, Some(0), &[1]);
        let values: Vec<Option<f64>> = s.row(0).iter().map(|c| c.number()).collect();
        assert_eq!(values[3], Some(3.0));
        assert!((values[4].unwrap() - (8.0f64 / 3.0).sqrt()).abs() < 1e-15);
        assert_eq!(&values[5..], [Some(1.0), Some(10.0), Some(5.0), Some(20.0)]);
    }

    #[test]
    fn cycles_extremes_and_peaks_of_a_sine_in_feet() {
        let us = UnitSystem::default();
        let mut t =
            Table::new("t").column("", "Time", Dim::Time, Digits::Usual).column("", "Z", Dim::Length, Digits::Usual);
        for i in 0..=1000 {
            let time = 0.1 * f64::from(i);
            let z = 3.0 + 2.0 * (std::f64::consts::TAU * time / 10.0 + 0.5).sin();
            t.push(vec![time.into(), Dim::Length.to_si(z, us).into()]).unwrap();
        }
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
        assert_eq!((p.columns.len(), p.columns[1].numbers().len()), (4, 9));
        t.columns[0].dim = Dim::Length;
        assert!(expected_extremes(&t, 10_800.0, us).is_err());
        t.columns[0].cells.reverse();
        assert!(peaks(&t).is_err() && cycles(&t, us).unwrap().get("Period").unwrap().numbers().is_empty());
    }
}
