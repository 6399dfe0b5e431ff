//! Files the program writes and touches: where they go, that they are whole, and that nothing is lost.
//!
//! Source: reference/language.md section 8. A name without a folder goes below the job's own folder (`ROOT.ans/` or
//! `--out`); a name with a folder goes where it says. In the job's folder an earlier file is kept as `name.1`,
//! `name.2`, ...; outside of it nothing that exists is overwritten.

use std::io::Write;
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
        let parent = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let at = |source| FileError::System { path: path.clone(), source };
        if own {
            std::fs::create_dir_all(parent).map_err(at)?;
        }
        let mut file = tempfile::NamedTempFile::new_in(parent).map_err(at)?;
        file.write_all(bytes).and_then(|()| file.flush()).map_err(at)?;
        make_readable(file.as_file());
        if own {
            keep_earlier(&path)?;
        }
        file.persist_noclobber(&path).map_err(|e| match e.error.kind() {
            std::io::ErrorKind::AlreadyExists => FileError::Exists(path.clone()),
            _ => FileError::System { path: path.clone(), source: e.error },
        })?;
        Ok(path)
    }

    /// Creates a file that grows as the job runs (a log); an earlier one is kept.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn create(&self, name: &str) -> Result<std::fs::File, FileError> {
        let path = self.folder.join(name);
        let at = |source| FileError::System { path: path.clone(), source };
        std::fs::create_dir_all(&self.folder).map_err(at)?;
        keep_earlier(&path)?;
        std::fs::File::create_new(&path).map_err(at)
    }

    /// Whether a path lies below the job's folder, links and `..` followed.
    pub fn owns(&self, path: &Path) -> bool {
        real(&self.folder).zip(real(path)).is_some_and(|(folder, path)| path.starts_with(&folder) && path != folder)
    }

    /// A path that `&FILE` may act on: taken from the job's folder, and below it unless everything is allowed.
    ///
    /// # Errors
    /// [`FileError::NotOwn`].
    pub fn own(&self, name: &str) -> Result<PathBuf, FileError> {
        let path = if self.allow_files { PathBuf::from(name) } else { self.folder.join(name) };
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
        if to.symlink_metadata().is_ok() {
            return Err(FileError::Exists(to));
        }
        let done = if keep { std::fs::copy(&from, &to).map(|_| ()) } else { std::fs::rename(&from, &to) };
        done.map_err(|source| FileError::System { path: from, source })?;
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

/// Temporary files are private; answers get the permissions of ordinary files.
fn make_readable(file: &std::fs::File) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // a private answer file would still be whole, so a refusal is no reason to lose it
        let _ = file.set_permissions(std::fs::Permissions::from_mode(0o644));
    }
    #[cfg(not(unix))]
    let _ = file;
}

/// Moves an existing file to `name.1`, or the first number that is free.
fn keep_earlier(path: &Path) -> Result<(), FileError> {
    if !path.exists() {
        return Ok(());
    }
    for number in 1u32.. {
        let mut name = path.as_os_str().to_os_string();
        name.push(format!(".{number}"));
        let kept = PathBuf::from(name);
        if !kept.exists() {
            return std::fs::rename(path, kept).map_err(|source| FileError::System { path: path.into(), source });
        }
    }
    Ok(())
}

/// The path with links and `..` resolved; what does not exist yet is taken as written.
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
                    // a link that leads nowhere could lead anywhere once the file is made
                    Err(_) if out.symlink_metadata().is_ok() => return None,
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
        assert!(matches!(job.transfer("a", "b", false), Err(FileError::Exists(_))));
        job.remove("b").unwrap();
    }
}
