//! Tables as Excel workbooks: the columns on a sheet `Table` with the heads of a CSV file, title, facts and notes on a sheet `Notes`.
//! Numbers have full precision, text is never a formula, and the same table makes the same bytes.

use super::csv::heads;
use super::format;
use super::stored::SOURCE;
use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, Workbook, Worksheet, XlsxError};
use windlass_base::table::{Cell, Table};
use windlass_base::units::{Dim, UnitSystem};

/// The bytes of the file.
///
/// # Errors
/// More rows or columns than a sheet has (1,048,576 by 16,384), text of more than 32,767 characters.
pub fn bytes(table: &Table, units: UnitSystem) -> Result<Vec<u8>, XlsxError> {
    let mut book = Workbook::new();
    // no date of the machine: a file depends on its table alone
    let created = ExcelDateTime::from_ymd(2000, 1, 1)?;
    book.set_properties(
        &DocProperties::new().set_title(&table.title).set_author(SOURCE).set_creation_datetime(&created),
    );
    let bold = Format::new().set_bold();
    let sheet = book.add_worksheet().set_name("Table")?;
    for (column, head) in (0u16..).zip(heads(table, units)) {
        sheet.write_string_with_format(0, column, &head, &bold)?;
        // a column is as wide as its head
        sheet.set_column_width(column, (head.chars().count() as f64 + 2.0).clamp(10.0, 40.0))?;
    }
    sheet.set_freeze_panes(1, 0)?;
    for row in 0..table.rows() {
        let number = u32::try_from(row + 1).map_err(|_| XlsxError::RowColumnLimitError)?;
        for (column, of) in (0u16..).zip(table.columns()) {
            if let Some(cell) = of.cells.get(row) {
                write_cell(sheet, (number, column), cell, (of.dim, units))?;
            }
        }
    }
    let notes = book.add_worksheet().set_name("Notes")?;
    notes.set_column_width(0, 30.0)?.set_column_width(1, 30.0)?;
    notes.write_string_with_format(0, 0, &table.title, &bold)?;
    let mut row = 1;
    for fact in &table.facts {
        notes.write_string(row, 0, format::name_with_unit(&fact.name, fact.dim, units))?;
        write_cell(notes, (row, 1), &fact.value, (fact.dim, units))?;
        row += 1;
    }
    for note in &table.notes {
        notes.write_string(row, 0, note.to_string())?;
        row += 1;
    }
    book.save_to_buffer()
}

fn write_cell(
    sheet: &mut Worksheet,
    (row, column): (u32, u16),
    cell: &Cell,
    (dim, units): (Dim, UnitSystem),
) -> Result<(), XlsxError> {
    match cell {
        Cell::Number(value) => {
            let value = dim.from_si(*value, units);
            // a workbook has no number that is not finite
            if value.is_finite() {
                sheet.write_number(row, column, value)?;
            }
        }
        Cell::Integer(value) => {
            sheet.write_number(row, column, *value as f64)?;
        }
        Cell::Text(text) => {
            sheet.write_string(row, column, text)?;
        }
        Cell::Missing => {}
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use windlass_base::table::Digits;

    #[test]
    fn workbook_holds_numbers_and_text_that_is_no_formula() {
        let rows = [(1.5, "=1+1"), (0.1 + 0.2, "L2"), (f64::NAN, "L3")];
        let table = Table::new("Lines")
            .with_rows(&rows)
            .column("", "Length", Dim::Length, Digits::Usual, |row| row.0)
            .column("", "Name", Dim::None, Digits::Usual, |row| row.1)
            .build();
        let made = bytes(&table, UnitSystem::SI).unwrap();
        // a zip archive, with the same bytes every time
        assert!(made.starts_with(b"PK\x03\x04"));
        assert_eq!(made, bytes(&table, UnitSystem::SI).unwrap());
    }
}
