//! `STATISTIC`: what a column amounts to.

use crate::language::units::Dim;
use crate::table::{Cell, Digits, Table};

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
pub fn in_units(
    source: &Table,
    independent: Option<usize>,
    columns: &[usize],
    units: crate::language::units::UnitSystem,
) -> Table {
    let mut out = table(source, independent, columns);
    let dims: Vec<Dim> = columns.iter().filter_map(|i| source.columns.get(*i)).map(|c| c.dim).collect();
    for column in &mut out.columns {
        let describes = ["Mean", "Std. Dev.", "Minimum", "Maximum"].contains(&column.name.as_str());
        for (cell, dim) in column.cells.iter_mut().zip(&dims) {
            if describes && let Cell::Number(value) = cell {
                *value = dim.from_si(*value, units);
            } else if column.name == "Unit" {
                *cell = Cell::Text(dim.label(units));
            }
        }
    }
    out
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
}
