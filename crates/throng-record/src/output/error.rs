//! Errors of writing a file.

use super::folder_of;
use std::io;
use std::path::{Path, PathBuf};

/// An error of writing a file. Every message names the path and how to fix the error.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The folder of the file does not exist.
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
    /// A file holds one person, and the name has no place for the number of the person.
    #[error(
        "cannot write {}: a .bvh file holds one person; put * where the number of the agent belongs: {}",
        path.display(),
        numbered(path).display()
    )]
    OnePerson {
        /// The name.
        path: PathBuf,
    },
    /// Another process is writing it.
    #[error("cannot write {}: another process is writing it; wait until that has ended, or name another file", path.display())]
    Busy {
        /// The file.
        path: PathBuf,
    },
    /// The system denies write access.
    #[error("cannot write {}: permission denied; check the folder's permissions, or write elsewhere", path.display())]
    Denied {
        /// The file.
        path: PathBuf,
    },
    /// The disk is full.
    #[error("cannot write {}: the disk is full; free some space, or write to another disk", path.display())]
    Full {
        /// The file.
        path: PathBuf,
    },
    /// The file has reached the greatest permitted size.
    #[error(
        "cannot write {}: a file may not grow larger here; raise the limit (`ulimit -f`), or write to another disk",
        path.display()
    )]
    TooLarge {
        /// The file.
        path: PathBuf,
    },
    /// The file could not be completed, but its part can be read.
    #[error("{error}\n  hint: the part written so far is in {} and can be read like a complete file", part.display())]
    Kept {
        /// The error.
        error: Box<OutputError>,
        /// The incomplete file.
        part: PathBuf,
    },
    /// Any other error of the system.
    #[error("cannot write {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
}

impl OutputError {
    /// Converts an error of the system to an error about `path`.
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

    /// Returns the path of the file.
    pub fn path(&self) -> &Path {
        match self {
            Self::FolderMissing { path, .. }
            | Self::IsFolder { path }
            | Self::OnePerson { path }
            | Self::Busy { path }
            | Self::Denied { path }
            | Self::Full { path }
            | Self::TooLarge { path }
            | Self::Io { path, .. } => path,
            Self::Kept { error, .. } => error.path(),
        }
    }
}

/// Returns a name with a `*` before its ending.
fn numbered(path: &Path) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-*.{ending}"))
}
