//! Files the program writes and touches: where they go, that they are whole, and that nothing is lost.
//!
//! Source: [MOSES-REF lang_user_files]. A relative name, with folders or without, is inside the job's own folder
//! (`ROOT.ans/` or `--out`); a name that begins with `./` or `../` and an absolute one mean what they mean to the shell.
//! In the job's folder an earlier file is kept as `name.1`, `name.2`, ...; outside of it a file is made only with
//! `--allow-files`, or for a record typed at a terminal whose user says yes, and nothing that exists is overwritten.
//! Files are written whole: first under a temporary name beside the place, then renamed.
//!
//! The job's folder is opened once. Everything below it is reached through that one handle, which no link leads out of, whenever
//! it is put there (capabilities as of cap-std). A temporary file is locked while it is written: one that is not locked was left by a
//! job that was killed, and is removed when its folder is next used.

mod error;
mod reading;

pub use error::FileError;
pub use reading::{open_regular, read_regular};

use cap_fs_ext::{DirExt, FollowSymlinks, OpenOptionsFollowExt, OpenOptionsSyncExt};
use cap_std::ambient_authority;
use cap_std::fs::{Dir, OpenOptions};
use std::collections::HashSet;
use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::{Component, Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock};

/// Asks the user at the terminal; `None` when no answer is given.
pub type Question = Arc<dyn Fn(&str) -> Option<String> + Send + Sync>;

/// A file by the open folder that it is reached from.
#[derive(Clone, Debug)]
struct Spot {
    /// The job's folder, or the folder of a file that is elsewhere.
    base: Arc<Dir>,
    /// The name below that folder.
    below: PathBuf,
    /// The path as it is shown.
    path: PathBuf,
    /// Below the job's folder: an earlier file is kept under a number.
    own: bool,
}

impl Spot {
    /// The folder the file stands in, open, and its name there.
    fn stand(&self) -> Result<(Arc<Dir>, &OsStr), FileError> {
        let name = self.below.file_name().ok_or_else(|| self.error(ErrorKind::IsADirectory.into()))?;
        let folder = self.below.parent().filter(|p| !p.as_os_str().is_empty());
        let dir = match folder.map(|folder| self.base.open_dir(folder)) {
            None => Arc::clone(&self.base),
            Some(Ok(dir)) => Arc::new(dir),
            Some(Err(error)) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {
                return Err(if is_deleted(&self.base) {
                    self.error(error)
                } else {
                    FileError::NoFolder(folder_of(&self.path).into())
                });
            }
            Some(Err(error)) => return Err(self.error(error)),
        };
        Ok((dir, name))
    }

    /// What the system said of this file.
    fn error(&self, source: std::io::Error) -> FileError {
        let folder = || {
            let levels = self.below.components().count();
            self.path.ancestors().nth(levels).unwrap_or(Path::new("")).to_path_buf()
        };
        if self.own && source.kind() == ErrorKind::NotFound && is_deleted(&self.base) {
            FileError::FolderGone(folder())
        } else if source.kind() == ErrorKind::PermissionDenied && source.raw_os_error().is_none() {
            // a link that leads out of the open folder
            FileError::NotOwn { path: self.path.clone(), folder: folder() }
        } else {
            FileError::System { path: self.path.clone(), source }
        }
    }
}

/// A place that was found fit for a file, to be written now or later.
#[derive(Clone, Debug)]
pub struct FilePlace {
    spot: Spot,
    swept: Swept,
}

impl FilePlace {
    /// Where the file will be.
    pub fn path(&self) -> &Path {
        &self.spot.path
    }

    /// Writes the file whole or not at all.
    ///
    /// # Errors
    /// What the system refuses, or a file outside of the job's folder that has come up meanwhile.
    pub fn write(&self, bytes: &[u8]) -> Result<(), FileError> {
        let mut file = self.begin()?;
        file.write_all(bytes).map_err(|source| self.spot.error(source))?;
        file.finish()
    }

