//! Files the program writes and touches: where they go, that they are whole, and that nothing is lost.
//!
//! Source: reference/language.md section 8. A relative name, with folders or without, is inside the job's own folder
//! (`ROOT.ans/` or `--out`); a name that begins with `./` or `../` and an absolute one mean what they mean to the shell.
//! In the job's folder an earlier file is kept as `name.1`, `name.2`, ...; outside of it nothing that exists is
//! overwritten. Files are written whole: first under a temporary name beside the place, then renamed.

mod error;

pub use error::FileError;

use std::io::{ErrorKind, Write};
use std::path::{Component, Path, PathBuf};

/// A place that was found fit for a file, to be written now or later.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    path: PathBuf,
    /// Below the job's folder: an earlier file is kept under a number.
    own: bool,
}

impl Place {
    /// Where the file will be.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the file whole or not at all.
    ///
    /// # Errors
    /// What the system refuses, or a file outside of the job's folder that has come up meanwhile.
    pub fn write(&self, bytes: &[u8]) -> Result<(), FileError> {
        let mut file = self.begin()?;
        file.write_all(bytes).map_err(|source| FileError::System { path: self.path.clone(), source })?;
        file.finish()
    }

    /// Begins a file that is written piece by piece.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn begin(&self) -> Result<Growing, FileError> {
        let at = |source| FileError::System { path: self.path.clone(), source };
        if self.path.is_dir() {
            return Err(at(ErrorKind::IsADirectory.into()));
        }
        Ok(Growing { file: beside(&self.path).map_err(at)?, place: self.clone() })
    }
}

/// A file being written piece by piece: at its place only once it is finished; dropped before, it leaves nothing.
#[derive(Debug)]
pub struct Growing {
    file: tempfile::NamedTempFile,
    place: Place,
}

impl Write for Growing {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.flush()
    }
}

impl Growing {
    /// Puts the file at its place, whole.
    ///
    /// # Errors
    /// What the system refuses, or a file outside of the job's folder that has come up meanwhile.
    pub fn finish(mut self) -> Result<(), FileError> {
        let path = &self.place.path;
        self.file.flush().map_err(|source| FileError::System { path: path.clone(), source })?;
        if self.place.own {
            keep_earlier(path)?;
        }
        put_in_place(self.file, path)
    }
}

/// The job's root name and its folder for answers.
#[derive(Clone, Debug, PartialEq)]
pub struct JobFolder {
    /// The root: the script's path without its extension.
    pub root: PathBuf,
    /// Where answers go.
    pub folder: PathBuf,
    /// `--allow-files`: `&FILE` may act anywhere.
    pub allow_files: bool,
    /// Files that grow as the job runs (its log and report), links followed.
    growing: Vec<PathBuf>,
}

/// Which of two names an error is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The present name.
    From,
    /// The new name.
    To,
}

impl JobFolder {
    /// The folder of a root: `ROOT.ans`, unless another is given.
    pub fn new(root: PathBuf, out: Option<PathBuf>, allow_files: bool) -> Self {
        let folder = out.unwrap_or_else(|| {
            let mut name = root.clone().into_os_string();
            name.push(".ans");
            PathBuf::from(name)
        });
        JobFolder { root, folder, allow_files, growing: Vec::new() }
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

    /// Finds the place of a file that is to be written, and whether it can be written there.
    ///
    /// # Errors
    /// A name that leads nowhere, a missing folder, a folder of that name, a place the system does not let write to,
    /// a file outside of the job's folder that exists, a name inside of it that a link leads out of it, a file in use.
    pub fn place(&self, name: &str) -> Result<Place, FileError> {
        let path = if is_inside(name) { self.own(name)? } else { self.resolve(name)? };
        self.not_in_use(&path)?;
        let at = |source| FileError::System { path: path.clone(), source };
        let own = self.stands(&path)?;
        if path.is_dir() || name.ends_with(std::path::is_separator) {
            return Err(at(ErrorKind::IsADirectory.into()));
        }
        match path.symlink_metadata() {
            Ok(_) if !own => return Err(FileError::Exists(path)),
            Err(error) if error.kind() != ErrorKind::NotFound => return Err(at(error)),
            _ => {}
        }
        // gone again at once: it only shows that the folder takes files
        beside(&path).map_err(at)?;
        Ok(Place { path, own })
    }

    /// Sees that there is a folder for a path, and makes the job's own if it is that; whether the path is the job's own.
    fn stands(&self, path: &Path) -> Result<bool, FileError> {
        let own = self.owns(path);
        if own {
            std::fs::create_dir_all(&self.folder)
                .map_err(|source| FileError::System { path: self.folder.clone(), source })?;
        }
        let folder = folder_of(path);
        if folder.is_dir() { Ok(own) } else { Err(FileError::NoFolder(folder.into())) }
    }

    /// Writes a file whole or not at all; returns where it went.
    ///
    /// # Errors
    /// As [`JobFolder::place`] and [`Place::write`].
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<PathBuf, FileError> {
        let place = self.place(name)?;
        place.write(bytes)?;
        Ok(place.path)
    }

    /// Creates a file that grows as the job runs (a log); an earlier one is kept.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn create(&mut self, name: &str) -> Result<std::fs::File, FileError> {
        let path = self.folder.join(name);
        let at = |source| FileError::System { path: path.clone(), source };
        if path.is_dir() {
            return Err(at(ErrorKind::IsADirectory.into()));
        }
        std::fs::create_dir_all(&self.folder).map_err(at)?;
        keep_earlier(&path)?;
        let file = std::fs::File::create_new(&path).map_err(at)?;
        self.growing.extend(real(&path));
        Ok(file)
    }

