//! Results as data: named columns with dimensions, SI values inside. Engines and post-processing return a [`Table`];
//! every report, plot, file and test reads one. A table knows nothing of how it is printed.

use crate::diagnostic::Severity;
use crate::units::Dim;

/// One value of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A number in SI.
    Number(f64),
    /// A count or an ordinal (segment number, row number).
    Integer(i64),
    /// Text (names, states).
    Text(String),
    /// No value applies.
    Missing,
}

/// How many digits a reader of the formatted report needs; files always get full precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Digits {
    /// As the dimension usually is printed (decided in one place, by the report floor).
    Usual,
    /// This many decimals.
    Decimals(u8),
    /// This many significant digits in E format.
    Scientific(u8),
}

/// A named column: one dimension, one cell a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Short name as shown in heads, listings and files, e.g. `Ten Top`.
    pub name: String,
    /// Head shared with neighbouring columns of the same group, e.g. `Tension`; empty for none.
    pub group: String,
    /// What the numbers measure.
    pub dim: Dim,
    /// Digits in the formatted report.
    pub digits: Digits,
    /// The values, SI.
    pub cells: Vec<Cell>,
}

/// A remark under the rows of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct TableNote {
    /// How serious.
    pub severity: Severity,
    /// One sentence, without what its severity begins with.
    pub text: String,
}

/// A fact that holds for all rows of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    /// Its name.
    pub name: String,
    /// Its value, SI.
    pub value: Cell,
    /// What the value measures.
    pub dim: Dim,
    /// Digits in the formatted report.
    pub digits: Digits,
}

/// A result: a title, facts that hold for all rows, columns of equal length, and remarks for the reader.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Table {
    /// Title without decoration, e.g. `Properties of Line A`.
    pub title: String,
    /// Facts for the sub-header.
    pub facts: Vec<Fact>,
    /// All have the same number of cells.
    columns: Vec<Column>,
    /// Remarks printed under the rows.
    pub notes: Vec<TableNote>,
    /// Results that were asked for and could not be found; the remarks say why.
    pub absent: usize,
}

impl Cell {
    /// The number, if the cell holds one (integers count).
    pub fn number(&self) -> Option<f64> {
        match self {
            Cell::Number(value) => Some(*value),
            Cell::Integer(value) => Some(*value as f64),
            Cell::Text(_) | Cell::Missing => None,
        }
    }
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Cell::Number(value)
    }
}

impl From<usize> for Cell {
    fn from(value: usize) -> Self {
        i64::try_from(value).map_or(Cell::Missing, Cell::Integer)
    }
}

impl From<i64> for Cell {
    fn from(value: i64) -> Self {
        Cell::Integer(value)
    }
}

impl From<&String> for Cell {
    fn from(value: &String) -> Self {
        Cell::Text(value.clone())
    }
}

impl From<&str> for Cell {
    fn from(value: &str) -> Self {
        Cell::Text(value.to_string())
    }
}

impl From<String> for Cell {
    fn from(value: String) -> Self {
        Cell::Text(value)
    }
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Cell::Missing, Into::into)
    }
}

impl TableNote {
    /// A warning.
    pub fn warning(text: impl Into<String>) -> Self {
        TableNote { severity: Severity::Warning, text: text.into() }
    }
}

impl std::fmt::Display for TableNote {
    /// The remark as it is printed: with what its severity begins with.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}{}", self.severity.mark(), self.text)
    }
}

impl From<String> for TableNote {
    fn from(text: String) -> Self {
        TableNote { severity: Severity::Note, text }
    }
}

impl From<&str> for TableNote {
    fn from(text: &str) -> Self {
        text.to_string().into()
    }
}

impl Table {
    /// An empty table with a title.
    pub fn new(title: impl Into<String>) -> Self {
        Table { title: title.into(), ..Table::default() }
    }

    /// A table of complete columns. Columns shorter than the longest end in missing cells.
    pub fn from_columns(title: impl Into<String>, columns: Vec<Column>) -> Self {
        Table::new(title).with_columns(columns)
    }

    /// The table with other columns in place of its own. Columns shorter than the longest end in missing cells.
    pub fn with_columns(self, columns: Vec<Column>) -> Self {
        Table { columns, ..self }.filled_up()
    }

    /// Adds a complete column at the right. It ends in missing cells if it is shorter than the others; the others do if
    /// it is longer.
    pub fn add_column(&mut self, column: Column) {
        self.columns.push(column);
        self.fill_up();
    }

