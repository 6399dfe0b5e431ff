//! Where a script leaves a result: a variable, a cell or a column of a table, a fact above a table.

use super::printed::Printed;
use crate::commands::KeptTable;
use crate::report::columns::{choose, long_name};
use crate::report::format::rounded_to_fifteen_figures;
use windlass_base::diagnostic::did_you_mean;
use windlass_base::table::{Cell, Column, Fact, Table};
use windlass_base::units::UnitSystem;

/// Where a result stands.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// `%NAME%`: a variable of the script; `%NAME 2%` is the second word of it.
    Variable(String, usize),
    /// `Table | Fact`.
    Fact {
        /// Title of the table.
        table: String,
        /// Name of the fact.
        fact: String,
    },
    /// `Table | Row | Column`.
    Cell {
        /// Title of the table, or the name of a CSV file that the script wrote.
        table: String,
        /// The row.
        row: Row,
        /// Selector of the column; of several, separated by commas, it is the root of the sum of squares.
        column: String,
    },
}

/// The row of a cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Row {
    /// The first.
    First,
    /// The last.
    Last,
    /// That of the largest number of the column.
    Max,
    /// That of the least number of the column.
    Min,
    /// That in which columns have these values, or round to them, the nearest: `Body=SHIP, Mode=2`.
    Where(Vec<(String, String)>),
    /// The row that holds this word.
    Word(String),
    /// Every row.
    All,
}

impl Place {
    /// Reads a place. `Err` says what is wrong.
    ///
    /// # Errors
    /// Empty parts, too many of them.
    pub fn read(text: &str) -> Result<Place, String> {
        if let Some(name) = text.trim().strip_prefix('%').and_then(|rest| rest.strip_suffix('%')) {
            let mut words = name.split_whitespace();
            let (name, number) = (words.next(), words.next().map(str::parse::<usize>));
            return match (name, number, words.next()) {
                (Some(name), None, None) => Ok(Place::Variable(name.into(), 1)),
                (Some(name), Some(Ok(n @ 1..)), None) => Ok(Place::Variable(name.into(), n)),
                _ => Err("a variable is written %NAME%, the second word of it %NAME 2%".into()),
            };
        }
        let parts: Vec<&str> = text.split('|').map(str::trim).collect();
        match parts.as_slice() {
            [table, fact] if !table.is_empty() && !fact.is_empty() => {
                Ok(Place::Fact { table: (*table).into(), fact: (*fact).into() })
            }
            [table, row, column] if !table.is_empty() && !row.is_empty() && !column.is_empty() => {
                Ok(Place::Cell { table: (*table).into(), row: Row::read(row), column: (*column).into() })
            }
            _ => Err("a place is written `%VARIABLE%`, `Table | Fact` or `Table | Row | Column`".into()),
        }
    }

    /// Whether it is a whole column.
    pub fn is_column(&self) -> bool {
        matches!(self, Place::Cell { row: Row::All, .. })
    }
}

impl Row {
    fn read(text: &str) -> Row {
        match text {
            "first" => Row::First,
            "last" => Row::Last,
            "max" => Row::Max,
            "min" => Row::Min,
            "*" => Row::All,
            _ => {
                let pairs: Option<Vec<_>> = text
                    .split(',')
                    .map(|part| part.split_once('=').map(|(name, value)| (name.trim().into(), value.trim().into())))
                    .collect();
                pairs.map_or_else(|| Row::Word(text.into()), Row::Where)
            }
        }
    }
}

/// A fact of the last kept table of a title.
///
/// # Errors
/// There is no such table or fact, or it is no number.
pub fn find_fact(tables: &[KeptTable], title: &str, name: &str) -> Result<f64, String> {
    let kept = find_table(tables, title)?;
    let found = kept.table.facts.iter().find(|fact| fact.name.trim().eq_ignore_ascii_case(name));
    let Some(Fact { value, dim, .. }) = found else {
        let names = kept.table.facts.iter().map(|fact| fact.name.as_str());
        return Err(missing("fact", name, names));
    };
    let number = value.number().ok_or_else(|| format!("fact {name} of {title} is no number"))?;
    Ok(match value {
        Cell::Number(_) => rounded_to_fifteen_figures(dim.from_si(number, kept.units)),
        _ => number,
    })
}

/// The numbers of a column in the chosen rows.
///
/// # Errors
/// There is no such table, column or row, or a cell is no number.
pub fn find_cells(tables: &[KeptTable], title: &str, row: &Row, selector: &str) -> Result<Vec<f64>, String> {
    let parts: Vec<&str> = selector.split(',').map(str::trim).collect();
    if parts.len() > 1 {
        let mut squares: Vec<f64> = Vec::new();
        for part in parts {
            let found = find_cells(tables, title, row, part)?;
            squares.resize(found.len(), 0.0);
            squares.iter_mut().zip(found).for_each(|(sum, value)| *sum += value * value);
        }
        return Ok(squares.into_iter().map(f64::sqrt).collect());
    }
    let kept = find_table(tables, title)?;
    let column = one_column(&kept.table, selector)?;
    let rows = match row {
        Row::All => (0..kept.table.rows()).collect(),
        _ => vec![find_row(kept, row, column)?],
    };
    let number = |row: usize| {
        let cell = column.cells.get(row).and_then(|cell| in_user_units(column, cell, kept.units));
        cell.ok_or_else(|| format!("row {} of column {selector} of {title} is no number", row + 1))
    };
    rows.into_iter().map(number).collect()
}

