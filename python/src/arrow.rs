//! A table as an Arrow stream of one batch: what pandas, polars and pyarrow take from `__arrow_c_stream__`.

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, RecordBatchIterator, StringArray};
use arrow_schema::{ArrowError, DataType, Field, Schema};
use std::collections::HashMap;
use std::sync::Arc;
use windlass::report::stored::{ColumnValues, StoredColumn};

/// The stream of a table's columns. The unit of a column is the item `unit` of its field's metadata, the title that of the schema.
///
/// # Errors
/// What arrow says of columns of different lengths, which a table has not.
pub fn stream(title: &str, names: &[String], columns: &[StoredColumn]) -> Result<FFI_ArrowArrayStream, ArrowError> {
    let field = |(column, name): (&StoredColumn, &String)| {
        let kind = match &column.values {
            ColumnValues::Numbers(_) => DataType::Float64,
            ColumnValues::Wholes(_) => DataType::Int64,
            ColumnValues::Texts(_) => DataType::Utf8,
        };
        let unit = HashMap::from([("unit".to_string(), column.unit.clone())]);
        Field::new(name, kind, true).with_metadata(unit)
    };
    let fields: Vec<Field> = columns.iter().zip(names).map(field).collect();
    let title = HashMap::from([("title".to_string(), title.to_string())]);
    let schema = Arc::new(Schema::new(fields).with_metadata(title));
    let array = |column: &StoredColumn| -> ArrayRef {
        match &column.values {
            ColumnValues::Numbers(list) => Arc::new(Float64Array::from(list.clone())),
            ColumnValues::Wholes(list) => Arc::new(Int64Array::from(list.clone())),
            ColumnValues::Texts(list) => Arc::new(StringArray::from(list.clone())),
        }
    };
    let batches = match columns {
        [] => Vec::new(),
        some => vec![Ok(RecordBatch::try_new(Arc::clone(&schema), some.iter().map(array).collect())?)],
    };
    Ok(FFI_ArrowArrayStream::new(Box::new(RecordBatchIterator::new(batches, schema))))
}
