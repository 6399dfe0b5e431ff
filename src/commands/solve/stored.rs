//! Runs kept in a folder of answers: the file of the run, and beside it the records that make its model.

use crate::commands::solve::{tdom, tether_run};
use crate::report::files::open_regular;
use crate::report::run_log::{self, RunLogError, StoredRun};
use std::io::Read;
use std::path::Path;

/// Most bytes of the records of a run.
const MAX_RECORDS: u64 = 1 << 28;

/// Why a folder of answers cannot be opened.
#[derive(Debug, thiserror::Error)]
pub enum StoredError {
    /// No such folder.
    #[error("there is no folder of answers {0}")]
    NoFolder(String),
    /// A folder without a run.
    #[error("{0} holds no run: TDOM keeps one in TDOM.run, unless -STATISTICS")]
    NoRun(String),
    /// A run without its records.
    #[error("{0} cannot be read: {1}; `windlass open` needs it to make the model of the run again")]
    NoRecords(String, std::io::Error),
    /// The file of the run cannot be read.
    #[error("{0}: {1}")]
    Unreadable(String, RunLogError),
}

/// The file of the run in a folder of answers; none where it holds no run.
pub fn file_of_run(folder: &Path) -> Option<&'static str> {
    [tdom::FILE, tether_run::FILE].into_iter().find(|name| folder.join(name).is_file())
}

/// The run that a folder of answers holds, and the records that make its model, its own record last.
///
/// # Errors
/// No folder, no run, no records; a damaged file or one of another version.
pub fn find_stored(folder: &Path) -> Result<(StoredRun, String), StoredError> {
    let shown = |path: &Path| path.display().to_string();
    if !folder.is_dir() {
        return Err(StoredError::NoFolder(shown(folder)));
    }
    let Some(name) = file_of_run(folder) else {
        return Err(StoredError::NoRun(shown(folder)));
    };
    let path = folder.join(name);
    let unreadable = |error| StoredError::Unreadable(shown(&path), error);
    let mut file = open_regular(&path).map_err(|error| unreadable(error.into()))?;
    let kept = run_log::read(&mut file, f64::INFINITY).map_err(unreadable)?;
    let records = folder.join(tdom::records_of(name));
    let mut text = String::new();
    let read = open_regular(&records).and_then(|file| file.take(MAX_RECORDS).read_to_string(&mut text));
    read.map_err(|error| StoredError::NoRecords(shown(&records), error))?;
    Ok((kept, text))
}
