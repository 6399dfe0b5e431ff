//! Tables read back from text: what STORE wrote, or any series in columns.
//!
//! Source: [MOSES-REF men_buildg]: `&BUILDG -BRIEF` reads labels, one per line, a blank, and rows of numbers;
//! `&BUILDG -CSV` a line of heads and rows, which the example there parts by blanks. A head that ends in a unit in parentheses, as STORE writes it, gives its column
//! that dimension, whatever units the user has now.

use super::csv::remove_guard;
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::{Dim, ForceUnit, LengthUnit, UnitSystem};

/// Why a text is no table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TableReadError {
    /// A row with another number of cells than there are heads.
    #[error("line {line} holds {got} values for {want} columns")]
    Cells {
        /// Line, from 1.
        line: usize,
        /// Values in it.
        got: usize,
        /// Columns.
        want: usize,
    },
    /// A number that is not finite.
    #[error("line {line}: {text} is not a finite number")]
    NotFinite {
        /// Line, from 1.
        line: usize,
        /// The word.
        text: String,
    },
    /// What the CSV reader says.
    #[error("{0}")]
    Csv(String),
    /// No rows.
    #[error("there are no rows of values")]
    NoRows,
    /// More columns than a table has.
    #[error("{0} columns are more than the 10000 a table may have")]
    Wide(usize),
}

/// Most columns of a table: a text with more is no series in columns.
const MAX_COLUMNS: usize = 10_000;

/// The dimensions whose units a head may name.
const DIMS: [Dim; 20] = [
    Dim::Length,
    Dim::Section,
    Dim::Time,
    Dim::Days,
    Dim::Angle,
    Dim::Force,
    Dim::Moment,
    Dim::ForcePerLength,
    Dim::MomentPerRadian,
    Dim::Stress,
    Dim::Velocity,
    Dim::WindSpeed,
    Dim::Acceleration,
    Dim::Frequency,
    Dim::Area,
    Dim::Volume,
    Dim::Density,
    Dim::SpectralDensity,
    Dim::AngleDensity,
    Dim::MassPerLength,
];

/// A column as its head says: name, dimension, and the units its numbers are in.
fn head(text: &str) -> (String, Dim, UnitSystem) {
    let plain = (text.to_string(), Dim::None, UnitSystem::SI);
    let Some((name, unit)) = text.strip_suffix(')').and_then(|t| t.rsplit_once(" (")) else { return plain };
    let forces = [
        ForceUnit::Kips,
        ForceUnit::LongTons,
        ForceUnit::ShortTons,
        ForceUnit::Kilonewtons,
        ForceUnit::MetricTons,
        ForceUnit::Newtons,
    ];
    let systems = [LengthUnit::Feet, LengthUnit::Meters]
        .into_iter()
        .flat_map(|length| forces.into_iter().map(move |force| UnitSystem { length, force }));
    let found = systems.flat_map(|s| DIMS.into_iter().map(move |d| (d, s))).find(|(d, s)| d.label(*s) == unit);
    found.map_or(plain, |(dim, units)| (name.trim().to_string(), dim, units))
}

/// Whether a word is a number, finite or not.
fn number(word: &str) -> Option<f64> {
    word.parse().ok()
}

struct ReadTable {
    title: String,
    columns: Vec<Column>,
    units: Vec<UnitSystem>,
}

impl ReadTable {
    fn from_heads(title: &str, heads: &[&str]) -> Result<ReadTable, TableReadError> {
        if heads.len() > MAX_COLUMNS {
            return Err(TableReadError::Wide(heads.len()));
        }
        let mut made = ReadTable { title: title.into(), columns: Vec::new(), units: Vec::new() };
        for (index, text) in heads.iter().enumerate() {
            let (name, dim, units) = head(remove_guard(text.trim()));
            let name = if name.is_empty() { format!("Column {}", index + 1) } else { name };
            let digits = if dim == Dim::None { SIX_DIGITS } else { Digits::Usual };
            made.columns.push(Column::new("", &name, dim, digits, [] as [Cell; 0]));
            made.units.push(units);
        }
        Ok(made)
    }

