//! The folder of a study: what it is of, and the append-only files of its finished cases.

use crate::record::{CaseStatus, RecordsEnd, decode_each};
use crate::records::{Records, SmallRecord};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};

/// The file that says what a study is of.
pub const INFO: &str = "study.json";
/// The folder of the cases whose answers are kept.
pub const KEPT_CASES: &str = "cases";

/// Why a study cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The system refuses.
    #[error("{}: {source}", .path.display())]
    System {
        /// The file or folder.
        path: PathBuf,
        /// What it says.
        source: io::Error,
    },
    /// A folder of something else.
    #[error("{}: {message}", .path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What is wrong with it.
        message: String,
    },
}

impl StudyError {
    /// An error of a file.
    pub fn of(path: &Path) -> impl FnOnce(io::Error) -> Self + '_ {
        move |source| StudyError::System { path: path.to_path_buf(), source }
    }
}

/// How the names of files begin that were not whole when a study was killed.
pub(crate) const UNFINISHED: &str = ".unfinished-";

/// What puts the bytes of a file into it.
pub type Fill<'a> = dyn FnMut(&mut (dyn Write + Send)) -> io::Result<()> + 'a;

/// What a study does to files; another one stands in its place where a test stops it half way.
pub trait Files: Sync {
    /// Makes a folder and those above it.
    ///
    /// # Errors
    /// What the system refuses.
    fn make_folder(&self, path: &Path) -> io::Result<()>;
    /// Adds bytes behind a file, which it makes where there is none.
    ///
    /// # Errors
    /// What the system refuses.
    fn append(&self, path: &Path, bytes: &[u8]) -> io::Result<()>;
    /// Sees a file through to the disk.
    ///
    /// # Errors
    /// What the system refuses.
    fn sync(&self, path: &Path) -> io::Result<()>;
    /// Cuts a file off behind so many bytes.
    ///
    /// # Errors
    /// What the system refuses.
    fn truncate(&self, path: &Path, length: u64) -> io::Result<()>;
    /// Writes a file whole or not at all, by what `fill` puts into it.
    ///
    /// # Errors
    /// What the system refuses, and what `fill` does.
    fn write_by(&self, path: &Path, fill: &mut Fill) -> io::Result<()>;
    /// Writes the bytes of a file whole or not at all.
    ///
    /// # Errors
    /// What the system refuses.
    fn write(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        self.write_by(path, &mut |to| to.write_all(bytes))
    }
    /// Removes a file, where there is one.
    ///
    /// # Errors
    /// What the system refuses.
    fn remove(&self, path: &Path) -> io::Result<()>;
    /// Puts a folder in the place of another, which is removed; from another file system by a copy, whole or not at all.
    ///
    /// # Errors
    /// What the system refuses.
    fn move_folder(&self, from: &Path, to: &Path) -> io::Result<()>;
    /// Removes a folder, where there is one.
    ///
    /// # Errors
    /// What the system refuses.
    fn remove_folder(&self, path: &Path) -> io::Result<()>;
}

/// The files of the system.
pub struct SystemFiles;

impl Files for SystemFiles {
    fn make_folder(&self, path: &Path) -> io::Result<()> {
        fs::create_dir_all(path)
    }

    fn append(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        OpenOptions::new().create(true).append(true).open(path)?.write_all(bytes)
    }

    fn sync(&self, path: &Path) -> io::Result<()> {
        File::open(path)?.sync_data()
    }

    fn truncate(&self, path: &Path, length: u64) -> io::Result<()> {
        OpenOptions::new().write(true).open(path)?.set_len(length)
    }

    fn write_by(&self, path: &Path, fill: &mut Fill) -> io::Result<()> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(UNFINISHED);
        // as readable as any file that a program makes: the mask of the user applies
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let fresh = builder.tempfile_in(path.parent().unwrap_or(Path::new(".")))?;
        let mut to = BufWriter::new(fresh);
        fill(&mut to)?;
        let fresh = to.into_inner().map_err(io::IntoInnerError::into_error)?;
        fresh.as_file().sync_data()?;
        fresh.persist(path).map(drop).map_err(|error| error.error)
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        match fs::remove_file(path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        }
    }

    fn move_folder(&self, from: &Path, to: &Path) -> io::Result<()> {
        self.remove_folder(to)?;
        match fs::rename(from, to) {
            Err(error) if error.kind() == io::ErrorKind::CrossesDevices => {
                let name = to.file_name().unwrap_or_default().to_string_lossy();
                let beside = to.with_file_name(format!(".{name}.new"));
                self.remove_folder(&beside)?;
                copy_folder(from, &beside)?;
                fs::rename(&beside, to)?;
                self.remove_folder(from)
            }
            moved => moved,
        }
    }

    fn remove_folder(&self, path: &Path) -> io::Result<()> {
        match fs::remove_dir_all(path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        }
    }
}

/// Copies the files and folders of a folder to a new one.
fn copy_folder(from: &Path, to: &Path) -> io::Result<()> {
    fs::create_dir(to)?;
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        let (kind, to) = (entry.file_type()?, to.join(entry.file_name()));
        if kind.is_dir() {
            copy_folder(&entry.path(), &to)?;
        } else if kind.is_file() {
            fs::copy(entry.path(), to)?;
        }
    }
    Ok(())
}