    /// Drops the rows (from 0) of which `keeps` is false.
    pub fn keep_rows(&mut self, keeps: impl Fn(usize) -> bool) {
        for column in &mut self.columns {
            let cells = std::mem::take(&mut column.cells).into_iter().enumerate();
            column.cells = cells.filter(|(row, _)| keeps(*row)).map(|(_, cell)| cell).collect();
        }
    }

    /// Replaces each cell by what `changed` makes of its column, its row (from 0) and itself.
    pub fn map_cells(&mut self, changed: impl Fn(&Column, usize, &Cell) -> Cell) {
        for column in &mut self.columns {
            column.cells = column.cells.iter().enumerate().map(|(row, cell)| changed(column, row, cell)).collect();
        }
    }

    /// The table with its columns as long as the longest of them.
    fn filled_up(mut self) -> Self {
        self.fill_up();
        self
    }

    fn fill_up(&mut self) {
        let rows = self.columns.iter().map(|c| c.cells.len()).max().unwrap_or(0);
        self.columns.iter_mut().for_each(|c| c.cells.resize(rows, Cell::Missing));
    }

    /// Begins the columns of a table whose rows these are.
    pub fn with_rows<R>(self, rows: &[R]) -> TableBuilder<'_, R> {
        TableBuilder { table: self, rows }
    }

    /// Adds a fact to the sub-header; returns the table for chaining.
    pub fn fact(self, name: &str, value: impl Into<Cell>, dim: Dim) -> Self {
        self.fact_with_digits(name, value, dim, Digits::Usual)
    }

    /// Adds a fact with its digits to the sub-header; returns the table for chaining.
    pub fn fact_with_digits(mut self, name: &str, value: impl Into<Cell>, dim: Dim, digits: Digits) -> Self {
        self.facts.push(Fact { name: name.into(), value: value.into(), dim, digits });
        self
    }

    /// Adds a warning below the table.
    pub fn warn(&mut self, text: impl std::fmt::Display) {
        self.notes.push(TableNote::warning(text.to_string()));
    }

    /// Adds a remark.
    pub fn note(&mut self, text: impl Into<TableNote>) {
        self.notes.push(text.into());
    }

    /// Adds remarks.
    pub fn add_notes<N: Into<TableNote>>(&mut self, notes: impl IntoIterator<Item = N>) {
        self.notes.extend(notes.into_iter().map(Into::into));
    }

    /// Counts a result that was asked for and could not be found, and warns of the reason.
    pub fn note_absent(&mut self, reason: impl std::fmt::Display) {
        self.absent += 1;
        self.warn(reason);
    }

    /// The columns, left to right; all have the same number of cells.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |c| c.cells.len())
    }

    /// A column by its exact name.
    pub fn get(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|c| c.name == name)
    }

    /// The cells of one row, left to right; empty past the end.
    pub fn row(&self, index: usize) -> Vec<&Cell> {
        self.columns.iter().filter_map(|c| c.cells.get(index)).collect()
    }
}

/// A table under construction: its rows are known, its columns are added one by one, each with the cell it takes from a
/// row. A row with a cell too many or too few cannot exist.
///
/// ```
/// use windlass_base::table::{Digits, Table};
/// use windlass_base::units::Dim;
///
/// let lines = [("A", 500.0, [1e3, 2e3]), ("B", 600.0, [3e3, 4e3])];
/// let table = Table::new("Lines")
///     .with_rows(&lines)
///     .text("Name", |(name, _, _)| *name)
///     .column("", "Length", Dim::Length, Digits::Usual, |(_, length, _)| *length)
///     .columns("Tension", ["Top", "Anchor"], Dim::Force, Digits::Usual, |(_, _, tension)| *tension)
///     .build();
/// assert_eq!(table.rows(), 2);
/// assert_eq!(table.columns()[3].numbers(), [2e3, 4e3]);
/// ```
#[derive(Debug)]
pub struct TableBuilder<'r, R> {
    table: Table,
    rows: &'r [R],
}

