//! Where a file is until it is complete.

use super::Hand;
use std::fmt;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
#[cfg(unix)]
use std::time::Duration;
use std::time::Instant;
use tempfile::{NamedTempFile, TempPath};

/// How the name of a temporary file begins.
const PREFIX: &str = ".throng-";

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
            Self::Kept(mut part) => {
                std::fs::rename(&part.path, target)?;
                // Another process may use the name from now on, so it is not removed.
                part.settled = Some(Instant::now());
                Ok(())
            }
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

/// A new file with a name of its own in a folder, locked until it is closed.
pub(super) fn temporary(folder: &Path, suffix: &str) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(suffix);
    #[cfg(unix)]
    {
        // Temporary files are private by default; a result is as readable as any other file (the umask applies).
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let file = builder.tempfile_in(folder)?;
    // Without locks in the file system, a killed process leaves its file. On Windows a lock would keep other writers
    // of this file out, such as ffmpeg.
    #[cfg(unix)]
    let _ = file.as_file().try_lock();
    Ok(file)
}

/// A process locks its temporary file within this time after it creates it.
#[cfg(unix)]
const LOCKED_AFTER: Duration = Duration::from_mins(1);

/// Removes the temporary files in a folder that no process holds. What cannot be removed stays.
#[cfg(unix)]
pub(super) fn remove_leftovers(folder: &Path) {
    let entries = folder.read_dir().into_iter().flatten().flatten();
    entries.filter(is_leftover).for_each(|entry| drop(std::fs::remove_file(entry.path())));
}

#[cfg(unix)]
fn is_leftover(entry: &std::fs::DirEntry) -> bool {
    let is_old = || {
        let written = entry.metadata().ok().filter(std::fs::Metadata::is_file)?.modified().ok()?;
        written.elapsed().ok().map(|age| age > LOCKED_AFTER)
    };
    entry.file_name().as_encoded_bytes().starts_with(PREFIX.as_bytes())
        && is_old() == Some(true)
        && File::open(entry.path()).is_ok_and(|file| file.try_lock().is_ok())
}
