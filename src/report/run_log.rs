//! The file of a run: rows and snapshots as they come, so that a run that was killed goes on from its last snapshot.
//!
//! 8 bytes of mark, the fingerprint of the run, the width of its rows; then blocks: a byte that says what it is (`B` a state that the
//! bodies took from an earlier run, `R` a row, `S` a snapshot), the number of bytes, the bytes, and their checksum (FNV-1a, 64 bits). Numbers are little-endian. What stands
//! behind the last whole block was being written when the program ended, and does not count.

use super::files::is_unlinked;
use super::taken_state::TakenState;
use std::fs::File;
use std::io::{BufWriter, Read, Seek, SeekFrom, Write};
use std::path::PathBuf;
use windlass_solve::time::{RunFileError, Snapshot, Watcher};

/// Begins every such file; its last byte is the version.
pub const MARK: [u8; 8] = *b"WINDRUN\x04";
/// Bytes of the head.
const HEADER_BYTES: usize = 24;

/// A file of a run being written.
#[derive(Debug)]
pub struct RunLog {
    file: BufWriter<File>,
    path: PathBuf,
}

/// What a file of a run holds.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredRun {
    /// The fingerprint of the run.
    pub fingerprint: u64,
    /// States that the records of the run took from earlier runs.
    pub taken_states: Vec<TakenState>,
    /// Numbers of a row.
    pub width: usize,
    /// Rows up to the snapshot, one behind the other.
    pub rows: Vec<f64>,
    /// The last snapshot at or before the time asked for.
    pub snapshot: Snapshot,
    /// Time of the last row of the file (s), which may lie behind the snapshot.
    pub last_time: f64,
    /// Bytes up to behind that snapshot.
    end: u64,
}

/// Why a file of a run cannot be gone on with.
#[derive(Debug, thiserror::Error)]
pub enum RunLogError {
    /// The system refused to read.
    #[error("{0}")]
    Unreadable(#[from] std::io::Error),
    /// The system refused to write.
    #[error("{0}")]
    Unwritable(#[from] RunFileError),
    /// Not such a file.
    #[error("it is no file of a run of this program")]
    Other,
    /// One of another form.
    #[error("another version of windlass wrote it: its form is {0}, this version reads form {own}; the run must be made again", own = MARK[7])]
    Version(u8),
    /// A time or a motion that is no finite number.
    #[error("it is damaged: it holds a time or a motion that is not finite")]
    NotFinite,
    /// A file without a whole snapshot up to the time.
    #[error("it holds no snapshot at or before that time")]
    NoSnapshot,
}

fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |sum, b| (sum ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3))
}

impl RunLog {
    /// Begins a file, with the states that the records of the run took from earlier runs.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn begin<'a>(
        (file, path): (File, PathBuf),
        (fingerprint, width): (u64, usize),
        taken: impl IntoIterator<Item = &'a TakenState>,
    ) -> Result<Self, RunLogError> {
        let mut log = RunLog { file: BufWriter::new(file), path };
        let mut head = MARK.to_vec();
        head.extend_from_slice(&fingerprint.to_le_bytes());
        head.extend_from_slice(&(width as u64).to_le_bytes());
        log.file.write_all(&head).map_err(|error| log.unwritable(error))?;
        for state in taken {
            log.block(b'B', &state.bytes()).map_err(|error| log.unwritable(error))?;
        }
        Ok(log)
    }

    /// Goes on in a file behind the snapshot that was read of it.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn resume(mut file: File, path: PathBuf, kept: &StoredRun) -> Result<Self, RunLogError> {
        let done = file.set_len(kept.end).and_then(|()| file.seek(SeekFrom::End(0)));
        let log = RunLog { file: BufWriter::new(file), path };
        done.map_err(|error| log.unwritable(error))?;
        Ok(log)
    }

    fn unwritable(&self, error: std::io::Error) -> RunFileError {
        RunFileError::Unwritable { path: self.path.clone(), error }
    }

    /// Sees that nobody has deleted the file: what is written to it would be lost.
    fn check_file_exists(&self) -> Result<(), RunFileError> {
        let deleted = || RunFileError::Deleted { path: self.path.clone() };
        if is_unlinked(self.file.get_ref()) { Err(deleted()) } else { Ok(()) }
    }

    fn block(&mut self, kind: u8, bytes: &[u8]) -> std::io::Result<()> {
        self.file.write_all(&[kind])?;
        self.file.write_all(&(bytes.len() as u64).to_le_bytes())?;
        self.file.write_all(bytes)?;
        self.file.write_all(&checksum(bytes).to_le_bytes())
    }
}