    fn push(&mut self, line: usize, words: &[&str]) -> Result<(), TableReadError> {
        let want = self.columns.len();
        if words.len() != want {
            return Err(TableReadError::Cells { line, got: words.len(), want });
        }
        for ((column, word), units) in self.columns.iter_mut().zip(words).zip(&self.units) {
            let word = word.trim();
            let cell = match number(word) {
                Some(value) => {
                    let si = column.dim.to_si(value, *units);
                    if !si.is_finite() {
                        return Err(TableReadError::NotFinite { line, text: word.into() });
                    }
                    Cell::Number(si)
                }
                None if word.is_empty() => Cell::Missing,
                None => Cell::Text(remove_guard(word).into()),
            };
            column.cells.push(cell);
        }
        Ok(())
    }

    fn into_table(self) -> Result<Table, TableReadError> {
        let table = Table::from_columns(self.title, self.columns);
        if table.rows() == 0 { Err(TableReadError::NoRows) } else { Ok(table) }
    }
}

/// Digits of a column that is a plain number of unknown size.
const SIX_DIGITS: Digits = Digits::Scientific(6);

/// A line of words parted by blanks as one parted by commas; a word in parentheses goes with the word before it.
fn by_commas(line: &str, joins_units: bool) -> String {
    let mut cells: Vec<String> = Vec::new();
    for word in line.split_whitespace() {
        match cells.last_mut() {
            Some(last) if joins_units && word.starts_with('(') => *last = format!("{last} {word}"),
            _ => cells.push(word.to_string()),
        }
    }
    cells.join(",")
}

/// A text in which lines without a comma part their words by blanks, with commas. Quotes part nothing.
fn blanks_to_commas(text: &str) -> Option<String> {
    let parted = |line: &str| !line.contains(',') && line.split_whitespace().count() > 1;
    if text.contains('"') || !text.lines().any(parted) {
        return None;
    }
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let cells = |line: &str| match line.contains(',') {
        true => line.split(',').count(),
        false => line.split_whitespace().count(),
    };
    let first = lines.next()?;
    let is_row = first.split([' ', '\t', ',']).filter(|w| !w.is_empty()).all(|w| number(w).is_some());
    // of one column a head may be of several words
    let columns = if is_row { cells(first) } else { lines.next().map_or(1, cells) };
    if columns < 2 {
        return None;
    }
    let mut is_head = !is_row;
    let one = |line: &str| {
        let made = if parted(line) { by_commas(line, is_head) } else { line.to_string() };
        is_head = is_head && line.trim().is_empty();
        made
    };
    Some(text.lines().map(one).collect::<Vec<_>>().join("\n"))
}

/// A table from comma-separated values: a line of heads, unless all its words are numbers, and rows.
///
/// # Errors
/// A row of another length than the first, a number that is not finite, no rows.
pub fn csv(title: &str, text: &str) -> Result<Table, TableReadError> {
    let parted = blanks_to_commas(text);
    let text = parted.as_deref().unwrap_or(text);
    let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.as_bytes());
    let mut made: Option<ReadTable> = None;
    for record in reader.records() {
        let record = record.map_err(|e| TableReadError::Csv(e.to_string()))?;
        let line = record.position().map_or(0, |p| usize::try_from(p.line()).unwrap_or(usize::MAX));
        let words: Vec<&str> = record.iter().collect();
        let values = words.iter().all(|w| number(w.trim()).is_some());
        let table = match &mut made {
            Some(table) => table,
            None if values => made.insert(ReadTable::from_heads(title, &vec![""; words.len()])?),
            None => {
                made = Some(ReadTable::from_heads(title, &words)?);
                continue;
            }
        };
        table.push(line, &words)?;
    }
    made.ok_or(TableReadError::NoRows)?.into_table()
}

