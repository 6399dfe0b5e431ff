//! The text of files and streams of records.

use crate::report::files::open_regular;
use std::io::Read;
use std::path::Path;
use windlass_language::source::{LARGEST_FILE, Text};

/// Why a file or a stream of records cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum RecordReadError {
    /// The system refused.
    #[error("{name}: {error}")]
    Unreadable {
        /// What was read.
        name: String,
        /// Why.
        error: std::io::Error,
    },
    /// Longer than [`LARGEST_FILE`].
    #[error("{name} has more than {LARGEST_FILE} bytes")]
    TooLong {
        /// What was read.
        name: String,
    },
}

/// The text of a file of records.
///
/// # Errors
/// A file that is not there or too large.
pub fn read_text(path: &Path) -> Result<Text, RecordReadError> {
    let name = path.display().to_string();
    match open_regular(path) {
        Ok(file) => read_all(file, &name),
        Err(error) => Err(RecordReadError::Unreadable { name, error }),
    }
}

/// The text of a stream of records.
///
/// # Errors
/// A stream that breaks or is too long.
pub fn read_all(from: impl Read, name: &str) -> Result<Text, RecordReadError> {
    let mut bytes = Vec::new();
    let unreadable = |error| RecordReadError::Unreadable { name: name.to_string(), error };
    from.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(RecordReadError::TooLong { name: name.to_string() });
    }
    Ok(Text::from_bytes(bytes))
}