    /// Opens a file of the job's folder that grew in an earlier run, or earlier in this one, to be read and gone on with.
    ///
    /// # Errors
    /// What the system refuses; there is none.
    pub fn reopen(&mut self, name: &str) -> Result<std::fs::File, FileError> {
        let path = self.folder.join(name);
        let opened = std::fs::OpenOptions::new().read(true).write(true).open(&path);
        let file = opened.map_err(|source| FileError::System { path: path.clone(), source })?;
        let path = real(&path);
        self.growing.extend(path.filter(|p| !self.growing.contains(p)));
        Ok(file)
    }

    /// Sees that a path is no file that grows as the job runs, nor a folder above one.
    fn not_in_use(&self, path: &Path) -> Result<(), FileError> {
        match self.growing.iter().find(|file| lies_in(file, path)) {
            Some(file) => Err(FileError::InUse(file.clone())),
            None => Ok(()),
        }
    }

    /// Whether a path lies below the job's folder, links and `..` followed. A path through a link that leads nowhere
    /// is not: what is made there would be wherever the link points to.
    pub fn owns(&self, path: &Path) -> bool {
        real(&self.folder).zip(real(path)).is_some_and(|(folder, path)| path.starts_with(&folder) && path != folder)
    }

    /// A path that `&FILE` may act on: below the job's folder unless everything is allowed. What a name means does not
    /// depend on what is allowed.
    ///
    /// # Errors
    /// [`FileError::NotOwn`], [`FileError::LeadsOut`].
    pub fn own(&self, name: &str) -> Result<PathBuf, FileError> {
        let path = self.resolve(name)?;
        if self.allow_files || self.owns(&path) {
            Ok(path)
        } else {
            Err(FileError::NotOwn { path, folder: self.folder.clone() })
        }
    }

    /// Deletes a file.
    ///
    /// # Errors
    /// A file that is not the job's own or in use, or what the system refuses.
    pub fn remove(&self, name: &str) -> Result<PathBuf, FileError> {
        let path = self.own(name)?;
        self.not_in_use(&path)?;
        std::fs::remove_file(&path).map_err(|source| FileError::System { path: path.clone(), source })?;
        Ok(path)
    }

    /// Renames or copies a file; the new name must be free.
    ///
    /// # Errors
    /// Files that are not the job's own, a file to rename that is in use, a new name that exists, or what the system
    /// refuses; each with the name it is about.
    pub fn transfer(&self, from: &str, to: &str, keep: bool) -> Result<PathBuf, (Side, FileError)> {
        let from = self.own(from).map_err(|e| (Side::From, e))?;
        let beyond = |e| (Side::To, e);
        let to = self.own(to).map_err(beyond)?;
        if !keep {
            self.not_in_use(&from).map_err(|e| (Side::From, e))?;
        }
        if there(&to) {
            return Err(beyond(FileError::Taken(to)));
        }
        self.stands(&to).map_err(beyond)?;
        let at = |source| (Side::From, FileError::System { path: from.clone(), source });
        if keep {
            if !std::fs::metadata(&from).map_err(at)?.is_file() {
                return Err(at(std::io::Error::other("only a file can be copied")));
            }
            let mut file = beside(&to).map_err(|source| beyond(FileError::System { path: to.clone(), source }))?;
            std::fs::File::open(&from).and_then(|mut f| std::io::copy(&mut f, &mut file)).map_err(at)?;
            put_in_place(file, &to).map_err(beyond)?;
        } else {
            std::fs::rename(&from, &to).map_err(at)?;
        }
        Ok(to)
    }

    /// Makes a folder, with those above it.
    ///
    /// # Errors
    /// A folder that is not the job's own, or what the system refuses.
    pub fn make_folder(&self, name: &str) -> Result<PathBuf, FileError> {
        let path = self.own(name)?;
        std::fs::create_dir_all(&path).map_err(|source| FileError::System { path: path.clone(), source })?;
        Ok(path)
    }
}

/// Whether a name is inside the job's folder by its spelling: relative, and not beginning with `./` or `../`.
pub fn is_inside(name: &str) -> bool {
    !Path::new(name).components().next().is_some_and(|first| !matches!(first, Component::Normal(_)))
}

/// Whether a path is a file or folder, or lies in that folder, links and `..` followed.
pub fn lies_in(path: &Path, folder: &Path) -> bool {
    real(path).zip(real(folder)).is_some_and(|(path, folder)| path.starts_with(folder))
}

/// The folder a path stands in.
fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A temporary file in the folder of a path, readable by whom the user's umask lets read.
fn beside(path: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder_of(path))
}

/// Renames a temporary file to its place, which must be free.
fn put_in_place(file: tempfile::NamedTempFile, path: &Path) -> Result<(), FileError> {
    match file.persist_noclobber(path) {
        Ok(_) => Ok(()),
        Err(e) if e.error.kind() == ErrorKind::AlreadyExists => Err(FileError::Exists(path.into())),
        Err(e) => Err(FileError::System { path: path.into(), source: e.error }),
    }
}

/// Whether something has this name, be it a link that leads nowhere.
fn there(path: &Path) -> bool {
    path.symlink_metadata().is_ok()
}

/// Moves an existing file to `name.1`, or the first number that is free.
fn keep_earlier(path: &Path) -> Result<(), FileError> {
    if !there(path) {
        return Ok(());
    }
    for number in 1u32.. {
        let mut name = path.as_os_str().to_os_string();
        name.push(format!(".{number}"));
        let kept = PathBuf::from(name);
        if !there(&kept) {
            return std::fs::rename(path, kept).map_err(|source| FileError::System { path: path.into(), source });
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
                    Err(_) if there(&out) => return None,
                    Err(_) => {}
                }
            }
        }
    }
    Some(out)
}

#[cfg(test)]
mod tests;