    /// Begins a file that is written piece by piece.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn begin(&self) -> Result<Growing, FileError> {
        let (dir, name) = self.spot.stand()?;
        if dir.is_dir(name) {
            return Err(self.spot.error(ErrorKind::IsADirectory.into()));
        }
        if self.spot.own {
            self.swept.sweep_once(folder_of(&self.spot.path), &dir);
        }
        let name = name.to_os_string();
        let (temporary, file) = temporary(&dir).map_err(|source| self.spot.error(source))?;
        Ok(Growing { spot: self.spot.clone(), dir, name, temporary, file: Some(file) })
    }
}

/// A file being written piece by piece: at its place only once it is finished; dropped before, it leaves nothing.
#[derive(Debug)]
pub struct Growing {
    spot: Spot,
    dir: Arc<Dir>,
    name: OsString,
    temporary: OsString,
    file: Option<File>,
}

impl Write for Growing {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.file.as_mut().map_or(Ok(0), |file| file.write(bytes))
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.as_mut().map_or(Ok(()), Write::flush)
    }
}

impl Growing {
    /// Puts the file at its place, whole.
    ///
    /// # Errors
    /// What the system refuses, or a file outside of the job's folder that has come up meanwhile.
    pub fn finish(mut self) -> Result<(), FileError> {
        self.flush().map_err(|source| self.spot.error(source))?;
        if self.spot.own {
            keep_earlier(&self.dir, &self.name).map_err(|source| self.spot.error(source))?;
        }
        rename_new(&self.dir, &self.temporary, &self.dir, &self.name).map_err(|source| match source.kind() {
            ErrorKind::AlreadyExists => FileError::Exists(self.spot.path.clone()),
            _ => self.spot.error(source),
        })?;
        // it stands under its own name, and nothing is to be removed
        self.file = None;
        Ok(())
    }
}

impl Drop for Growing {
    fn drop(&mut self) {
        if self.file.take().is_some() {
            // one that cannot be removed is removed when the folder is next used
            let _ = self.dir.remove_file(&self.temporary);
        }
    }
}

/// Folders in which this job has removed the temporary files of killed jobs.
#[derive(Clone, Debug, Default)]
struct Swept(Arc<Mutex<HashSet<PathBuf>>>);

impl Swept {
    /// Removes the temporary files of killed jobs, the first time that a folder is met.
    fn sweep_once(&self, path: &Path, dir: &Dir) {
        let new = self.0.lock().is_ok_and(|mut swept| swept.insert(path.to_path_buf()));
        if new && let Ok(entries) = dir.entries() {
            for name in entries.flatten().map(|entry| entry.file_name()).filter(|name| is_temporary(name)) {
                sweep(dir, &name);
            }
        }
    }
}

/// Removes a temporary file that no job has locked; what cannot be opened, locked or removed is left.
fn sweep(dir: &Dir, name: &OsStr) {
    let mut options = OpenOptions::new();
    options.read(true).follow(FollowSymlinks::No).nonblock(true);
    let Ok(file) = dir.open_with(name, &options) else { return };
    let file = file.into_std();
    if file.metadata().is_ok_and(|m| m.is_file()) && file.try_lock().is_ok() {
        let _ = dir.remove_file(name);
    }
}

/// The ends of the name of a temporary file.
const TEMPORARY: [&str; 2] = [".windlass-", ".tmp"];

fn is_temporary(name: &OsStr) -> bool {
    name.to_str().is_some_and(|name| name.starts_with(TEMPORARY[0]) && name.ends_with(TEMPORARY[1]))
}

/// Numbers the temporary files of this process.
static TEMPORARIES: AtomicU64 = AtomicU64::new(0);

/// Most names tried for a temporary file: each that is lost was taken by another job at that very moment.
const MAX_TEMPORARY_NAMES: u32 = 1000;

