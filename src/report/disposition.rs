//! The state of a disposition menu over any table: scales, shifts, chosen rows. Pure: it makes tables and texts, and the
//! command floor disposes of them.
//!
//! Source: [MOSES-REF disp_men]. C_SCALE and C_SHIFT last until the menu ends and act on VIEW,
//! STORE, PLOT, STATISTIC and SET_VARIABLE, not on the formatted REPORT. -RECORD counts rows, from 1.

use super::columns::{Choose, NoSuchColumn, choose, report_columns};
use super::format;
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::{Dim, UnitSystem};

/// Why something could not be done with a table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DispositionError {
    /// A selector that names no column.
    #[error(transparent)]
    Column(#[from] NoSuchColumn),
    /// No column is left.
    #[error("no column is chosen")]
    Nothing,
    /// A column of text where numbers are needed.
    #[error("column {0} holds no numbers")]
    Text(String),
    /// Row numbers that choose nothing.
    #[error("rows {from} to {to} choose none of the {rows} rows (-RECORD counts rows from 1, not times)")]
    Rows {
        /// First row asked for.
        from: i64,
        /// Last row asked for.
        to: i64,
        /// Rows of the table.
        rows: usize,
    },
    /// Bounds that leave no row.
    #[error("no row lies within the bounds")]
    NoRow,
    /// No row is one of the events.
    #[error("the first column has no value among these events")]
    NoEvent,
    /// All rows are of the transient.
    #[error("all rows are before TTRA_SET, {0} s, which statistics leave out: -RECORD takes rows by their numbers")]
    Transient(f64),
    /// Ranges to exclude that leave no row.
    #[error("no row is left: every value of {0} lies inside of the ranges to exclude")]
    AllCulled(String),
    /// Several columns where one is needed.
    #[error("CULL goes by one column, and {selector} names {count}")]
    NotOne {
        /// The selector.
        selector: String,
        /// Columns it names.
        count: usize,
    },
    /// A cell without a value where each row needs one.
    #[error("column {column} has no value in row {row}")]
    NoValue {
        /// The column.
        column: String,
        /// The row, from 1.
        row: usize,
    },
}

/// Which rows are taken.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RowChoice {
    /// First and last row, from 1.
    pub record: Option<(i64, i64)>,
    /// Column selector and the bounds its values must lie in (user units).
    pub values: Option<(String, f64, f64)>,
    /// Leaves out what is before this time (s) by a first column of time.
    pub from: Option<f64>,
    /// Rows whose first column is from the first number to the second, the last where there is none, in steps of the third.
    pub events: Option<(f64, Option<f64>, Option<f64>)>,
}

/// A table being disposed of.
#[derive(Clone, Debug, PartialEq)]
pub struct Disposition {
    /// The table as it came.
    pub table: Table,
    /// Factor and shift of each column, in user units: shown = value * factor + shift.
    adjust: Vec<(f64, f64)>,
    /// The time before which statistics leave rows out (s), of a result against time.
    transient: Option<f64>,
}

/// Stands above the notes of a culled table, whose rows have other numbers.
const OF_THE_WHOLE: &str = "of the whole table, by its row numbers before CULL:";

impl Disposition {
    /// A menu over a table.
    pub fn new(table: Table) -> Self {
        let adjust = vec![(1.0, 0.0); table.columns().len()];
        Disposition { table, adjust, transient: None }
    }

    /// The same of a run whose statistics leave out what is before a time (s).
    pub fn after_transient(self, transient: Option<f64>) -> Self {
        let times = self.table.columns().first().is_some_and(|c| c.dim == Dim::Time);
        Disposition { transient: transient.filter(|_| times), ..self }
    }

    /// Puts a column of as many rows behind the others.
    pub fn add_column(&mut self, column: Column) {
        self.table.add_column(column);
        self.adjust.push((1.0, 0.0));
    }

    /// The time before which statistics leave rows out (s), where they do.
    pub fn transient(&self) -> Option<f64> {
        self.transient
    }

    /// The columns several selectors choose, in their order and each once; nothing given chooses all.
    ///
    /// # Errors
    /// A name that fits no column, or selectors that choose nothing.
    pub fn columns(&self, selectors: &[&str]) -> Result<Vec<usize>, DispositionError> {
        self.columns_by(selectors, choose)
    }

    /// The columns of a report: a selector may also name a group of columns.
    ///
    /// # Errors
    /// As [`Disposition::columns`].
    pub fn report_columns(&self, selectors: &[&str]) -> Result<Vec<usize>, DispositionError> {
        self.columns_by(selectors, report_columns)
    }

    fn columns_by(&self, selectors: &[&str], choose: Choose) -> Result<Vec<usize>, DispositionError> {
        if selectors.is_empty() {
            return Ok((0..self.table.columns().len()).collect());
        }
        let mut chosen = Vec::new();
        for selector in selectors {
            chosen.extend(choose(&self.table, selector)?);
        }
        let mut seen = Vec::new();
        chosen.retain(|index| {
            let new = !seen.contains(index);
            seen.push(*index);
            new
        });
        if chosen.is_empty() { Err(DispositionError::Nothing) } else { Ok(chosen) }
    }

