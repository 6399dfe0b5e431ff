//! Why a file could not be written, read or touched.

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
    /// A file elsewhere that the user, asked, does not want.
    #[error("{} is outside of the job's folder, and the answer was no: nothing is written", .0.display())]
    Declined(PathBuf),
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
    /// `ROOT.ans` is a link.
    #[error("the answers folder {} is a link, and answers would go where it points", .0.display())]
    FolderIsLink(PathBuf),
    /// The job's folder was deleted while the job ran.
    #[error("the answers folder {} was deleted while the job ran", .0.display())]
    FolderGone(PathBuf),
}

impl FileError {
    /// What to do about it, for a help line.
    pub fn help(&self) -> Option<&'static str> {
        match self {
            FileError::NotOwn { .. } => Some(
                "a script writes below the job's own folder only; --allow-files lifts this, and a record typed at a terminal may create a file elsewhere",
            ),
            FileError::LeadsOut { .. } => Some("a name from the current directory begins with ./ or ../"),
            FileError::NoFolder(_) => Some(
                "&FILE MKDIR makes one in the job's folder; a name from the current directory begins with ./ or ../",
            ),
            FileError::FolderIsLink(_) => Some("--out DIR names the folder for answers, which may be a link"),
            FileError::System { .. }
            | FileError::Exists(_)
            | FileError::Taken(_)
            | FileError::Declined(_)
            | FileError::InUse(_)
            | FileError::FolderGone(_) => None,
        }
    }
}