/// A new temporary file, locked, and its name.
fn temporary(dir: &Dir) -> std::io::Result<(OsString, File)> {
    for _ in 0..MAX_TEMPORARY_NAMES {
        let number = TEMPORARIES.fetch_add(1, Ordering::Relaxed);
        let name = OsString::from(format!("{}{}-{number}{}", TEMPORARY[0], std::process::id(), TEMPORARY[1]));
        let file = match dir.open_with(&name, OpenOptions::new().write(true).create_new(true)) {
            Ok(file) => file.into_std(),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => continue,
            Err(error) => return Err(error),
        };
        // a file system without locks has no sweeping either
        let _ = file.lock();
        // another job may have swept it before it was locked
        if !is_unlinked(&file) || is_deleted(dir) {
            return Ok((name, file));
        }
    }
    Err(ErrorKind::AlreadyExists.into())
}

/// The job's root name and its folder for answers.
pub struct JobFolder {
    /// The root: the script's path without its extension.
    pub root: PathBuf,
    /// Where answers go.
    pub folder: PathBuf,
    /// `--allow-files`: files may be made and `&FILE` may act anywhere.
    pub allow_files: bool,
    /// Somebody at a terminal who can be asked.
    pub question: Option<Question>,
    /// The record being executed was typed at the terminal.
    pub typed: bool,
    /// The folder was named by the user, and may be a link.
    named: bool,
    handle: OnceLock<Arc<Dir>>,
    /// Files that grow as the job runs (its log and report), links followed.
    growing: Vec<PathBuf>,
    swept: Swept,
    read: Mutex<ReadOutside>,
}

/// Files that were read, and which of them outside of the folder of the script and that of the job.
#[derive(Default)]
struct ReadOutside {
    known: HashSet<PathBuf>,
    unsaid: Vec<PathBuf>,
    /// All files read, in the order they were.
    all: Vec<PathBuf>,
}

/// Which of two names an error is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NameOperand {
    /// The present name.
    From,
    /// The new name.
    To,
}

impl JobFolder {
    /// The folder of a root: `ROOT.ans`, unless another is given.
    pub fn new(root: PathBuf, out: Option<PathBuf>, allow_files: bool) -> Self {
        let named = out.is_some();
        let folder = out.unwrap_or_else(|| {
            let mut name = root.clone().into_os_string();
            name.push(".ans");
            PathBuf::from(name)
        });
        JobFolder {
            root,
            folder,
            allow_files,
            question: None,
            typed: false,
            named,
            handle: OnceLock::new(),
            growing: Vec::new(),
            swept: Swept::default(),
            read: Mutex::default(),
        }
    }

    /// Sees that the folder is no link, unless the user named it.
    ///
    /// # Errors
    /// [`FileError::FolderIsLink`].
    pub fn check(&self) -> Result<(), FileError> {
        let link = !self.named && self.folder.symlink_metadata().is_ok_and(|m| m.is_symlink());
        if link { Err(FileError::FolderIsLink(self.folder.clone())) } else { Ok(()) }
    }

    /// The job's folder, opened once for the whole job; made where it is not there.
    fn dir(&self) -> Result<Arc<Dir>, FileError> {
        if let Some(dir) = self.handle.get() {
            return Ok(Arc::clone(dir));
        }
        let at = |source| FileError::System { path: self.folder.clone(), source };
        let dir = if self.named {
            std::fs::create_dir_all(&self.folder).map_err(at)?;
            Dir::open_ambient_dir(&self.folder, ambient_authority()).map_err(at)?
        } else {
            let beside = folder_of(&self.folder);
            let name = self.folder.file_name().ok_or_else(|| at(ErrorKind::InvalidInput.into()))?;
            std::fs::create_dir_all(beside).map_err(at)?;
            let beside = Dir::open_ambient_dir(beside, ambient_authority()).map_err(at)?;
            match beside.create_dir(name) {
                Err(error) if error.kind() != ErrorKind::AlreadyExists => return Err(at(error)),
                _ => {}
            }
            beside.open_dir_nofollow(name).map_err(|source| {
                let link = beside.symlink_metadata(name).is_ok_and(|m| m.is_symlink());
                if link { FileError::FolderIsLink(self.folder.clone()) } else { at(source) }
            })?
        };
        let dir = Arc::clone(self.handle.get_or_init(|| Arc::new(dir)));
        self.swept.sweep_once(&self.folder, &dir);
        Ok(dir)
    }

