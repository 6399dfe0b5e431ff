//! Choosing columns of a table as the disposition menu does: a number, `a:b`, or a name with wild characters; in a report also the
//! name of a group of columns.
//!
//! Source: [MOSES-REF disp_men]. The surplus columns it drops are those beyond what a command takes; a number
//! of no column is an error.

use windlass_base::diagnostic::suggest;
use windlass_base::table::{Column, Table};
use windlass_base::wildcard::matches;

/// A selector that names nothing.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("no column is called {name}{}", help.as_ref().map_or(String::new(), |h| format!(": {h}")))]
pub struct NoSuchColumn {
    /// The selector.
    pub name: String,
    /// The nearest names.
    pub help: Option<String>,
}

/// How a selector chooses columns.
pub type Choose = fn(&Table, &str) -> Result<Vec<usize>, NoSuchColumn>;

/// Name with its group, as `VLIST` prints it: `Tension: Ten Top`.
pub fn long_name(column: &Column) -> String {
    if column.group.is_empty() { column.name.clone() } else { format!("{}: {}", column.group, column.name) }
}

fn is_called(column: &Column, selector: &str) -> bool {
    matches(selector, &column.name) || matches(selector, &long_name(column))
}

/// Whether a selector names the group of a column; in a table of several things the name of the thing stands before that of the group.
fn in_group(column: &Column, selector: &str) -> bool {
    let of_several = || matches(&format!("@ {selector}"), &column.group);
    !selector.is_empty() && !column.group.is_empty() && (matches(selector, &column.group) || of_several())
}

/// The columns (from 0) a selector chooses, in the table's order.
///
/// # Errors
/// A name that fits no column, a number or range beyond the columns, a range that runs backward.
pub fn choose(table: &Table, selector: &str) -> Result<Vec<usize>, NoSuchColumn> {
    let count = table.columns().len();
    let refused = |help: String| NoSuchColumn { name: selector.to_string(), help: Some(help) };
    // a number too long for the machine is past the last column too
    let number = |text: &str| {
        let digits = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        digits.then(|| text.parse::<usize>().unwrap_or(usize::MAX))
    };
    let range = match (number(selector), selector.split_once(':')) {
        (Some(n), _) => Some((n, n)),
        (None, Some((from, to))) => number(from).zip(number(to)),
        (None, None) => None,
    };
    if let Some((from, to)) = range {
        if from > to {
            return Err(refused(format!("{from} comes after {to}")));
        }
        if from < 1 || to > count {
            return Err(refused(format!("their numbers are 1 to {count}")));
        }
        return Ok((from - 1..to).collect());
    }
    let fits = |test: &dyn Fn(&Column) -> bool| -> Vec<usize> {
        table.columns().iter().enumerate().filter(|(_, c)| test(c)).map(|(i, _)| i).collect()
    };
    let exact = fits(&|c| is_called(c, selector));
    if !exact.is_empty() {
        return Ok(exact);
    }
    let begins = |c: &Column| c.name.get(..selector.len()).is_some_and(|head| head.eq_ignore_ascii_case(selector));
    let prefix = if selector.is_empty() { Vec::new() } else { fits(&begins) };
    if prefix.len() == 1 {
        return Ok(prefix);
    }
    let names: Vec<&str> = table.columns().iter().map(|c| c.name.as_str()).collect();
    let several: Vec<&str> = prefix.iter().filter_map(|i| names.get(*i).copied()).collect();
    let help = if several.is_empty() {
        suggest(selector, names)
    } else {
        Some(format!("it could be {}", several.join(" or ")))
    };
    Err(NoSuchColumn { name: selector.to_string(), help })
}

/// The columns of a report that a selector chooses: as [`choose`], but the name of a group that is no column's chooses all of the
/// group, behind the first column of the table where that stands outside of groups.
///
/// # Errors
/// As [`choose`].
pub fn report_columns(table: &Table, selector: &str) -> Result<Vec<usize>, NoSuchColumn> {
    let of_group = |(index, column): (usize, &Column)| in_group(column, selector).then_some(index);
    let mut group: Vec<usize> = table.columns().iter().enumerate().filter_map(of_group).collect();
    if group.is_empty() || table.columns().iter().any(|c| is_called(c, selector)) {
        return choose(table, selector);
    }
    if table.columns().first().is_some_and(|c| c.group.is_empty()) {
        group.insert(0, 0);
    }
    Ok(group)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use windlass_base::table::{Column, Digits};
    use windlass_base::units::Dim;

    fn heads<'h>(list: impl IntoIterator<Item = (&'h str, &'h str)>) -> Table {
        let column = |(group, name)| Column::new(group, name, Dim::None, Digits::Usual, [0.0]);
        Table::from_columns("t", list.into_iter().map(column).collect())
    }

    fn table(names: &[&str]) -> Table {
        heads(names.iter().map(|name| ("G", *name)))
    }

    #[test]
    fn columns_are_selected_by_number_range_name_wildcard_and_prefix() {
        let table = table(&["X", "Force", "DF/DX", "Ten Top"]);
        assert_eq!(choose(&table, "2"), Ok(vec![1]));
        assert_eq!(choose(&table, "3:4"), Ok(vec![2, 3]));
        assert_eq!(choose(&table, "ten@"), Ok(vec![3]));
        assert_eq!(choose(&table, "fo"), Ok(vec![1]));
        assert!(choose(&table, "Tne Top").unwrap_err().to_string().contains("Ten Top"));
    }

    #[test]
    fn report_group_name_selects_its_columns_unless_a_column_has_it() {
        let groups =
            [("", "Time"), ("A Location", "X"), ("A Location", "Y"), ("B Location", "X"), ("A Velocity", "VX")];
        let table = heads(groups);
        assert_eq!(report_columns(&table, "LOCATION"), Ok(vec![0, 1, 2, 3]));
        // a pattern that fits columns by their long names chooses these alone
        assert_eq!(report_columns(&table, "a@"), Ok(vec![1, 2, 4]));
        assert_eq!(report_columns(&table, "B Location"), Ok(vec![0, 3]));
        assert_eq!(report_columns(&table, "X"), Ok(vec![1, 3]));
        assert!(choose(&table, "LOCATION").is_err() && report_columns(&table, "PLACE").is_err());
        let named = heads([("Force", "FX"), ("Horizontal", "Force")]);
        assert_eq!(report_columns(&named, "Force"), Ok(vec![1]));
    }

    #[test]
    fn column_numbers_out_of_range_and_ambiguous_selectors_are_refused() {
        let table = table(&["Force", "Form"]);
        for beyond in ["0", "3", "0:1", "1:3", "99999999999999999999999", "3:99999999999999999999999"] {
            assert!(choose(&table, beyond).unwrap_err().to_string().contains("their numbers are 1 to 2"), "{beyond}");
        }
        assert!(choose(&table, "2:1").unwrap_err().to_string().contains("2 comes after 1"));
        assert!(choose(&table, "fo").unwrap_err().to_string().contains("it could be Force or Form"));
        assert!(choose(&table, "").is_err());
    }

    proptest! {
        #[test]
        fn any_selector_selects_existing_columns_or_is_refused(selector in "[0-9:@/a-zA-Z \\-\u{e9}\u{df}]{0,12}|\\PC{0,20}") {
            let table = table(&["X", "Force", "\u{df}e", "DF/DX"]);
            if let Ok(chosen) = choose(&table, &selector) {
                prop_assert!(chosen.iter().all(|i| *i < 4));
            }
        }
    }
}
