//! Why a file could not be written.

use super::folder_of;
use std::io;
use std::path::{Path, PathBuf};

/// Why a file could not be written. Every message names the path and says what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The folder the file should go to is not there.
    #[error("cannot write {}: there is no folder {}; create it, or name another", path.display(), folder.display())]
    FolderMissing {
        /// The file.
        path: PathBuf,
        /// The folder that is missing.
        folder: PathBuf,
    },
    /// The path is a folder.
    #[error("cannot write {}: it is a folder; add a file name", path.display())]
    IsFolder {
        /// The path.
        path: PathBuf,
    },
    /// Another process is writing it.
    #[error("cannot write {}: another process is writing it; wait until that has ended, or name another file", path.display())]
    Busy {
        /// The file.
        path: PathBuf,
    },
    /// The system does not let us write there.
    #[error("cannot write {}: permission denied; check the folder's permissions, or write elsewhere", path.display())]
    Denied {
        /// The file.
        path: PathBuf,
    },
    /// No room is left.
    #[error("cannot write {}: the disk is full; free some space, or write to another disk", path.display())]
    Full {
        /// The file.
        path: PathBuf,
    },
    /// The file has reached the greatest size that is allowed.
    #[error(
        "cannot write {}: a file may not grow larger here; raise the limit (`ulimit -f`), or write to another disk",
        path.display()
    )]
    TooLarge {
        /// The file.
        path: PathBuf,
    },
    /// It could not be completed, and what there is of it can be read.
    #[error("{error}\n  hint: what was written until then is in {}, and is read as the whole would be", part.display())]
    Kept {
        /// Why.
        error: Box<OutputError>,
        /// The file that is there.
        part: PathBuf,
    },
    /// Anything else the system reports.
    #[error("cannot write {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

impl OutputError {
    /// The error of the system as an error about `path`.
    pub fn new(path: &Path, source: io::Error) -> Self {
        let path = path.to_path_buf();
        match source.kind() {
            io::ErrorKind::NotFound if !folder_of(&path).is_dir() => {
                Self::FolderMissing { folder: folder_of(&path), path }
            }
            io::ErrorKind::ResourceBusy => Self::Busy { path },
            io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => Self::Denied { path },
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => Self::Full { path },
            io::ErrorKind::FileTooLarge => Self::TooLarge { path },
            io::ErrorKind::IsADirectory => Self::IsFolder { path },
            _ => Self::Io { path, source },
        }
    }

    /// The file it is about.
    pub fn path(&self) -> &Path {
        match self {
            Self::FolderMissing { path, .. }
            | Self::IsFolder { path }
            | Self::Busy { path }
            | Self::Denied { path }
            | Self::Full { path }
            | Self::TooLarge { path }
            | Self::Io { path, .. } => path,
            Self::Kept { error, .. } => error.path(),
        }
    }
}