    /// The path that a name in a script stands for. A relative name is below the job's folder, its `..` taken off as
    /// they are written; one that begins with `./` or `../` and an absolute one are what they are to the shell.
    ///
    /// # Errors
    /// [`FileError::LeadsOut`].
    pub fn resolve(&self, name: &str) -> Result<PathBuf, FileError> {
        let path = Path::new(name);
        if !is_inside(name) {
            return Ok(path.into());
        }
        let leads_out = || FileError::LeadsOut { name: name.into(), folder: self.folder.clone() };
        let mut below = PathBuf::new();
        for part in path.components() {
            match part {
                Component::ParentDir if !below.pop() => return Err(leads_out()),
                Component::ParentDir => {}
                other => below.push(other),
            }
        }
        if below.as_os_str().is_empty() { Err(leads_out()) } else { Ok(self.folder.join(below)) }
    }

    /// The part of a path that is below the job's folder, links and `..` followed. A path through a link that leads nowhere
    /// has none: what is made there would be wherever the link points to.
    fn path_below(&self, path: &Path) -> Option<PathBuf> {
        let (folder, path) = real(&self.folder).zip(real(path))?;
        path.strip_prefix(folder).ok().filter(|below| !below.as_os_str().is_empty()).map(Path::to_path_buf)
    }

    /// Whether a path lies below the job's folder, links and `..` followed.
    pub fn owns(&self, path: &Path) -> bool {
        self.path_below(path).is_some()
    }

    /// Where a name of a record leads. Outside of the job's folder that needs `--allow-files`, or somebody who can be asked.
    fn spot(&self, name: &str, can_ask: bool) -> Result<Spot, FileError> {
        let path = self.resolve(name)?;
        if let Some(below) = self.path_below(&path) {
            return Ok(Spot { base: self.dir()?, below, path, own: true });
        }
        let can_ask = can_ask && self.typed && self.question.is_some();
        if !self.allow_files && !can_ask {
            self.check()?;
            return Err(FileError::NotOwn { path, folder: self.folder.clone() });
        }
        let folder = folder_of(&path);
        let name = path
            .file_name()
            .ok_or_else(|| FileError::System { path: path.clone(), source: ErrorKind::IsADirectory.into() })?;
        let base = Dir::open_ambient_dir(folder, ambient_authority()).map_err(|source| match source.kind() {
            ErrorKind::NotFound | ErrorKind::NotADirectory => FileError::NoFolder(folder.into()),
            _ => FileError::System { path: path.clone(), source },
        })?;
        Ok(Spot { base: Arc::new(base), below: name.into(), path, own: false })
    }

    /// Asks whether something may be made elsewhere, where that is neither the job's own nor allowed.
    fn consent(&self, spot: &Spot) -> Result<(), FileError> {
        if spot.own || self.allow_files {
            return Ok(());
        }
        let path = std::path::absolute(&spot.path).unwrap_or_else(|_| spot.path.clone());
        let question = format!("{} is outside of the job's folder. Create it (y/N)", path.display());
        let answer = self.question.as_ref().and_then(|ask| ask(&question)).unwrap_or_default();
        let yes = ["y", "yes"].iter().any(|yes| answer.trim().eq_ignore_ascii_case(yes));
        if yes { Ok(()) } else { Err(FileError::Declined(spot.path.clone())) }
    }

    /// Finds the place of a file that is to be written, and whether it can be written there.
    ///
    /// # Errors
    /// A name that leads nowhere, a missing folder, a folder of that name, a place the system does not let write to,
    /// a file outside of the job's folder that may not be made or exists, a name inside of it that a link leads out of it,
    /// a file in use.
    pub fn position(&self, name: &str) -> Result<FilePlace, FileError> {
        let spot = self.spot(name, true)?;
        self.not_in_use(&spot.path)?;
        let (dir, file) = spot.stand()?;
        if dir.is_dir(file) || name.ends_with(std::path::is_separator) {
            return Err(spot.error(ErrorKind::IsADirectory.into()));
        }
        match dir.symlink_metadata(file) {
            Ok(_) if !spot.own => return Err(FileError::Exists(spot.path)),
            Err(error) if error.kind() != ErrorKind::NotFound => return Err(spot.error(error)),
            _ => {}
        }
        self.consent(&spot)?;
        // gone again at once: it only shows that the folder takes files
        let (probe, _) = temporary(&dir).map_err(|source| spot.error(source))?;
        dir.remove_file(probe).map_err(|source| spot.error(source))?;
        Ok(FilePlace { spot, swept: self.swept.clone() })
    }

