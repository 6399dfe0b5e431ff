//! Tables as CSV: a header of the column names with units, then numbers with full precision.

use super::columns::long_name;
use super::format;
use windlass_base::table::{Column, Table};
use windlass_base::units::UnitSystem;

/// The bytes of the file.
///
/// # Errors
/// What the CSV writer reports; writing to memory does not fail otherwise.
pub fn bytes(table: &Table, units: UnitSystem) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(heads(table, units))?;
    for row in 0..table.rows() {
        writer.write_record(
            table
                .columns
                .iter()
                .map(|c| c.cells.get(row).map_or(String::new(), |cell| format::full(cell, c.dim, units))),
        )?;
    }
    writer.into_inner().map_err(|e| csv::Error::from(std::io::Error::other(e.to_string())))
}

/// The heads, no two alike: a name that several columns have goes with its group, and if that does not tell them
/// apart, with its number.
pub(super) fn heads(table: &Table, units: UnitSystem) -> Vec<String> {
    let twice = |of: &dyn Fn(&Column) -> String, column: &Column| {
        table.columns.iter().filter(|c| of(c) == of(column)).count() > 1
    };
    let short = |c: &Column| format::head(c, units);
    let long = |c: &Column| format::named(&long_name(c), c.dim, units);
    let heads =
        table.columns.iter().enumerate().map(|(index, column)| match (twice(&short, column), twice(&long, column)) {
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
    use windlass_base::table::{Cell, Digits};
    use windlass_base::units::Dim;

    #[test]
    fn heads_have_units_and_numbers_read_back_exactly() {
        let mut table = Table::new("t").column("", "X", Dim::Length, Digits::Usual).column(
            "",
            "State, now",
            Dim::None,
            Digits::Usual,
        );
        table.push(vec![Cell::Number(1.0 / 3.0), "a,b".into()]).unwrap();
        table.push(vec![Cell::Missing, "c".into()]).unwrap();
        let text = String::from_utf8(bytes(&table, UnitSystem::SI).unwrap()).unwrap();
        assert_eq!(text, "X (m),\"State, now\"\n0.3333333333333333,\"a,b\"\n,c\n");
    }

    #[test]
    fn no_two_heads_are_alike() {
        let names = [("A", "F"), ("B", "F"), ("", "X"), ("", "X")];
        let t = names.iter().fold(Table::new("t"), |t, (g, n)| t.column(g, n, Dim::Force, Digits::Usual));
        assert_eq!(heads(&t, UnitSystem::SI), ["A: F (N)", "B: F (N)", "X (N) #3", "X (N) #4"]);
    }

    proptest! {
        #[test]
        fn a_file_reads_back_to_the_last_bit(rows in prop::collection::vec((any::<f64>(), any::<i64>(), "\\PC{0,8}|[,\"\n\r]{0,4}"), 0..20)) {
            let mut t = Table::new("t")
                .column("", "X", Dim::None, Digits::Usual)
                .column("", "N", Dim::None, Digits::Usual)
                .column("", "T", Dim::None, Digits::Usual);
            for (x, n, text) in &rows {
                t.push(vec![Cell::Number(*x), Cell::Integer(*n), Cell::Text(text.clone())]).unwrap();
            }
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
                prop_assert_eq!(&record[2], text);
            }
        }
    }
}
