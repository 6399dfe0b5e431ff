//! The text of files and streams of records.

use crate::report::files::open_regular;
use std::io::Read;
use std::path::Path;
use windlass_language::source::{LARGEST_FILE, Text};

/// The text of a file of records.
///
/// # Errors
/// A file that is not there or too large, in one sentence.
pub fn read_text(path: &Path) -> Result<Text, String> {
    let shown = path.display();
    let at = |e| format!("{shown}: {e}");
    read_all(open_regular(path).map_err(at)?, &shown.to_string())
}

/// The text of a stream of records.
///
/// # Errors
/// A stream that breaks or is too long, in one sentence.
pub fn read_all(from: impl Read, name: &str) -> Result<Text, String> {
    let mut bytes = Vec::new();
    from.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(|e| format!("{name}: {e}"))?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(format!("{name} has more than {LARGEST_FILE} bytes"));
    }
    Ok(Text::from_bytes(bytes))
}