    /// Writes a file whole or not at all; returns where it went.
    ///
    /// # Errors
    /// As [`JobFolder::position`] and [`FilePlace::write`].
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<PathBuf, FileError> {
        let position = self.position(name)?;
        position.write(bytes)?;
        Ok(position.spot.path)
    }

    /// Creates a file that grows as the job runs (a log); an earlier one is kept.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn create(&mut self, name: &str) -> Result<File, FileError> {
        let (spot, dir) = self.of_job(name)?;
        if dir.is_dir(name) {
            return Err(spot.error(ErrorKind::IsADirectory.into()));
        }
        keep_earlier(&dir, OsStr::new(name)).map_err(|source| spot.error(source))?;
        let opened = dir.open_with(name, OpenOptions::new().read(true).write(true).create_new(true));
        let file = opened.map_err(|source| spot.error(source))?.into_std();
        self.growing.extend(real(&spot.path));
        Ok(file)
    }

    /// Opens a file of the job's folder that grew in an earlier run, or earlier in this one, to be read and gone on with.
    ///
    /// # Errors
    /// What the system refuses; there is none; it is a link or no regular file.
    pub fn reopen(&mut self, name: &str) -> Result<File, FileError> {
        let (spot, dir) = self.of_job(name)?;
        let mut options = OpenOptions::new();
        options.read(true).write(true).follow(FollowSymlinks::No).nonblock(true);
        let file = dir.open_with(name, &options).map_err(|source| spot.error(source))?.into_std();
        if !file.metadata().is_ok_and(|m| m.is_file()) {
            return Err(spot.error(std::io::Error::other("this is not a regular file")));
        }
        let path = real(&spot.path);
        self.growing.extend(path.filter(|p| !self.growing.contains(p)));
        Ok(file)
    }

    /// A file of this name in the job's folder itself.
    fn of_job(&self, name: &str) -> Result<(Spot, Arc<Dir>), FileError> {
        let dir = self.dir()?;
        Ok((Spot { base: Arc::clone(&dir), below: name.into(), path: self.folder.join(name), own: true }, dir))
    }

    /// Sees that a path is no file that grows as the job runs, nor a folder above one.
    fn not_in_use(&self, path: &Path) -> Result<(), FileError> {
        match self.growing.iter().find(|file| is_within(file, path)) {
            Some(file) => Err(FileError::InUse(file.clone())),
            None => Ok(()),
        }
    }

    /// Deletes a file.
    ///
    /// # Errors
    /// A file that is not the job's own or in use, or what the system refuses.
    pub fn remove(&self, name: &str) -> Result<PathBuf, FileError> {
        let spot = self.spot(name, false)?;
        self.not_in_use(&spot.path)?;
        let (dir, file) = spot.stand()?;
        dir.remove_file(file).map_err(|source| spot.error(source))?;
        Ok(spot.path)
    }

    /// Renames or copies a file; the new name must be free.
    ///
    /// # Errors
    /// Files that are not the job's own, a file to rename that is in use, a new name that exists, or what the system
    /// refuses; each with the name it is about.
    pub fn transfer(&self, from: &str, to: &str, keep: bool) -> Result<PathBuf, (NameOperand, FileError)> {
        let from = self.spot(from, false).map_err(|e| (NameOperand::From, e))?;
        let beyond = |e| (NameOperand::To, e);
        let to = self.spot(to, true).map_err(beyond)?;
        if !keep {
            self.not_in_use(&from.path).map_err(|e| (NameOperand::From, e))?;
        }
        let (to_dir, to_name) = to.stand().map_err(beyond)?;
        if is_there(&to_dir, to_name) {
            return Err(beyond(FileError::Taken(to.path)));
        }
        self.consent(&to).map_err(beyond)?;
        let at = |source| (NameOperand::From, from.error(source));
        let (from_dir, from_name) = from.stand().map_err(|e| (NameOperand::From, e))?;
        if keep {
            let mut options = OpenOptions::new();
            options.read(true).nonblock(true);
            let mut old = from_dir.open_with(from_name, &options).map_err(at)?.into_std();
            if !old.metadata().map_err(at)?.is_file() {
                return Err(at(std::io::Error::other("only a file can be copied")));
            }
            let position = FilePlace { spot: to, swept: self.swept.clone() };
            let mut new = position.begin().map_err(beyond)?;
            std::io::copy(&mut old, &mut new).map_err(at)?;
            new.finish().map_err(beyond)?;
            return Ok(position.spot.path);
        }
        rename_new(&from_dir, from_name, &to_dir, to_name).map_err(|source| match source.kind() {
            ErrorKind::AlreadyExists => (NameOperand::To, FileError::Taken(to.path.clone())),
            _ => at(source),
        })?;
        Ok(to.path)
    }

    /// Makes a folder, with those above it.
    ///
    /// # Errors
    /// A folder that is not the job's own, or what the system refuses.
    pub fn make_folder(&self, name: &str) -> Result<PathBuf, FileError> {
        let spot = self.spot_of_folder(name, true)?;
        self.consent(&spot)?;
        spot.base.create_dir_all(&spot.below).map_err(|source| spot.error(source))?;
        Ok(spot.path)
    }

    /// Answers go to another folder from now on; it is made where it is not there.
    ///
    /// # Errors
    /// A folder that is not the job's own, or what the system refuses.
    pub fn move_to(&mut self, name: &str) -> Result<(), FileError> {
        let spot = self.spot_of_folder(name, false)?;
        let made = spot.base.create_dir_all(&spot.below).and_then(|()| spot.base.open_dir(&spot.below));
        let dir = made.map_err(|source| spot.error(source))?;
        self.folder = spot.path;
        self.named = true;
        self.handle = OnceLock::from(Arc::new(dir));
        Ok(())
    }

    /// Where the name of a folder leads; one elsewhere is reached from the nearest folder above it that there is.
    fn spot_of_folder(&self, name: &str, can_ask: bool) -> Result<Spot, FileError> {
        match self.spot(name, can_ask) {
            Err(FileError::NoFolder(_)) => {}
            found => return found,
        }
        let path = self.resolve(name)?;
        let near = path.ancestors().find(|above| above.is_dir()).unwrap_or(Path::new("."));
        let below = path.strip_prefix(near).unwrap_or(&path).to_path_buf();
        let base = Dir::open_ambient_dir(near, ambient_authority());
        let base = base.map_err(|source| FileError::System { path: path.clone(), source })?;
        Ok(Spot { base: Arc::new(base), below, path, own: false })
    }

    /// Takes note of a file that is read; one outside of the folders of the script and the job is to be reported in the log.
    pub fn note_reading(&self, path: &Path) {
        let Some(path) = real(path) else { return };
        if let Ok(mut read) = self.read.lock()
            && !read.all.contains(&path)
        {
            read.all.push(path.clone());
        }
        let inside = |folder: &Path| real(folder).is_some_and(|folder| path.starts_with(folder));
        if !inside(folder_of(&self.root))
            && !inside(&self.folder)
            && let Ok(mut read) = self.read.lock()
            && read.known.insert(path.clone())
        {
            read.unsaid.push(path);
        }
    }

    /// All files read but those in the folder of the job, in the order they were; each comes once.
    pub fn files_read(&self) -> Vec<PathBuf> {
        let own = real(&self.folder);
        let is_own = |path: &PathBuf| own.as_ref().is_some_and(|own| path.starts_with(own));
        let read = self.read.lock().map(|read| read.all.clone()).unwrap_or_default();
        read.into_iter().filter(|path| !is_own(path)).collect()
    }

    /// Files read outside of the folders of the script and the job since this was last asked; each comes once.
    pub fn read_outside(&self) -> Vec<PathBuf> {
        self.read.lock().map(|mut read| std::mem::take(&mut read.unsaid)).unwrap_or_default()
    }
}