fn in_user_units(column: &Column, cell: &Cell, units: UnitSystem) -> Option<f64> {
    match cell {
        Cell::Number(value) => Some(rounded_to_fifteen_figures(column.dim.from_si(*value, units))),
        // numbers that a report aligns, and those of a file, stand as text
        Cell::Text(text) => Printed::read(text.trim()).map(|printed| printed.value),
        other => other.number(),
    }
}

/// The last table of a title; `Title #2` is the second of that title.
fn find_table<'t>(tables: &'t [KeptTable], title: &str) -> Result<&'t KeptTable, String> {
    let (name, number) = match title.rsplit_once(" #") {
        Some((name, number)) => (name, number.parse::<usize>().ok()),
        None => (title, None),
    };
    let mut fitting = tables.iter().filter(|kept| kept.table.title.eq_ignore_ascii_case(name));
    let found = match number {
        Some(number) => fitting.nth(number.saturating_sub(1)),
        None => fitting.next_back(),
    };
    found.ok_or_else(|| missing("table", title, tables.iter().map(|kept| kept.table.title.as_str())))
}

fn one_column<'t>(table: &'t Table, selector: &str) -> Result<&'t Column, String> {
    let chosen = choose(table, selector).map_err(|error| {
        let names: Vec<String> = table.columns().iter().map(long_name).collect();
        format!("{error}; {} has {}", table.title, names.join(", "))
    })?;
    match chosen.as_slice() {
        [one] => table.columns().get(*one).ok_or_else(|| format!("no column is called {selector}")),
        several => {
            let names: Vec<String> = several.iter().filter_map(|n| table.columns().get(*n)).map(long_name).collect();
            Err(format!("several columns are called {selector}: {}", names.join(", ")))
        }
    }
}

fn find_row(kept: &KeptTable, row: &Row, column: &Column) -> Result<usize, String> {
    let table = &kept.table;
    let numbers = || {
        let numbered = column.cells.iter().enumerate();
        numbered.filter_map(|(at, cell)| in_user_units(column, cell, kept.units).map(|number| (at, number)))
    };
    let found = match row {
        Row::First => (table.rows() > 0).then_some(0),
        Row::Last => table.rows().checked_sub(1),
        Row::Max => numbers().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(at, _)| at),
        Row::Min => numbers().min_by(|a, b| a.1.total_cmp(&b.1)).map(|(at, _)| at),
        Row::Word(word) => (0..table.rows()).find(|at| {
            table
                .row(*at)
                .into_iter()
                .any(|cell| matches!(cell, Cell::Text(text) if text.trim().eq_ignore_ascii_case(word)))
        }),
        Row::Where(pairs) => {
            let mut columns = Vec::new();
            for (name, value) in pairs {
                columns.push((one_column(table, name)?, value));
            }
            let distance = |at: usize| -> Option<f64> {
                let of = |(column, value): &(&Column, &String)| {
                    column.cells.get(at).and_then(|cell| distance_to(column, cell, value, kept.units))
                };
                columns.iter().map(of).sum()
            };
            let fitting = (0..table.rows()).filter_map(|at| distance(at).map(|far| (at, far)));
            fitting.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(at, _)| at)
        }
        Row::All => None,
    };
    found.ok_or_else(|| match row {
        Row::Word(word) => format!("no row of {} holds {word}", table.title),
        Row::Where(pairs) => {
            let said: Vec<String> = pairs.iter().map(|(name, value)| format!("{name}={value}")).collect();
            format!("no row of {} has {}", table.title, said.join(", "))
        }
        _ => format!("{} has no row with a number", table.title),
    })
}

/// How far a cell is from the value that chooses it, in units of the last digit; `None` where it does not round to it.
fn distance_to(column: &Column, cell: &Cell, value: &str, units: UnitSystem) -> Option<f64> {
    if let Cell::Text(text) = cell
        && text.trim().eq_ignore_ascii_case(value)
    {
        return Some(0.0);
    }
    let (have, want) = (in_user_units(column, cell, units)?, Printed::read(value)?);
    Some((have - want.value).abs() / want.unit).filter(|far| *far <= 0.5 + 1e-6)
}

/// What is said where a name is not there.
fn missing<'n>(kind: &str, name: &str, names: impl Iterator<Item = &'n str>) -> String {
    let mut names: Vec<&str> = names.collect();
    names.dedup();
    let near = did_you_mean(name, names.iter().copied());
    let list = if names.is_empty() { format!("there is no {kind}") } else { format!("there are {}", names.join(", ")) };
    format!("there is no {kind} {name}: {}", near.unwrap_or(list))
}