impl Watcher for RunLog {
    fn row(&mut self, row: &[f64]) -> Result<(), RunFileError> {
        let bytes: Vec<u8> = row.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.block(b'R', &bytes).map_err(|error| self.unwritable(error))
    }

    fn snapshot(&mut self, snapshot: &Snapshot) -> Result<(), RunFileError> {
        let bytes = snapshot.bytes();
        self.block(b'S', &bytes).and_then(|()| self.file.flush()).map_err(|error| self.unwritable(error))?;
        self.check_file_exists()
    }

    fn finish(&mut self) -> Result<(), RunFileError> {
        self.file.flush().map_err(|error| self.unwritable(error))?;
        self.check_file_exists()
    }
}

/// Reads a file of a run up to the last snapshot at or before a time (s).
///
/// # Errors
/// A file that is none, or holds no such snapshot.
pub fn read(file: &mut (impl Read + Seek), time: f64) -> Result<StoredRun, RunLogError> {
    let mut bytes = Vec::new();
    file.seek(SeekFrom::Start(0)).and_then(|_| file.read_to_end(&mut bytes))?;
    let word = |at: usize| {
        let found = bytes.get(at..).and_then(|b| b.first_chunk::<8>());
        found.map(|b| u64::from_le_bytes(*b)).ok_or(RunLogError::Other)
    };
    if bytes.get(..8) != Some(&MARK) {
        let version = bytes.get(7).filter(|_| bytes.get(..7) == MARK.get(..7));
        return Err(version.map_or(RunLogError::Other, |version| RunLogError::Version(*version)));
    }
    let (fingerprint, width) = (word(8)?, usize::try_from(word(16)?).map_err(|_| RunLogError::Other)?);
    let (mut at, mut found, mut rows, mut taken_states) = (HEADER_BYTES, None, Vec::new(), Vec::new());
    while let Some((kind, block, next)) = block(&bytes, at) {
        match kind {
            b'B' => taken_states.push(TakenState::read(block).ok_or(RunLogError::Other)?),
            b'R' if block.len() == width.saturating_mul(8) => {
                if !block.first_chunk::<8>().is_some_and(|b| f64::from_le_bytes(*b).is_finite()) {
                    return Err(RunLogError::NotFinite);
                }
                rows.extend(block.chunks_exact(8).filter_map(|b| b.first_chunk::<8>()).map(|b| f64::from_le_bytes(*b)));
            }
            b'S' => {
                let snapshot = Snapshot::read(block).ok_or(RunLogError::Other)?;
                if !is_finite(&snapshot) {
                    return Err(RunLogError::NotFinite);
                }
                if snapshot.time > time * (1.0 + 1e-12) {
                    break;
                }
                found = Some((snapshot, rows.len(), next as u64));
            }
            _ => return Err(RunLogError::Other),
        }
        at = next;
    }
    let (snapshot, length, end) = found.ok_or(RunLogError::NoSnapshot)?;
    let last = rows.len().checked_sub(width).and_then(|at| rows.get(at)).copied();
    let last_time = last.map_or(snapshot.time, |time| time.max(snapshot.time));
    rows.truncate(length);
    Ok(StoredRun { fingerprint, taken_states, width, rows, snapshot, last_time, end })
}