/// Whether a name is inside the job's folder by its spelling: relative, and not beginning with `./` or `../`.
pub fn is_inside(name: &str) -> bool {
    Path::new(name).components().next().is_none_or(|first| matches!(first, Component::Normal(_)))
}

/// Whether a path is a file or folder, or lies in that folder, links and `..` followed.
pub fn is_within(path: &Path, folder: &Path) -> bool {
    real(path).zip(real(folder)).is_some_and(|(path, folder)| path.starts_with(folder))
}

/// The folder a path stands in.
fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Whether a file that is open has been deleted.
#[cfg(unix)]
pub fn is_unlinked(file: &File) -> bool {
    use std::os::unix::fs::MetadataExt;
    file.metadata().is_ok_and(|m| m.nlink() == 0)
}

/// Whether a file that is open has been deleted: unknown on this system.
#[cfg(not(unix))]
pub fn is_unlinked(_: &File) -> bool {
    false
}

/// Whether a folder that is open has been deleted.
#[cfg(unix)]
fn is_deleted(dir: &Dir) -> bool {
    use cap_std::fs::MetadataExt;
    dir.dir_metadata().is_ok_and(|m| m.nlink() == 0)
}

#[cfg(not(unix))]
fn is_deleted(_: &Dir) -> bool {
    false
}

