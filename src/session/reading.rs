//! The text of files and streams of records.

use crate::report::files::open_regular;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;
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

/// Texts that an editor holds and has not saved yet, by the whole path of their files.
#[derive(Clone, Debug, Default)]
pub struct UnsavedTexts(Arc<BTreeMap<PathBuf, Text>>);

impl UnsavedTexts {
    /// These texts; the paths are whole and without links.
    pub fn new(texts: BTreeMap<PathBuf, Text>) -> Self {
        UnsavedTexts(Arc::new(texts))
    }

    /// The text of a file of records: what is not saved yet, else what the file holds.
    ///
    /// # Errors
    /// As [`read_text`].
    pub fn read(&self, path: &Path) -> Result<Text, RecordReadError> {
        let is_held = || self.0.get(path).or_else(|| self.0.get(&path.canonicalize().ok()?)).cloned();
        let held = if self.0.is_empty() { None } else { is_held() };
        held.map_or_else(|| read_text(path), Ok)
    }
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