/// A table from labels, one a line, and rows of numbers parted by blanks or commas, behind a blank line or not: the rows begin
/// with the first line of nothing but numbers.
///
/// # Errors
/// A row of another length than there are labels, a number that is not finite, no rows.
pub fn brief(title: &str, text: &str) -> Result<Table, TableReadError> {
    let mut labels: Vec<&str> = Vec::new();
    let mut made: Option<ReadTable> = None;
    for (index, line) in text.lines().enumerate() {
        let words: Vec<&str> = line.split([' ', '\t', ',']).filter(|w| !w.is_empty()).collect();
        if words.is_empty() {
            continue;
        }
        let table = match &mut made {
            Some(table) => table,
            None if words.iter().all(|w| number(w).is_some()) => {
                let heads = if labels.is_empty() { vec![""; words.len()] } else { std::mem::take(&mut labels) };
                made.insert(ReadTable::from_heads(title, &heads)?)
            }
            None => {
                labels.push(line);
                continue;
            }
        };
        table.push(index + 1, &words)?;
    }
    made.ok_or(TableReadError::NoRows)?.into_table()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::csv as written;

    #[test]
    fn stored_table_reads_back_in_any_units() {
        let t = Table::new("t")
            .with_rows(&[(0.5, Some(1e6), 0.25, "a,b"), (1.0, None, -0.5, "c")])
            .column("", "Time", Dim::Time, Digits::Usual, |row| row.0)
            .column("", "Ten Top", Dim::Force, Digits::Usual, |row| row.1)
            .column("", "Roll", Dim::Angle, Digits::Usual, |row| row.2)
            .text("State", |row| row.3)
            .build();
        for units in [UnitSystem::default(), UnitSystem::SI] {
            let text = String::from_utf8(written::bytes(&t, units).unwrap()).unwrap();
            let read = csv("t", &text).unwrap();
            assert_eq!(
                read.columns().iter().map(|c| c.dim).collect::<Vec<_>>(),
                t.columns().iter().map(|c| c.dim).collect::<Vec<_>>()
            );
            // kips and degrees and back: two roundings
            let (a, b) = (read.columns()[1].numbers()[0], read.columns()[2].numbers()[1]);
            assert!((a - 1e6).abs() < 1e-9 && (b + 0.5).abs() < 1e-15);
            assert_eq!(
                (&read.columns()[1].cells[1], &read.columns()[3].cells[0]),
                (&Cell::Missing, &Cell::Text("a,b".into()))
            );
        }
    }

    #[test]
    fn one_label_per_line_is_read_above_rows_with_or_without_blank() {
        for blank in ["", "\n"] {
            let t = brief("t", &format!("Time (s)\nPower of 2\n{blank}0 1\n1, 2\n2\t4\n")).unwrap();
            assert_eq!((t.columns()[1].name.as_str(), t.columns()[1].numbers()), ("Power of 2", vec![1.0, 2.0, 4.0]));
            assert_eq!((t.columns()[0].name.as_str(), t.columns()[0].dim), ("Time", Dim::Time));
        }
        assert_eq!(brief("t", "1 2\n3 4").unwrap().columns()[1].name, "Column 2");
    }

    #[test]
    fn lines_without_commas_are_parted_by_blanks() {
        let t = csv("t", "Time (s)  Tension (kips)\n0 100\n1.5, 120\n").unwrap();
        assert_eq!(t.columns()[0].numbers(), [0.0, 1.5]);
        assert_eq!((t.columns()[1].name.as_str(), t.columns()[1].dim), ("Tension", Dim::Force));
        // heads by commas, and one column whose head has two words
        assert_eq!(csv("t", "Top Tension,Z\n1 2\n").unwrap().columns()[0].name, "Top Tension");
        assert_eq!(csv("t", "Top Tension\n1\n2\n").unwrap().columns()[0].name, "Top Tension");
        assert_eq!(csv("t", "1 2\n3 4\n").unwrap().columns()[1].numbers(), [2.0, 4.0]);
    }

    #[test]
    fn text_without_table_is_reported_with_its_line() {
        assert_eq!(csv("t", "a,b\n1,2\n3\n"), Err(TableReadError::Cells { line: 3, got: 1, want: 2 }));
        assert_eq!(csv("t", "a\n1\ninf\n"), Err(TableReadError::NotFinite { line: 3, text: "inf".into() }));
        assert_eq!(csv("t", "a,b\n"), Err(TableReadError::NoRows));
        assert_eq!(brief("t", "only a label\n"), Err(TableReadError::NoRows));
        assert_eq!(brief("t", "a\n1 2"), Err(TableReadError::Cells { line: 2, got: 2, want: 1 }));
    }
}
