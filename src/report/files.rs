//! Files the program writes and touches: where they go, that they are whole, and that nothing is lost.
//!
//! Source: reference/language.md section 8. A name without a folder goes below the job's own folder (`ROOT.ans/` or
//! `--out`); a name with a folder goes where it says. In the job's folder an earlier file is kept as `name.1`,
//! `name.2`, ...; outside of it nothing that exists is overwritten. Files are written whole: first under a temporary
//! name beside the place, then renamed.

use std::io::{ErrorKind, Write};
use std::path::{Component, Path, PathBuf};

/// Why a file could not be written or touched.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The system refused.
    #[error("{path}: {source}", path = path.display())]
    System {
        /// Which file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A file outside of the job's folder is there already.
    #[error("{} exists already, and outside of the job's folder no file is overwritten", .0.display())]
    Exists(PathBuf),
    /// The new name of a file is taken.
    #[error("{} exists already", .0.display())]
    Taken(PathBuf),
    /// A file that is not the job's own.
    #[error("{} is not below the job's own folder {}", path.display(), folder.display())]
    NotOwn {
        /// Which file.
        path: PathBuf,
        /// The job's folder.
        folder: PathBuf,
    },
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
}

impl JobFolder {
    /// The folder of a root: `ROOT.ans`, unless another is given.
    pub fn new(root: PathBuf, out: Option<PathBuf>, allow_files: bool) -> Self {
        let folder = out.unwrap_or_else(|| {
            let mut name = root.clone().into_os_string();
            name.push(".ans");
            PathBuf::from(name)
        });
        JobFolder { root, folder, allow_files }
    }

    /// Where a file named by the user goes.
    pub fn resolve(&self, name: &str) -> PathBuf {
        let path = Path::new(name);
        if path.components().count() == 1 && path.file_name().is_some() { self.folder.join(path) } else { path.into() }
    }

