//! Post-processing of tables: the first column is time, the others are series. Each function returns a table of its own,
//! SI, with the columns of one series under a group head of its name.

mod distribution;
mod extremes;
mod harmonics;
mod spectra;

pub use distribution::{exceedance, histogram, rainflow};
pub use extremes::{Extremes, extremes};
pub use harmonics::{Analysis, harmonics};
pub use spectra::{amplitudes, density, moments};

use super::SeriesError;
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::Dim;

/// A series of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct TableSeries {
    /// Name of its column, with the group head.
    pub name: String,
    /// What it measures.
    pub dim: Dim,
    /// Its values, SI.
    pub values: Vec<f64>,
}

/// Times and the series over them.
#[derive(Clone, Debug, PartialEq)]
pub struct SeriesRecord {
    /// Title of the table they come from.
    pub title: String,
    /// Times (s).
    pub times: Vec<f64>,
    /// The series.
    pub series: Vec<TableSeries>,
}

/// Name of a column with its group, as `Tension: Ten Top`.
fn long_name(column: &Column) -> String {
    if column.group.is_empty() { column.name.clone() } else { format!("{}: {}", column.group, column.name) }
}

fn values(column: &Column) -> Result<Vec<f64>, SeriesError> {
    let number = |(row, cell): (usize, &Cell)| {
        let missing = || SeriesError::Refused(format!("column {} has no value in row {}", column.name, row + 1));
        cell.number().ok_or_else(missing)
    };
    column.cells.iter().enumerate().map(number).collect()
}

impl SeriesRecord {
    /// The record of a table whose first column is time, or a plain number that stands for seconds.
    ///
    /// # Errors
    /// A table of one column, a first column that measures something else, a cell without a number, times that do not grow.
    pub fn from_table(table: &Table) -> Result<SeriesRecord, SeriesError> {
        let Some((time, rest)) = table.columns().split_first().filter(|(_, rest)| !rest.is_empty()) else {
            return Err(SeriesError::Refused("the time and at least one more column are needed".into()));
        };
        if !matches!(time.dim, Dim::Time | Dim::None) {
            let text = format!("column {}, the first, is no time", long_name(time));
            return Err(SeriesError::Refused(text));
        }
        let times = values(time)?;
        super::check_times(&times, &times)?;
        let series = rest.iter().map(|c| {
            let values = values(c)?;
            super::finite(&values)?;
            Ok(TableSeries { name: long_name(c), dim: c.dim, values })
        });
        Ok(SeriesRecord { title: table.title.clone(), series: series.collect::<Result<_, SeriesError>>()?, times })
    }

    /// Seconds from the first time to one step behind the last.
    pub fn length(&self) -> f64 {
        match (self.times.first(), self.times.last()) {
            (Some(first), Some(last)) if self.times.len() > 1 => {
                (last - first) * (self.times.len() as f64 / (self.times.len() - 1) as f64)
            }
            _ => 0.0,
        }
    }
}

/// Six figures: what a reader needs of a result whose size is not known beforehand.
const SIX_DIGITS: Digits = Digits::Scientific(6);

fn numbers(values: impl IntoIterator<Item = f64>) -> Vec<Cell> {
    values.into_iter().map(Cell::Number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn record_has_time_and_series_without_gaps() {
        let mut t = Table::new("t")
            .with_rows(&[0.0, 1.0, 2.0])
            .column("", "Time", Dim::Time, Digits::Usual, |time| *time)
            .column("A", "F", Dim::Force, Digits::Usual, |_| 5usize)
            .build();
        let r = SeriesRecord::from_table(&t).unwrap();
        assert_eq!((r.series[0].name.as_str(), r.length()), ("A: F", 3.0));
        let mut columns = t.columns().to_vec();
        columns[1].cells[1] = Cell::Missing;
        t = t.with_columns(columns.clone());
        assert!(SeriesRecord::from_table(&t).unwrap_err().to_string().contains("row 2"));
        columns[0].dim = Dim::Length;
        t = t.with_columns(columns);
        assert!(SeriesRecord::from_table(&t).unwrap_err().to_string().contains("no time"));
        assert!(SeriesRecord::from_table(&Table::new("t")).is_err());
    }
}