/// Renames a file to a name that must be free. Both names are of files in the folders themselves.
fn rename_new(from: &Dir, old: &OsStr, to: &Dir, new: &OsStr) -> std::io::Result<()> {
    #[cfg(any(target_os = "linux", target_vendor = "apple"))]
    {
        use rustix::fs::{RenameFlags, renameat_with};
        use rustix::io::Errno;
        match renameat_with(from, old, to, new, RenameFlags::NOREPLACE) {
            // a file system that does not know the flag
            Err(Errno::INVAL | Errno::NOSYS | Errno::NOTSUP) => {}
            done => return Ok(done?),
        }
    }
    // a second name is refused where there is one already
    from.hard_link(old, to, new)?;
    from.remove_file(old)
}

/// Whether something has this name, be it a link that leads nowhere.
fn is_there(dir: &Dir, name: &OsStr) -> bool {
    dir.symlink_metadata(name).is_ok()
}

/// Moves an existing file to `name.1`, or a number that is free with the one before it taken.
fn keep_earlier(dir: &Dir, name: &OsStr) -> std::io::Result<()> {
    let numbered = |number: u64| {
        let mut name = name.to_os_string();
        name.push(format!(".{number}"));
        name
    };
    while is_there(dir, name) {
        // numbers are taken without gaps, but for what somebody removed: bisection finds the end of them
        let mut free = 1;
        while free < u64::MAX / 2 && is_there(dir, &numbered(free)) {
            free *= 2;
        }
        let mut taken = free / 2;
        while free - taken > 1 {
            let middle = taken + (free - taken) / 2;
            if is_there(dir, &numbered(middle)) {
                taken = middle;
            } else {
                free = middle;
            }
        }
        match rename_new(dir, name, dir, &numbered(free)) {
            // another job has taken the number, or the file
            Err(error) if matches!(error.kind(), ErrorKind::AlreadyExists | ErrorKind::NotFound) => {}
            done => return done,
        }
    }
    Ok(())
}

/// The path with links and `..` resolved; what does not exist yet is taken as written. `None` for a link that leads
/// nowhere.
fn real(path: &Path) -> Option<PathBuf> {
    let absolute = std::path::absolute(path).ok()?;
    let mut out = PathBuf::new();
    for part in absolute.components() {
        match part {
            Component::ParentDir => {
                out.pop();
            }
            Component::CurDir => {}
            other => {
                out.push(other);
                match out.canonicalize() {
                    Ok(resolved) => out = resolved,
                    Err(_) if out.symlink_metadata().is_ok() => return None,
                    Err(_) => {}
                }
            }
        }
    }
    Some(out)
}

#[cfg(test)]
mod tests;