    /// Writes a file whole or not at all; returns where it went.
    ///
    /// # Errors
    /// What the system refuses, or a file outside of the job's folder that exists.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<PathBuf, FileError> {
        let path = self.resolve(name);
        let own = self.owns(&path);
        let at = |source| FileError::System { path: path.clone(), source };
        if path.is_dir() {
            return Err(at(ErrorKind::IsADirectory.into()));
        }
        if own {
            std::fs::create_dir_all(folder_of(&path)).map_err(at)?;
        }
        let mut file = beside(&path).map_err(at)?;
        file.write_all(bytes).and_then(|()| file.flush()).map_err(at)?;
        if own {
            keep_earlier(&path)?;
        }
        put_in_place(file, &path)?;
        Ok(path)
    }

    /// Creates a file that grows as the job runs (a log); an earlier one is kept.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn create(&self, name: &str) -> Result<std::fs::File, FileError> {
        let path = self.folder.join(name);
        let at = |source| FileError::System { path: path.clone(), source };
        if path.is_dir() {
            return Err(at(ErrorKind::IsADirectory.into()));
        }
        std::fs::create_dir_all(&self.folder).map_err(at)?;
        keep_earlier(&path)?;
        std::fs::File::create_new(&path).map_err(at)
    }

    /// Whether a path lies below the job's folder, links and `..` followed. A path through a link that leads nowhere
    /// is not: what is made there would be wherever the link points to.
    pub fn owns(&self, path: &Path) -> bool {
        real(&self.folder).zip(real(path)).is_some_and(|(folder, path)| path.starts_with(&folder) && path != folder)
    }

    /// A path that `&FILE` may act on: taken from the job's folder, and below it unless everything is allowed. What a
    /// name means does not depend on what is allowed.
    ///
    /// # Errors
    /// [`FileError::NotOwn`].
    pub fn own(&self, name: &str) -> Result<PathBuf, FileError> {
        let path = self.folder.join(name);
        if self.allow_files || self.owns(&path) {
            Ok(path)
        } else {
            Err(FileError::NotOwn { path, folder: self.folder.clone() })
        }
    }

    /// Deletes a file.
    ///
    /// # Errors
    /// A file that is not the job's own, or what the system refuses.
    pub fn remove(&self, name: &str) -> Result<PathBuf, FileError> {
        let path = self.own(name)?;
        std::fs::remove_file(&path).map_err(|source| FileError::System { path: path.clone(), source })?;
        Ok(path)
    }

    /// Renames or copies a file; the new name must be free.
    ///
    /// # Errors
    /// Files that are not the job's own, a new name that exists, or what the system refuses.
    pub fn transfer(&self, from: &str, to: &str, keep: bool) -> Result<PathBuf, FileError> {
        let (from, to) = (self.own(from)?, self.own(to)?);
        if there(&to) {
            return Err(FileError::Taken(to));
        }
        let at = |source| FileError::System { path: from.clone(), source };
        if keep {
            if !std::fs::metadata(&from).map_err(at)?.is_file() {
                return Err(at(std::io::Error::other("only a file can be copied")));
            }
            let mut file = beside(&to).map_err(|source| FileError::System { path: to.clone(), source })?;
            std::fs::File::open(&from).and_then(|mut f| std::io::copy(&mut f, &mut file)).map_err(at)?;
            put_in_place(file, &to)?;
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
mod tests {
    use super::*;

    fn job() -> (tempfile::TempDir, JobFolder) {
        let dir = tempfile::tempdir().unwrap();
        let job = JobFolder::new(dir.path().join("job"), None, false);
        (dir, job)
    }

    #[test]
    fn an_earlier_answer_is_kept_under_a_number() {
        let (_dir, job) = job();
        for text in ["one", "two", "three"] {
            job.write("t.csv", text.as_bytes()).unwrap();
        }
        let read = |name: &str| std::fs::read_to_string(job.folder.join(name)).unwrap();
        assert_eq!((read("t.csv"), read("t.csv.1"), read("t.csv.2")), ("three".into(), "one".into(), "two".into()));
    }

    #[test]
    fn nothing_outside_the_folder_is_overwritten() {
        let (dir, job) = job();
        let path = dir.path().join("mine.txt");
        std::fs::write(&path, "mine").unwrap();
        assert!(matches!(job.write(path.to_str().unwrap(), b"x"), Err(FileError::Exists(_))));
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "mine");
        assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 1, "no temporary file is left");
    }

    #[test]
    fn file_commands_stay_below_the_folder_even_through_links_and_dots() {
        let (dir, job) = job();
        let secret = dir.path().join("secret");
        std::fs::write(&secret, "x").unwrap();
        std::fs::create_dir_all(job.folder.join("sub")).unwrap();
        assert!(matches!(job.remove("../secret"), Err(FileError::NotOwn { .. })));
        assert!(matches!(job.remove("sub/../../secret"), Err(FileError::NotOwn { .. })));
        assert!(matches!(job.remove(secret.to_str().unwrap()), Err(FileError::NotOwn { .. })));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(dir.path(), job.folder.join("link")).unwrap();
            assert!(matches!(job.remove("link/secret"), Err(FileError::NotOwn { .. })));
            std::os::unix::fs::symlink(dir.path().join("new"), job.folder.join("nowhere")).unwrap();
            job.write("b", b"1").unwrap();
            assert!(matches!(job.transfer("b", "nowhere", true), Err(FileError::NotOwn { .. })));
            job.remove("b").unwrap();
        }
        assert!(secret.exists());
        job.write("a", b"1").unwrap();
        job.transfer("a", "b", true).unwrap();
        assert!(matches!(job.transfer("a", "b", false), Err(FileError::Taken(_))));
        job.remove("b").unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn a_link_that_leads_nowhere_is_no_way_out() {
        let (dir, job) = job();
        job.write("a", b"1").unwrap();
        let outside = dir.path().join("new");
        std::os::unix::fs::symlink(&outside, job.folder.join("link")).unwrap();
        for keep in [true, false] {
            assert!(matches!(job.transfer("a", "link", keep), Err(FileError::NotOwn { .. })));
        }
        assert!(matches!(job.write("link", b"x"), Err(FileError::Exists(_))));
        assert!(matches!(job.make_folder("link/sub"), Err(FileError::NotOwn { .. })));
        assert!(!outside.exists() && job.folder.join("a").exists());
    }

    #[test]
    fn a_folder_is_neither_written_over_nor_moved_away() {
        let (_dir, job) = job();
        job.make_folder("sub").unwrap();
        assert!(job.write("sub", b"1").is_err() && job.create("sub").is_err());
        assert!(job.transfer("sub", "copy", true).is_err());
        assert!(job.folder.join("sub").is_dir() && !job.folder.join("sub.1").exists());
    }

    #[test]
    fn a_name_means_the_same_file_whatever_is_allowed() {
        let (_dir, mut job) = job();
        job.write("a", b"1").unwrap();
        job.allow_files = true;
        assert_eq!(job.own("a").unwrap(), job.folder.join("a"));
        let beyond = job.folder.join("../mine");
        assert_eq!(job.transfer("a", "../mine", true).unwrap(), beyond);
        assert!(beyond.exists());
    }

    #[test]
    fn names_keep_case_blanks_and_letters_of_any_alphabet() {
        let (_dir, job) = job();
        for name in ["Mixed Case.CSV", "anker\u{e9} \u{6d77}.csv", &"n".repeat(200)] {
            let path = job.write(name, b"1").unwrap();
            assert_eq!(path.file_name().unwrap().to_str(), Some(name));
        }
        assert!(job.write(&"n".repeat(5000), b"1").is_err());
        assert!(job.write("", b"1").is_err() && job.write("..", b"1").is_err());
    }
}
