//! Tables as CSV: a header of the column names with units, then numbers with full precision.

use super::format;
use crate::language::units::UnitSystem;
use crate::table::Table;

/// The bytes of the file.
///
/// # Errors
/// What the CSV writer reports; writing to memory does not fail otherwise.
pub fn bytes(table: &Table, units: UnitSystem) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(table.columns.iter().map(|c| format::head(c, units)))?;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::units::Dim;
    use crate::table::{Cell, Digits};

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
}
