//! The place of a file until it is complete.

use super::Hand;
use std::fmt;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
#[cfg(unix)]
use std::time::Duration;
use std::time::Instant;
use tempfile::{NamedTempFile, TempPath};

/// Prefix of the names of temporary files.
const PREFIX: &str = ".throng-";

/// A file that is not complete yet.
#[derive(Debug)]
pub(super) enum Temporary {
    /// Removed when dropped.
    Removed(TempPath),
    /// Kept when dropped.
    Kept(UnfinishedFile),
}

/// A file that stays once the system has received some of its bytes.
#[derive(Debug)]
pub(super) struct UnfinishedFile {
    pub(super) path: PathBuf,
    /// When bytes were last passed to the system.
    pub(super) settled: Option<Instant>,
}

impl Drop for UnfinishedFile {
    fn drop(&mut self) {
        if self.settled.is_none() {
            // if it cannot be removed, an empty file stays
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

/// The destination of bytes until the file is complete.
pub(super) enum OutputPlace {
    File(BufWriter<File>),
    Memory(Vec<u8>, Hand),
}

impl fmt::Debug for OutputPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(file) => file.fmt(f),
            Self::Memory(bytes, _) => write!(f, "{} bytes", bytes.len()),
        }
    }
}

impl OutputPlace {
    pub(super) fn of(&mut self) -> &mut dyn Write {
        match self {
            Self::File(file) => file,
            Self::Memory(bytes, _) => bytes,
        }
    }
}

/// Creates a file with a unique name in a folder, locked until it is closed.
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

/// Longest time from the creation of a temporary file to its lock.
#[cfg(unix)]
const LOCKED_AFTER: Duration = Duration::from_mins(1);

/// Removes the temporary files in a folder that no process has locked. Files that cannot be removed stay.
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