    /// The columns of numbers that selectors choose.
    ///
    /// # Errors
    /// As [`Disposition::columns`], and a column of text.
    pub fn numeric(&self, selectors: &[&str]) -> Result<Vec<usize>, DispositionError> {
        let chosen = self.columns(selectors)?;
        for index in &chosen {
            if let Some(column) = self.table.columns().get(*index)
                && column.cells.iter().any(|c| matches!(c, Cell::Text(_)))
            {
                return Err(DispositionError::Text(column.name.clone()));
            }
        }
        Ok(chosen)
    }

    /// Multiplies columns by a factor.
    ///
    /// # Errors
    /// As [`Disposition::numeric`].
    pub fn scale(&mut self, factor: f64, selectors: &[&str]) -> Result<Vec<usize>, DispositionError> {
        let chosen = self.numeric(selectors)?;
        for index in &chosen {
            if let Some(a) = self.adjust.get_mut(*index) {
                *a = (a.0 * factor, a.1 * factor);
            }
        }
        Ok(chosen)
    }

    /// Adds a number (user units) to columns.
    ///
    /// # Errors
    /// As [`Disposition::numeric`].
    pub fn shift(&mut self, by: f64, selectors: &[&str]) -> Result<Vec<usize>, DispositionError> {
        let chosen = self.numeric(selectors)?;
        for index in &chosen {
            if let Some(a) = self.adjust.get_mut(*index) {
                a.1 += by;
            }
        }
        Ok(chosen)
    }

    /// Chosen columns and rows as a table of their own; `adjusted` applies C_SCALE and C_SHIFT.
    ///
    /// # Errors
    /// A row choice that leaves nothing or names no column.
    pub fn extract(
        &self,
        columns: &[usize],
        rows: &RowChoice,
        adjusted: bool,
        units: UnitSystem,
    ) -> Result<Table, DispositionError> {
        let taken = self.rows(rows, units)?;
        let extracted = |index: &usize| {
            let column = self.table.columns().get(*index)?;
            let change =
                |cell: &Cell| if adjusted { self.adjust_cell(*index, cell, column.dim, units) } else { cell.clone() };
            let cells = taken.iter().filter_map(|row| column.cells.get(*row)).map(change).collect();
            Some(Column { cells, ..column.clone() })
        };
        Ok(self.table.clone().with_columns(columns.iter().filter_map(extracted).collect()))
    }

    /// A cell of a column with C_SCALE and C_SHIFT applied.
    fn adjust_cell(&self, index: usize, cell: &Cell, dim: Dim, units: UnitSystem) -> Cell {
        let (factor, shift) = self.adjust.get(index).copied().unwrap_or((1.0, 0.0));
        match cell.number() {
            Some(value) if (factor, shift) != (1.0, 0.0) => Cell::Number(value * factor + dim.to_si(shift, units)),
            _ => cell.clone(),
        }
    }

    /// The rows (from 0) a choice leaves.
    ///
    /// # Errors
    /// A choice that leaves no row or names no column.
    pub fn rows(&self, choice: &RowChoice, units: UnitSystem) -> Result<Vec<usize>, DispositionError> {
        let count = self.table.rows();
        let mut taken: Vec<usize> = (0..count).collect();
        if let Some((from, to)) = choice.record {
            let number = |row: &usize| i64::try_from(row + 1).unwrap_or(i64::MAX);
            taken.retain(|row| (from..=to).contains(&number(row)));
            if taken.is_empty() {
                return Err(DispositionError::Rows { from, to, rows: count });
            }
        }
        if let (Some(from), Some(times)) = (choice.from, self.table.columns().first()) {
            // a time that is an instant's but for rounding
            let near = 1e-9 * from.abs().max(1.0);
            taken.retain(|row| times.cells.get(*row).and_then(Cell::number).is_some_and(|t| t >= from - near));
            if taken.is_empty() {
                return Err(DispositionError::Transient(from));
            }
        }
        if let (Some((begin, end, step)), Some(column)) = (choice.events, self.table.columns().first()) {
            // a time that is an event's but for rounding
            let near = 1e-9 * begin.abs().max(end.unwrap_or(begin).abs()).max(1.0);
            let last = end.unwrap_or(f64::INFINITY);
            let is_event = |value: f64| {
                let past = step.map_or(0.0, |step| (value - begin) - ((value - begin) / step).round() * step);
                value >= begin - near && value <= last + near && past.abs() <= near
            };
            let value =
                |row: &usize| column.cells.get(*row).and_then(Cell::number).map(|v| column.dim.from_si(v, units));
            taken.retain(|row| value(row).is_some_and(is_event));
            if taken.is_empty() {
                return Err(DispositionError::NoEvent);
            }
        }
        if let Some((selector, low, high)) = &choice.values {
            taken = self.rows_within(taken, selector, *low, *high, units)?;
        }
        Ok(taken)
    }

