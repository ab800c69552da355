//! Files under fixed names that a single process may write at a time.

use std::fs::{File, OpenOptions};
use std::io;
use std::path::Path;

/// Opens a file as [`claim`] does; creates it first if it does not exist.
pub(super) fn claim_new(path: &Path) -> io::Result<File> {
    match File::create_new(path) {
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => Err(error),
        _ => claim(path),
    }
}

/// Opens a file for writing, exclusively until it is closed. Its content is kept.
///
/// # Errors
/// [`io::ErrorKind::ResourceBusy`] if another process writes it. Any other error if it is a link or not an ordinary
/// file, or from the system.
pub(super) fn claim(path: &Path) -> io::Result<File> {
    if !path.symlink_metadata()?.is_file() {
        let why = format!("{} is a link or not an ordinary file; remove it, or name another file", path.display());
        return Err(io::Error::other(why));
    }
    let file = alone().open(path)?;
    #[cfg(unix)]
    if matches!(file.try_lock(), Err(std::fs::TryLockError::WouldBlock)) || !is_at(&file, path) {
        return Err(io::ErrorKind::ResourceBusy.into());
    }
    Ok(file)
}

/// Returns options for writing; on Windows, exclusively. A lock there would block readers too.
fn alone() -> OpenOptions {
    let mut options = File::options();
    options.write(true);
    #[cfg(windows)]
    {
        // FILE_SHARE_READ and FILE_SHARE_DELETE
        std::os::windows::fs::OpenOptionsExt::share_mode(&mut options, 1 | 4);
    }
    options
}

/// Whether a name still refers to an open file: the process that held its lock may have renamed it meanwhile.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |data: io::Result<std::fs::Metadata>| data.ok().map(|data| (data.dev(), data.ino()));
    let there = id(path.symlink_metadata());
    there.is_some() && there == id(file.metadata())
}
