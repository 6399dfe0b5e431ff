//! A table's columns as a binary file keeps them: one type of value a column, user units.

use super::format;
use windlass_base::table::{Cell, Column, Table};
use windlass_base::units::UnitSystem;

/// What wrote a file.
pub const SOURCE: &str = concat!("windlass ", env!("CARGO_PKG_VERSION"));

/// Why a table could not be stored.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StoreError {
    /// There is no row.
    #[error("there is no row to store")]
    Empty,
    /// The library refused.
    #[error("the file could not be made: {0}")]
    Library(String),
}

/// Values of a column; none where a cell has none.
#[derive(Clone, Debug, PartialEq)]
pub enum ColumnValues {
    /// Numbers in user units.
    Numbers(Vec<Option<f64>>),
    /// Whole numbers.
    Wholes(Vec<Option<i64>>),
    /// Text.
    Texts(Vec<Option<String>>),
}

impl ColumnValues {
    /// How many rows there are.
    pub fn len(&self) -> usize {
        match self {
            ColumnValues::Numbers(list) => list.len(),
            ColumnValues::Wholes(list) => list.len(),
            ColumnValues::Texts(list) => list.len(),
        }
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A column with a name no other has.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredColumn {
    /// Its name with its unit, as in a CSV file.
    pub head: String,
    /// Its name with its group.
    pub long_name: String,
    /// Its unit; empty of plain numbers and text.
    pub unit: String,
    /// Its values.
    pub values: ColumnValues,
}

/// The columns of a table.
///
/// # Errors
/// [`StoreError::Empty`].
pub fn stored_columns(table: &Table, units: UnitSystem) -> Result<Vec<StoredColumn>, StoreError> {
    if table.rows() == 0 { Err(StoreError::Empty) } else { Ok(columns_of(table, units)) }
}

/// The columns of a table, of one without rows too.
pub fn columns_of(table: &Table, units: UnitSystem) -> Vec<StoredColumn> {
    let make = |(column, head): (&Column, String)| StoredColumn {
        head,
        long_name: super::columns::long_name(column),
        unit: column.dim.label(units),
        values: values(column, units),
    };
    table.columns().iter().zip(super::csv::heads(table, units)).map(make).collect()
}

/// The narrowest type that holds every cell.
fn values(column: &Column, units: UnitSystem) -> ColumnValues {
    let cells = || column.cells.iter();
    if cells().any(|c| matches!(c, Cell::Text(_))) {
        let text = |c: &Cell| (*c != Cell::Missing).then(|| format::full(c, column.dim, units));
        return ColumnValues::Texts(cells().map(text).collect());
    }
    if cells().all(|c| matches!(c, Cell::Integer(_) | Cell::Missing)) && cells().any(|c| *c != Cell::Missing) {
        let whole = |c: &Cell| if let Cell::Integer(n) = c { Some(*n) } else { None };
        return ColumnValues::Wholes(cells().map(whole).collect());
    }
    let number = |c: &Cell| match c {
        Cell::Number(value) => Some(column.dim.from_si(*value, units)),
        other => other.number(),
    };
    ColumnValues::Numbers(cells().map(number).collect())
}
