//! Choosing columns of a table as the disposition menu does: a number, `a:b`, or a name with wild characters.
//!
//! Source: reference/solve.md, "Disposition menu"; numbers past the last column are dropped, as there.

use crate::language::diagnostic::did_you_mean;
use crate::language::select::matches;
use crate::table::{Column, Table};

/// A selector that names nothing.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("no column is called {name}{}", help.as_ref().map_or(String::new(), |h| format!(": {h}")))]
pub struct NoSuchColumn {
    /// The selector.
    pub name: String,
    /// The nearest names.
    pub help: Option<String>,
}

/// Name with its group, as `VLIST` prints it: `Tension: Ten Top`.
pub fn long_name(column: &Column) -> String {
    if column.group.is_empty() { column.name.clone() } else { format!("{}: {}", column.group, column.name) }
}

/// The columns (from 0) a selector chooses, in the table's order.
///
/// # Errors
/// A name that fits no column.
pub fn choose(table: &Table, selector: &str) -> Result<Vec<usize>, NoSuchColumn> {
    let count = table.columns.len();
    let number = |text: &str| text.parse::<usize>().ok();
    if let Some(n) = number(selector) {
        return Ok((1..=count).filter(|i| *i == n).map(|i| i - 1).collect());
    }
    if let Some((from, to)) = selector.split_once(':')
        && let (Some(from), Some(to)) = (number(from), number(to))
    {
        return Ok((1..=count).filter(|i| (from..=to).contains(i)).map(|i| i - 1).collect());
    }
    let fits = |test: &dyn Fn(&Column) -> bool| -> Vec<usize> {
        table.columns.iter().enumerate().filter(|(_, c)| test(c)).map(|(i, _)| i).collect()
    };
    let exact = fits(&|c| matches(selector, &c.name) || matches(selector, &long_name(c)));
    if !exact.is_empty() {
        return Ok(exact);
    }
    let prefix = fits(&|c| c.name.get(..selector.len()).is_some_and(|head| head.eq_ignore_ascii_case(selector)));
    if prefix.len() == 1 {
        return Ok(prefix);
    }
    let names = table.columns.iter().map(|c| c.name.as_str());
    Err(NoSuchColumn { name: selector.to_string(), help: did_you_mean(selector, names) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::units::Dim;
    use crate::table::Digits;

    #[test]
    fn by_number_range_name_wild_character_and_prefix() {
        let table = ["X", "Force", "DF/DX", "Ten Top"]
            .iter()
            .fold(Table::new("t"), |t, n| t.column("G", n, Dim::None, Digits::Usual));
        assert_eq!(choose(&table, "2"), Ok(vec![1]));
        assert_eq!(choose(&table, "3:9"), Ok(vec![2, 3]));
        assert_eq!(choose(&table, "7"), Ok(vec![]));
        assert_eq!(choose(&table, "ten@"), Ok(vec![3]));
        assert_eq!(choose(&table, "fo"), Ok(vec![1]));
        assert!(choose(&table, "Tne Top").unwrap_err().to_string().contains("Ten Top"));
    }
}
