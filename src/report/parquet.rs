//! Tables as Apache Parquet: a column of doubles, whole numbers or text for each of theirs, not compressed.
//!
//! Columns have the heads of a CSV file; title, source, units and notes stand in the metadata of the file.

use super::embedded::string;
use super::stored::{ColumnValues, SOURCE, StoreError, StoredColumn, stored_columns};
use ::parquet::basic::{LogicalType, Repetition, Type as Physical};
use ::parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use ::parquet::schema::types::Type;
use std::io::Write;
use std::sync::Arc;
use windlass_base::table::Table;
use windlass_base::units::UnitSystem;

/// The bytes of the file.
///
/// # Errors
/// Columns that the format cannot hold, and what the writer refuses.
pub fn bytes(table: &Table, units: UnitSystem) -> Result<Vec<u8>, StoreError> {
    encode_table(table, units).map_err(|e| match e {
        Failed::Store(e) => e,
        Failed::Parquet(e) => StoreError::Library(e.to_string()),
    })
}

enum Failed {
    Store(StoreError),
    Parquet(ParquetError),
}

impl From<ParquetError> for Failed {
    fn from(error: ParquetError) -> Self {
        Failed::Parquet(error)
    }
}

fn encode_table(table: &Table, units: UnitSystem) -> Result<Vec<u8>, Failed> {
    let columns = stored_columns(table, units).map_err(Failed::Store)?;
    let notes = table.notes.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
    Ok(encode_columns(&table.title, &notes, columns)?)
}

fn encode_columns(title: &str, notes: &str, columns: Vec<StoredColumn>) -> Result<Vec<u8>, ParquetError> {
    let mut out = Vec::new();
    let mut writer = ColumnWriter::new(&mut out, title, notes, &columns)?;
    writer.write(columns)?;
    writer.close()?;
    Ok(out)
}

/// A file of columns that is written a group of rows after the other: no more than one is held.
pub struct ColumnWriter<W: Write + Send> {
    writer: SerializedFileWriter<W>,
}

impl<W: Write + Send> ColumnWriter<W> {
    /// A file whose columns have the heads, units and types of these.
    ///
    /// # Errors
    /// What the writer refuses.
    pub fn new(out: W, title: &str, notes: &str, columns: &[StoredColumn]) -> Result<Self, ParquetError> {
        let mut fields = Vec::new();
        for column in columns {
            let physical = match column.values {
                ColumnValues::Numbers(_) => Physical::DOUBLE,
                ColumnValues::Wholes(_) => Physical::INT64,
                ColumnValues::Texts(_) => Physical::BYTE_ARRAY,
            };
            let logical = matches!(column.values, ColumnValues::Texts(_)).then_some(LogicalType::String);
            let field = Type::primitive_type_builder(&column.head, physical)
                .with_repetition(Repetition::OPTIONAL)
                .with_logical_type(logical)
                .build()?;
            fields.push(Arc::new(field));
        }
        let schema = Arc::new(Type::group_type_builder("windlass").with_fields(fields).build()?);
        let units: Vec<String> = columns.iter().map(|c| format!("{}:{}", string(&c.head), string(&c.unit))).collect();
        let facts = [
            ("title", title.to_owned()),
            ("source", SOURCE.to_string()),
            ("units", format!("{{{}}}", units.join(","))),
            ("notes", notes.to_owned()),
        ];
        let facts = facts.into_iter().map(|(key, value)| KeyValue::new(key.to_string(), value)).collect();
        let properties = Arc::new(WriterProperties::builder().set_key_value_metadata(Some(facts)).build());
        Ok(ColumnWriter { writer: SerializedFileWriter::new(out, schema, properties)? })
    }

