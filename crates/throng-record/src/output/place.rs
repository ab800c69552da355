//! Where a file is until it is complete.

use super::Hand;
use std::fmt;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;
use tempfile::{NamedTempFile, TempPath};

/// The file that is not yet complete.
#[derive(Debug)]
pub(super) enum Temporary {
    /// Is removed when dropped.
    Removed(TempPath),
    /// Stays.
    Kept(Part),
}

/// A file that stays as soon as the system has something of it.
#[derive(Debug)]
pub(super) struct Part {
    pub(super) path: PathBuf,
    /// When its bytes were last handed to the system.
    pub(super) settled: Option<Instant>,
}

impl Drop for Part {
    fn drop(&mut self) {
        if self.settled.is_none() {
            // what cannot be removed stays, and is empty
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

impl Temporary {
    pub(super) fn path(&self) -> &Path {
        match self {
            Self::Removed(path) => path,
            Self::Kept(part) => &part.path,
        }
    }

    pub(super) fn persist(self, target: &Path) -> io::Result<()> {
        match self {
            Self::Removed(path) => path.persist(target).map_err(|error| error.error),
            Self::Kept(part) => std::fs::rename(&part.path, target),
        }
    }
}

/// Where bytes are until the file is complete.
pub(super) enum Place {
    File(BufWriter<File>),
    Memory(Vec<u8>, Hand),
}

impl fmt::Debug for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(file) => file.fmt(f),
            Self::Memory(bytes, _) => write!(f, "{} bytes", bytes.len()),
        }
    }
}

impl Place {
    pub(super) fn of(&mut self) -> &mut dyn Write {
        match self {
            Self::File(file) => file,
            Self::Memory(bytes, _) => bytes,
        }
    }
}

/// A new file with a name of its own in a folder.
pub(super) fn temporary(folder: &Path, suffix: &str) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".throng-").suffix(suffix);
    #[cfg(unix)]
    {
        // Temporary files are private by default; a result is as readable as any other file (the umask applies).
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}