/// Scatter of the most probable maximum that seeds are counted for, where nothing else is said (per cent).
pub const SCATTER_PERCENT: f64 = 5.0;

fn scatter_percent() -> f64 {
    SCATTER_PERCENT
}

/// What a study is of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyInfo {
    /// The script, from where the study was begun.
    pub model: String,
    /// The folder that the study was begun in; empty where it is not known.
    #[serde(default)]
    pub begun_in: String,
    /// The table, named like the script.
    pub table: String,
    /// The seed that those of the cases are made from.
    pub seed: u64,
    /// Version of the program.
    pub version: String,
    /// How often the study was begun or gone on with.
    pub start: u64,
    /// Half width of the 95 % interval of the most probable maximum over seeds that a number of seeds is said for, per cent of it.
    #[serde(default = "scatter_percent")]
    pub scatter_percent: f64,
    /// Names of the cases, in the order of the table.
    pub cases: Vec<String>,
}

impl StudyInfo {
    /// The script where it is now: from the present folder, from that which the study was begun in, or from one that the study's own
    /// folder lies in. `None` where it is in none of them.
    pub fn find_script(&self, study: &Path) -> Option<PathBuf> {
        let script = Path::new(&self.model);
        let begun_in = Some(Path::new(&self.begun_in)).filter(|folder| folder.is_absolute());
        let study = std::path::absolute(study).ok();
        let folders = begun_in.into_iter().chain(study.iter().flat_map(|study| study.ancestors()));
        let places = std::iter::once(script.to_path_buf()).chain(folders.map(|folder| folder.join(script)));
        { places }.find(|place| place.is_file())
    }
}

/// The file of finished cases of a worker.
pub fn results_file(folder: &Path, worker: usize) -> PathBuf {
    folder.join(format!("results-{worker}.jsonl"))
}

/// The files of finished cases, by name.
fn results_files(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut files: Vec<PathBuf> = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        if name.starts_with("results-") && name.ends_with(".jsonl") {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// A study as it stands in its folder.
#[derive(Clone, Debug)]
pub struct Study {
    /// What it is of.
    pub info: StudyInfo,
    /// The last record of each finished case, in the order of the table.
    pub records: Records,
}

/// Bytes of a file of records that are read at once.
const READ_AT_ONCE: usize = 1 << 18;

impl Study {
    /// Reads a study. Half a record at the end of a file, as a kill leaves it, is passed over.
    ///
    /// # Errors
    /// A folder without a study, and what the system refuses.
    pub fn open(folder: &Path) -> Result<Self, StudyError> {
        Self::read(folder, false, &mut |_, _| Ok(()))
    }

    /// The same with the cases of earlier tables, which come last; `torn` gets each file that ends in half a record, and the length of
    /// its whole ones.
    pub(crate) fn open_with(
        folder: &Path,
        torn: &mut dyn FnMut(&Path, u64) -> io::Result<()>,
    ) -> Result<Self, StudyError> {
        Self::read(folder, true, torn)
    }

    fn read(
        folder: &Path,
        with_earlier: bool,
        torn: &mut dyn FnMut(&Path, u64) -> io::Result<()>,
    ) -> Result<Self, StudyError> {
        let path = folder.join(INFO);
        let text = fs::read_to_string(&path).map_err(StudyError::of(&path))?;
        let info: StudyInfo = serde_json::from_str(&text).map_err(|error| StudyError::Folder {
            path: path.clone(),
            message: format!("it is of no study: {error}"),
        })?;
        drop(text);
        let named: HashMap<&str, usize> = info.cases.iter().enumerate().map(|(place, case)| (&**case, place)).collect();
        let mut earlier: HashMap<String, usize> = HashMap::new();
        let mut records = Records::default();
        // of each case the start and the record
        let mut latest: Vec<Option<(u64, SmallRecord)>> = vec![None; info.cases.len()];
        for path in results_files(folder).map_err(StudyError::of(folder))? {
            let file = File::open(&path).map_err(StudyError::of(&path))?;
            let mut take = |record: crate::record::CaseRecord| {
                let place = match named.get(record.case.as_str()).or_else(|| earlier.get(&record.case)) {
                    Some(place) => *place,
                    None if !with_earlier => return,
                    None => {
                        earlier.insert(record.case.clone(), latest.len());
                        latest.push(None);
                        latest.len() - 1
                    }
                };
                let start = record.start;
                if let Some(slot) = latest.get_mut(place)
                    && slot.as_ref().is_none_or(|(known, _)| *known <= start)
                {
                    *slot = Some((start, records.compact(record)));
                }
            };
            let end = decode_each(BufReader::with_capacity(READ_AT_ONCE, file), &mut take);
            let RecordsEnd { valid, is_torn } = end.map_err(StudyError::of(&path))?;
            if is_torn {
                torn(&path, valid).map_err(StudyError::of(&path))?;
            }
        }
        drop(named);
        records.set_rows(latest.into_iter().flatten().map(|(_, row)| row));
        Ok(Study { info, records })
    }

    /// How many cases ended so.
    pub fn count(&self, status: CaseStatus) -> usize {
        self.records.iter().filter(|record| record.status() == status).count()
    }
}
