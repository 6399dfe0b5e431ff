//! Tables of cases in Parquet, as pandas, polars and DuckDB write them.

use crate::report::files::open_regular;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use std::path::Path;
use windlass_study::table::{CaseTable, TableError};

/// Reads a table of no more than so many cases; numbers become the shortest text that stands for them.
///
/// # Errors
/// A file that is no Parquet, more cases than `most`, a cell that is neither a number nor a text, and what
/// [`CaseTable::parse`] refuses. Rows are counted from 1.
pub fn read(path: &Path, study_seed: u64, most: usize) -> Result<CaseTable, TableError> {
    let file = path.display().to_string();
    let wrong = |line, column, message: String| TableError { file: file.clone(), line, column, message };
    let opened = open_regular(path).map_err(|error| wrong(None, None, error.to_string()))?;
    let no_parquet = |error: parquet::errors::ParquetError| wrong(None, None, format!("it is no Parquet: {error}"));
    let reader = SerializedFileReader::new(opened).map_err(no_parquet)?;
    let metadata = reader.metadata().file_metadata();
    if usize::try_from(metadata.num_rows()).map_or(true, |rows| rows > most) {
        return Err(wrong(None, None, format!("more than {most} cases: --max-cases allows more")));
    }
    let heads: Vec<String> = metadata.schema().get_fields().iter().map(|field| field.name().to_owned()).collect();
    let mut rows = Vec::new();
    for (row, number) in reader.get_row_iter(None).map_err(no_parquet)?.zip(1_u64..) {
        let row = row.map_err(no_parquet)?;
        let mut cells = Vec::with_capacity(heads.len());
        for (head, field) in row.get_column_iter() {
            let cell = cell(field).ok_or_else(|| {
                let message = "a cell is a number or a text, not a truth, a time or a list".to_owned();
                wrong(Some(number), Some(head.clone()), message)
            })?;
            cells.push(cell);
        }
        rows.push(cells);
    }
    CaseTable::from_rows(&file, heads, rows, study_seed)
}

/// A cell as text, empty where there is none; `None` of what is neither a number nor a text.
fn cell(field: &Field) -> Option<String> {
    Some(match field {
        Field::Null => String::new(),
        Field::Byte(value) => value.to_string(),
        Field::Short(value) => value.to_string(),
        Field::Int(value) => value.to_string(),
        Field::Long(value) => value.to_string(),
        Field::UByte(value) => value.to_string(),
        Field::UShort(value) => value.to_string(),
        Field::UInt(value) => value.to_string(),
        Field::ULong(value) => value.to_string(),
        Field::Float(value) => value.to_string(),
        Field::Double(value) => value.to_string(),
        Field::Str(value) => value.trim().to_owned(),
        _ => return None,
    })
}