    /// Adds rows: columns of one length, of the types that the file was begun with.
    ///
    /// # Errors
    /// What the writer refuses.
    pub fn write(&mut self, columns: Vec<StoredColumn>) -> Result<(), ParquetError> {
        let mut group = self.writer.next_row_group()?;
        for column in columns {
            match column.values {
                ColumnValues::Numbers(list) => write_column::<DoubleType, W>(&mut group, list)?,
                ColumnValues::Wholes(list) => write_column::<Int64Type, W>(&mut group, list)?,
                ColumnValues::Texts(list) => {
                    let list = list.into_iter().map(|t| t.map(|t| ByteArray::from(t.into_bytes()))).collect();
                    write_column::<ByteArrayType, W>(&mut group, list)?;
                }
            }
        }
        group.close().map(drop)
    }

    /// Ends the file.
    ///
    /// # Errors
    /// What the writer refuses.
    pub fn close(self) -> Result<(), ParquetError> {
        self.writer.close().map(drop)
    }
}

/// Writes the next column: the values that are there, and for each row whether there is one.
fn write_column<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    list: Vec<Option<T::T>>,
) -> Result<(), ParquetError> {
    let there: Vec<i16> = list.iter().map(|v| i16::from(v.is_some())).collect();
    let values: Vec<T::T> = list.into_iter().flatten().collect();
    if let Some(mut column) = group.next_column()? {
        column.typed::<T>().write_batch(&values, Some(&there), None)?;
        column.close()?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::parquet::file::reader::{FileReader, SerializedFileReader};
    use ::parquet::record::Field;
    use windlass_base::table::Digits;
    use windlass_base::units::Dim;

    #[test]
    fn parquet_values_units_and_missing_data_read_back_bit_for_bit() {
        let tops = [1.0 / 3.0, f64::MIN_POSITIVE, -1e300, f64::NAN];
        let rows: Vec<(i64, f64)> = (1..).zip(tops).collect();
        let t = Table::new("A, of B")
            .with_rows(&rows)
            .column("", "X", Dim::Length, Digits::Usual, |(n, _)| (*n != 2).then_some(*n as f64))
            .column("Tension", "Top", Dim::Force, Digits::Usual, |(_, top)| *top)
            .column("", "Segment", Dim::None, Digits::Usual, |(n, _)| i64::MAX - n)
            .text("State", |(n, _)| (*n != 3).then_some("d\u{e9}pos\u{e9}"))
            .build();
        let file = bytes(&t, UnitSystem::SI).unwrap();
        let mut kept = tempfile::tempfile().unwrap();
        kept.write_all(&file).unwrap();
        let reader = SerializedFileReader::new(kept).unwrap();
        let facts = reader.metadata().file_metadata().key_value_metadata().unwrap().clone();
        let fact = |key: &str| facts.iter().find(|f| f.key == key).unwrap().value.clone().unwrap();
        assert_eq!((fact("title").as_str(), fact("source").as_str()), ("A, of B", SOURCE));
        let units: serde_json::Value = serde_json::from_str(&fact("units")).unwrap();
        assert_eq!(units["Top (N)"], "N");
        let rows: Vec<Vec<(String, Field)>> = reader
            .get_row_iter(None)
            .unwrap()
            .map(|r| r.unwrap().get_column_iter().map(|(n, f)| (n.clone(), f.clone())).collect())
            .collect();
        assert_eq!(rows.len(), 4);
        let names: Vec<&str> = rows[0].iter().map(|(n, _)| n.as_str()).collect();
        assert_eq!(names, ["X (m)", "Top (N)", "Segment", "State"]);
        for (n, (row, top)) in rows.iter().zip(tops).enumerate() {
            assert!(matches!(row[1].1, Field::Double(v) if v.to_bits() == top.to_bits()), "{row:?}");
            assert_eq!(row[2].1, Field::Long(i64::MAX - n as i64 - 1));
        }
        assert_eq!((&rows[1][0].1, &rows[2][3].1), (&Field::Null, &Field::Null));
        assert_eq!(rows[0][3].1, Field::Str("d\u{e9}pos\u{e9}".into()));
    }

    #[test]
    fn table_without_rows_is_refused() {
        let t = Table::new("t").with_rows(&[] as &[f64]).column("", "X", Dim::None, Digits::Usual, |x| *x).build();
        assert_eq!(bytes(&t, UnitSystem::SI), Err(StoreError::Empty));
    }
}
