//! Why a file could not be written or touched.

use std::path::PathBuf;

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
    /// A relative name that climbs out of the job's folder, or stops at it.
    #[error("`{name}` leads to nothing below the job's own folder {}", folder.display())]
    LeadsOut {
        /// The name as written.
        name: String,
        /// The job's folder.
        folder: PathBuf,
    },
    /// A file that the job itself is writing.
    #[error("{} is in use: this job has it open", .0.display())]
    InUse(PathBuf),
    /// The folder a file would stand in is missing.
    #[error("there is no folder {}", .0.display())]
    NoFolder(PathBuf),
}

impl FileError {
    /// What to do about it, for a help line.
    pub fn help(&self) -> Option<&'static str> {
        match self {
            FileError::NotOwn { .. } => Some("a script may only touch what is its own; --allow-files lifts this"),
            FileError::LeadsOut { .. } => Some("a name from the current directory begins with ./ or ../"),
            FileError::NoFolder(_) => Some(
                "&FILE MKDIR makes one in the job's folder; a name from the current directory begins with ./ or ../",
            ),
            FileError::System { .. } | FileError::Exists(_) | FileError::Taken(_) | FileError::InUse(_) => None,
        }
    }
}