    fn rows_within(
        &self,
        mut rows: Vec<usize>,
        selector: &str,
        low: f64,
        high: f64,
        units: UnitSystem,
    ) -> Result<Vec<usize>, DispositionError> {
        for index in self.numeric(&[selector])? {
            rows.retain(|row| {
                self.displayed_value(index, *row, units).is_some_and(|value| (low..=high).contains(&value))
            });
        }
        if rows.is_empty() { Err(DispositionError::NoRow) } else { Ok(rows) }
    }

    /// The number of a cell as VIEW shows it: user units, scaled and shifted, without the rounding of the conversion.
    fn displayed_value(&self, column: usize, row: usize, units: UnitSystem) -> Option<f64> {
        let (factor, shift) = self.adjust.get(column).copied().unwrap_or((1.0, 0.0));
        let column = self.table.columns().get(column)?;
        let value = column.dim.from_si(column.cells.get(row)?.number()?, units) * factor + shift;
        Some(format::rounded_to_fifteen_figures(value))
    }

    /// `CULL`: the rows whose value of one column lies inside of none of the ranges (ends included, as VIEW shows it), as
    /// a new menu. A cell without a value lies inside of none. The values stay as they came; scales and shifts made so far
    /// go on acting in the new menu.
    ///
    /// # Errors
    /// A selector of no column, of several, or of one of text; ranges that leave no row.
    pub fn cull(
        &self,
        selector: &str,
        excluded: &[(f64, f64)],
        units: UnitSystem,
    ) -> Result<Disposition, DispositionError> {
        let chosen = self.numeric(&[selector])?;
        let &[index] = chosen.as_slice() else {
            return Err(DispositionError::NotOne { selector: selector.into(), count: chosen.len() });
        };
        let outside = |row: usize| {
            let value = self.displayed_value(index, row, units);
            !value.is_some_and(|value| excluded.iter().any(|(low, high)| (*low..=*high).contains(&value)))
        };
        let mut out = self.clone();
        out.table.keep_rows(outside);
        let kept = out.table.rows();
        if kept == 0 {
            let name = self.table.columns().get(index).map_or_else(String::new, super::columns::long_name);
            return Err(DispositionError::AllCulled(name));
        }
        let notes = &mut out.table.notes;
        let renumbered = kept < self.table.rows() && notes.first().is_some_and(|first| first.text != OF_THE_WHOLE);
        if renumbered {
            notes.insert(0, OF_THE_WHOLE.into());
        }
        Ok(out)
    }

    /// `VLIST`: number, name and unit of every column, with its range (C_SCALE and C_SHIFT applied, as in VIEW).
    pub fn vlist(&self, units: UnitSystem) -> Vec<String> {
        let names: Vec<String> = self.table.columns().iter().map(super::columns::long_name).collect();
        let width = names.iter().map(|n| n.chars().count()).max().unwrap_or(0);
        let lines = self.table.columns().iter().zip(names).enumerate().map(|(index, (column, name))| {
            let cells: Vec<Cell> = column.cells.iter().map(|c| self.adjust_cell(index, c, column.dim, units)).collect();
            let range = cells.iter().filter_map(Cell::number).fold(None, |range: Option<(f64, f64)>, v| {
                Some(range.map_or((v, v), |(low, high)| (low.min(v), high.max(v))))
            });
            let whole = cells.iter().all(|c| matches!(c, Cell::Integer(_)));
            let digits = if whole { Digits::Decimals(0) } else { column.digits };
            let shown = |v: f64| format::report(&Cell::Number(v), column.dim, digits, units);
            let range = range.map_or(String::new(), |(low, high)| format!("{} to {}", shown(low), shown(high)));
            format!("{:>5}  {name:<width$}  {:<10} {range}", index + 1, column.dim.label(units)).trim_end().to_string()
        });
        lines.collect()
    }

    /// `SET_VARIABLE`: the values of a column in user units, full precision, separated by blanks.
    ///
    /// # Errors
    /// As [`Disposition::extract`], and a cell without a value, which would move those behind it to a wrong place.
    pub fn values(&self, selector: &str, rows: &RowChoice, units: UnitSystem) -> Result<String, DispositionError> {
        let columns = self.columns(&[selector])?;
        let table = self.extract(&columns, rows, true, units)?;
        let numbers = self.rows(rows, units)?;
        for column in table.columns() {
            if let Some((_, row)) = column.cells.iter().zip(&numbers).find(|(cell, _)| **cell == Cell::Missing) {
                return Err(DispositionError::NoValue { column: column.name.clone(), row: row + 1 });
            }
        }
        let text = |cell: &Cell, dim: Dim| match cell {
            Cell::Number(value) => format::fifteen_figures(dim.from_si(*value, units)),
            other => format::full(other, dim, units),
        };
        let cells = table.columns().iter().flat_map(|c| c.cells.iter().map(move |cell| text(cell, c.dim)));
        Ok(cells.collect::<Vec<_>>().join(" "))
    }
}

#[cfg(test)]
mod tests;