/// Whether a run can go on from here: its time and what moves.
fn is_finite(snapshot: &Snapshot) -> bool {
    let moves = snapshot.motions.iter().flat_map(|m| {
        let pose = m.pose.origin.iter().chain(m.pose.axes.iter());
        pose.chain(m.velocity.iter()).chain(m.acceleration.iter()).chain(m.auxiliary.iter()).chain(m.jerk.iter())
    });
    std::iter::once(&snapshot.time).chain(moves).all(|v| v.is_finite())
}

/// A whole block: what it is, its bytes, where the next one begins.
fn block(bytes: &[u8], at: usize) -> Option<(u8, &[u8], usize)> {
    let kind = *bytes.get(at)?;
    let length = usize::try_from(u64::from_le_bytes(*bytes.get(at + 1..)?.first_chunk::<8>()?)).ok()?;
    let end = (at + 9).checked_add(length)?;
    let block = bytes.get(at + 9..end)?;
    let sum = u64::from_le_bytes(*bytes.get(end..)?.first_chunk::<8>()?);
    (sum == checksum(block)).then_some((kind, block, end + 8))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn start_log(folder: &std::path::Path) -> (RunLog, PathBuf) {
        let path = folder.join("TDOM.run");
        let file = File::options().read(true).write(true).create_new(true).open(&path).unwrap();
        (RunLog::begin((file, path.clone()), (1, 2), []).unwrap(), path)
    }

    fn snapshot_at(time: f64) -> Snapshot {
        Snapshot { time, ..Snapshot::default() }
    }

    fn read_file(path: &std::path::Path) -> Result<StoredRun, RunLogError> {
        read(&mut File::open(path).unwrap(), f64::INFINITY)
    }

    #[test]
    fn run_file_with_time_not_a_number_is_refused() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let folder = tempfile::tempdir().unwrap();
            let (mut log, path) = start_log(folder.path());
            log.row(&[0.0, f64::NAN]).unwrap();
            log.snapshot(&snapshot_at(1.5)).unwrap();
            assert_eq!(read_file(&path).map(|k| (k.snapshot.time, k.rows.len())).unwrap(), (1.5, 2));
            log.snapshot(&snapshot_at(bad)).unwrap();
            assert!(matches!(read_file(&path), Err(RunLogError::NotFinite)), "snapshot at {bad}");
            let folder = tempfile::tempdir().unwrap();
            let (mut log, path) = start_log(folder.path());
            log.row(&[bad, 0.0]).unwrap();
            log.snapshot(&snapshot_at(1.0)).unwrap();
            assert!(matches!(read_file(&path), Err(RunLogError::NotFinite)), "row at {bad}");
        }
    }

    #[test]
    fn run_file_of_another_form_is_named_as_such() {
        let folder = tempfile::tempdir().unwrap();
        let (mut log, path) = start_log(folder.path());
        log.snapshot(&snapshot_at(1.0)).unwrap();
        let mut bytes = std::fs::read(&path).unwrap();
        bytes[7] = 9;
        let said = read(&mut std::io::Cursor::new(bytes), 1.0).unwrap_err().to_string();
        assert!(said.contains("its form is 9, this version reads form 4"), "{said}");
    }

    #[cfg(unix)]
    #[test]
    fn run_file_deleted_during_run_ends_run() {
        let folder = tempfile::tempdir().unwrap();
        let (mut log, path) = start_log(folder.path());
        log.snapshot(&snapshot_at(1.0)).unwrap();
        std::fs::remove_file(&path).unwrap();
        for done in [log.snapshot(&snapshot_at(2.0)), log.finish()] {
            let error = done.unwrap_err();
            assert!(
                matches!(error, RunFileError::Deleted { .. }) && error.to_string().contains("TDOM.run was deleted")
            );
        }
    }
}
