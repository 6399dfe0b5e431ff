//! Tables as CSV: a header of the column names with units, then numbers with full precision. Text that a spreadsheet would take for a
//! formula gets an apostrophe in front.

use super::columns::long_name;
use super::format;
use std::borrow::Cow;
use windlass_base::table::{Cell, Column, Table};
use windlass_base::units::{Dim, UnitSystem};

/// The bytes of the file.
///
/// # Errors
/// What the CSV writer reports; writing to memory does not fail otherwise.
pub fn bytes(table: &Table, units: UnitSystem) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(heads(table, units).iter().map(|head| guard_formula(head).into_owned()))?;
    for row in 0..table.rows() {
        writer.write_record(
            table
                .columns()
                .iter()
                .map(|c| c.cells.get(row).map_or(String::new(), |cell| format_cell(cell, c.dim, units))),
        )?;
    }
    writer.into_inner().map_err(|e| csv::Error::from(std::io::Error::other(e.to_string())))
}

fn format_cell(cell: &Cell, dim: Dim, units: UnitSystem) -> String {
    let text = format::full(cell, dim, units);
    if matches!(cell, Cell::Text(_)) { guard_formula(&text).into_owned() } else { text }
}

/// Text of a cell so that no spreadsheet takes it for a formula: an apostrophe goes before `=`, `+`, `-`, `@`, a tab or a carriage
/// return, unless the text is a number.
pub fn guard_formula(text: &str) -> Cow<'_, str> {
    let formula = text.starts_with(['=', '+', '@', '\t', '\r']) || (text.starts_with('-') && text.len() > 1);
    if formula && text.trim().parse::<f64>().is_err() { Cow::Owned(format!("'{text}")) } else { Cow::Borrowed(text) }
}

/// Text of a cell as it was before it was [`guard_formula`].
pub fn remove_guard(text: &str) -> &str {
    text.strip_prefix('\'').filter(|bare| guard_formula(bare) != *bare).unwrap_or(text)
}

/// The heads, no two alike: a name that several columns have goes with its group, and if that does not tell them
/// apart, with its number.
pub(super) fn heads(table: &Table, units: UnitSystem) -> Vec<String> {
    let twice = |of: &dyn Fn(&Column) -> String, column: &Column| {
        table.columns().iter().filter(|c| of(c) == of(column)).count() > 1
    };
    let short = |c: &Column| format::head(c, units);
    let long = |c: &Column| format::name_with_unit(&long_name(c), c.dim, units);
    let heads =
        table.columns().iter().enumerate().map(|(index, column)| match (twice(&short, column), twice(&long, column)) {
            (false, _) => short(column),
            (true, false) => long(column),
            (true, true) => format!("{} #{}", long(column), index + 1),
        });
    heads.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use windlass_base::table::{Column, Digits};

    #[test]
    fn csv_headers_have_units_and_numbers_read_back_exactly() {
        let table = Table::new("t")
            .with_rows(&[(Some(1.0 / 3.0), "a,b"), (None, "c")])
            .column("", "X", Dim::Length, Digits::Usual, |(x, _)| *x)
            .text("State, now", |(_, state)| *state)
            .build();
        let text = String::from_utf8(bytes(&table, UnitSystem::SI).unwrap()).unwrap();
        assert_eq!(text, "X (m),\"State, now\"\n0.3333333333333333,\"a,b\"\n,c\n");
    }

    #[test]
    fn text_of_formula_is_escaped_and_numbers_are_not() {
        let texts = ["=cmd|' /C calc'!A0", "+1+1", "@SUM(A1)", "-2+3", "-", "-5", "+5", "-1e3", "x=1", "\t=1", "\r=1"];
        let table = Table::new("t")
            .with_rows(&texts)
            .text("=HYPERLINK(1)", |text| *text)
            .column("", "X", Dim::None, Digits::Usual, |_| -1.5)
            .build();
        let text = bytes(&table, UnitSystem::SI).unwrap();
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_slice());
        let first: Vec<String> = reader.records().map(|r| r.unwrap()[0].to_string()).collect();
        let want = [
            "'=HYPERLINK(1)",
            "'=cmd|' /C calc'!A0",
            "'+1+1",
            "'@SUM(A1)",
            "'-2+3",
            "-",
            "-5",
            "+5",
            "-1e3",
            "x=1",
            "'\t=1",
            "'\r=1",
        ];
        assert_eq!(first, want);
        assert!(String::from_utf8(text).unwrap().lines().nth(1).unwrap().ends_with(",-1.5"));
        assert!(want.iter().skip(1).zip(texts).all(|(written, text)| remove_guard(written) == text));
        assert_eq!(remove_guard("'quoted'"), "'quoted'");
    }

    #[test]
    fn column_headers_are_unique() {
        let names = [("A", "F"), ("B", "F"), ("", "X"), ("", "X")];
        let column = |(group, name): &(&str, &str)| Column::new(group, name, Dim::Force, Digits::Usual, [0.0]);
        let t = Table::from_columns("t", names.iter().map(column).collect());
        assert_eq!(heads(&t, UnitSystem::SI), ["A: F (N)", "B: F (N)", "X (N) #3", "X (N) #4"]);
    }

    proptest! {
        #[test]
        fn csv_file_reads_back_bit_for_bit(rows in prop::collection::vec((any::<f64>(), any::<i64>(), "\\PC{0,8}|[,\"\n\r]{0,4}"), 0..20)) {
            let t = Table::new("t")
                .with_rows(&rows)
                .column("", "X", Dim::None, Digits::Usual, |(x, ..)| *x)
                .column("", "N", Dim::None, Digits::Usual, |(_, n, _)| *n)
                .text("T", |(.., text)| text)
                .build();
            let file = bytes(&t, UnitSystem::SI).unwrap();
            let mut reader = csv::Reader::from_reader(file.as_slice());
            let read: Vec<csv::StringRecord> = reader.records().collect::<Result<_, _>>().unwrap();
            prop_assert_eq!(read.len(), rows.len());
            for (record, (x, n, text)) in read.iter().zip(&rows) {
                let number: f64 = record[0].parse().unwrap();
                // one zero: the sign of nothing is not written
                let same = number.to_bits() == x.to_bits() || (x.is_nan() && number.is_nan()) || (*x == 0.0 && number == 0.0);
                prop_assert!(same, "{x:e} came back as {number:e}");
                prop_assert_eq!(record[1].parse::<i64>().unwrap(), *n);
                prop_assert!(!record[2].starts_with(['=', '+', '@']) || record[2].trim().parse::<f64>().is_ok());
                let apostrophe = format!("'{text}");
                prop_assert!(&record[2] == text || record[2] == *apostrophe);
            }
        }
    }
}