impl<'r, R> TableBuilder<'r, R> {
    /// Adds a column under a group head (empty text for none) with the cell of each row, SI.
    pub fn column<C: Into<Cell>>(
        mut self,
        group: &str,
        name: &str,
        dim: Dim,
        digits: Digits,
        cell: impl FnMut(&'r R) -> C,
    ) -> Self {
        self.table.columns.push(Column::new(group, name, dim, digits, self.rows.iter().map(cell)));
        self
    }

    /// Adds a column of words, under no group head.
    pub fn text<C: Into<Cell>>(self, name: &str, cell: impl FnMut(&'r R) -> C) -> Self {
        self.column("", name, Dim::None, Digits::Usual, cell)
    }

    /// Adds columns of one group, dimension and digits with the cells of each row, SI: the components of a vector.
    pub fn columns<C: Into<Cell>, const N: usize>(
        mut self,
        group: &str,
        names: [&str; N],
        dim: Dim,
        digits: Digits,
        mut cells: impl FnMut(&'r R) -> [C; N],
    ) -> Self {
        let mut columns =
            names.map(|name| Column { name: name.into(), group: group.into(), dim, digits, cells: Vec::new() });
        for row in self.rows {
            for (column, cell) in columns.iter_mut().zip(cells(row)) {
                column.cells.push(cell.into());
            }
        }
        self.table.columns.extend(columns);
        self
    }

    /// Adds a fact to the sub-header; returns the table for chaining.
    pub fn fact(mut self, name: &str, value: impl Into<Cell>, dim: Dim) -> Self {
        self.table = self.table.fact(name, value, dim);
        self
    }

    /// The table with the columns added so far. Columns it had before, of other rows, are made as long.
    pub fn build(self) -> Table {
        self.table.filled_up()
    }
}

impl Column {
    /// A column of texts that end below each other: numbers whose digits go with the row.
    pub fn right_aligned(group: &str, name: &str, texts: impl IntoIterator<Item = String>) -> Self {
        let texts: Vec<String> = texts.into_iter().collect();
        let width = texts.iter().map(|text| text.chars().count()).max().unwrap_or(0);
        Column::new(group, name, Dim::None, Digits::Usual, texts.into_iter().map(|text| format!("{text:>width$}")))
    }

    /// A column under a group head (empty text for none) with its cells, SI.
    pub fn new(
        group: &str,
        name: &str,
        dim: Dim,
        digits: Digits,
        cells: impl IntoIterator<Item = impl Into<Cell>>,
    ) -> Self {
        let cells = cells.into_iter().map(Into::into).collect();
        Column { name: name.into(), group: group.into(), dim, digits, cells }
    }

    /// The numbers of the column, SI; cells without one are skipped.
    pub fn numbers(&self) -> Vec<f64> {
        self.cells.iter().filter_map(Cell::number).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(table: &Table) -> Vec<Vec<Option<f64>>> {
        table.columns().iter().map(|column| column.cells.iter().map(Cell::number).collect()).collect()
    }

    fn column(name: &str, values: &[f64]) -> Column {
        Column::new("", name, Dim::None, Digits::Usual, values.iter().copied())
    }

    #[test]
    fn added_column_of_another_length_fills_shorter_ones_with_missing_cells() {
        let mut table = Table::from_columns("T", vec![column("A", &[1.0, 2.0])]);
        table.add_column(column("B", &[3.0]));
        assert_eq!(numbers(&table), [[Some(1.0), Some(2.0)], [Some(3.0), None]]);
        table.add_column(column("C", &[4.0, 5.0, 6.0]));
        assert_eq!((table.rows(), table.get("A").map(|a| a.cells.len())), (3, Some(3)));
        assert_eq!(numbers(&table)[2], [Some(4.0), Some(5.0), Some(6.0)]);
    }

    #[test]
    fn kept_rows_stay_in_order_in_every_column() {
        let mut table = Table::from_columns("T", vec![column("A", &[1.0, 2.0, 3.0]), column("B", &[4.0, 5.0, 6.0])]);
        table.keep_rows(|row| row != 1);
        assert_eq!(numbers(&table), [[Some(1.0), Some(3.0)], [Some(4.0), Some(6.0)]]);
        table.keep_rows(|_| false);
        assert_eq!((table.rows(), table.columns().len()), (0, 2));
    }

    #[test]
    fn mapped_cells_see_their_column_row_and_value() {
        let mut table = Table::from_columns("T", vec![column("A", &[1.0, 2.0]), column("B", &[3.0, 4.0])]);
        table.map_cells(|column, row, cell| match cell {
            Cell::Number(number) if column.name == "B" => Cell::Number(number * 10.0 + row as f64),
            _ => Cell::Missing,
        });
        assert_eq!(numbers(&table), [[None, None], [Some(30.0), Some(41.0)]]);
    }
}
