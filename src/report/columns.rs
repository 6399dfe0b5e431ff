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
    // a number too long for the machine is past the last column too
    let number = |text: &str| {
        let digits = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        digits.then(|| text.parse::<usize>().unwrap_or(usize::MAX))
    };
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
    let begins = |c: &Column| c.name.get(..selector.len()).is_some_and(|head| head.eq_ignore_ascii_case(selector));
    let prefix = if selector.is_empty() { Vec::new() } else { fits(&begins) };
    if prefix.len() == 1 {
        return Ok(prefix);
    }
    let names: Vec<&str> = table.columns.iter().map(|c| c.name.as_str()).collect();
    let several: Vec<&str> = prefix.iter().filter_map(|i| names.get(*i).copied()).collect();
    let help = if several.is_empty() {
        did_you_mean(selector, names)
    } else {
        Some(format!("it could be {}", several.join(" or ")))
    };
    Err(NoSuchColumn { name: selector.to_string(), help })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::units::Dim;
    use crate::table::Digits;
    use proptest::prelude::*;

    fn table(names: &[&str]) -> Table {
        names.iter().fold(Table::new("t"), |t, n| t.column("G", n, Dim::None, Digits::Usual))
    }

    #[test]
    fn by_number_range_name_wild_character_and_prefix() {
        let table = table(&["X", "Force", "DF/DX", "Ten Top"]);
        assert_eq!(choose(&table, "2"), Ok(vec![1]));
        assert_eq!(choose(&table, "3:9"), Ok(vec![2, 3]));
        assert_eq!(choose(&table, "7"), Ok(vec![]));
        assert_eq!(choose(&table, "ten@"), Ok(vec![3]));
        assert_eq!(choose(&table, "fo"), Ok(vec![1]));
        assert!(choose(&table, "Tne Top").unwrap_err().to_string().contains("Ten Top"));
    }

    #[test]
    fn surplus_numbers_are_dropped_and_two_readings_are_told() {
        let table = table(&["Force", "Form"]);
        for surplus in ["0", "99999999999999999999999", "3:99999999999999999999999", "2:1"] {
            assert_eq!(choose(&table, surplus), Ok(vec![]), "{surplus}");
        }
        assert!(choose(&table, "fo").unwrap_err().to_string().contains("it could be Force or Form"));
        assert!(choose(&table, "").is_err());
    }

    proptest! {
        #[test]
        fn any_selector_chooses_columns_that_exist_or_is_refused(selector in "[0-9:@/a-zA-Z \\-\u{e9}\u{df}]{0,12}|\\PC{0,20}") {
            let table = table(&["X", "Force", "\u{df}e", "DF/DX"]);
            if let Ok(chosen) = choose(&table, &selector) {
                prop_assert!(chosen.iter().all(|i| *i < 4));
            }
        }
    }
}
