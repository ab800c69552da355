//! Files that one process at a time writes under a name that all processes know.

use std::fs::{File, OpenOptions};
use std::io;
use std::path::Path;

/// Opens a file as [`claim`] does, after creating it where it does not exist.
pub(super) fn claim_new(path: &Path) -> io::Result<File> {
    match File::create_new(path) {
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => Err(error),
        _ => claim(path),
    }
}

/// Opens a file to write it, as the only process until the file is closed. Its content stays.
///
/// # Errors
/// [`io::ErrorKind::ResourceBusy`]: another process writes it. It is a link or no ordinary file.
pub(super) fn claim(path: &Path) -> io::Result<File> {
    if !path.symlink_metadata()?.is_file() {
        let why = format!("{} is a link or no ordinary file; remove it, or name another file", path.display());
        return Err(io::Error::other(why));
    }
    let file = alone().open(path)?;
    #[cfg(unix)]
    if matches!(file.try_lock(), Err(std::fs::TryLockError::WouldBlock)) || !is_at(&file, path) {
        return Err(io::ErrorKind::ResourceBusy.into());
    }
    Ok(file)
}

/// Writes; on Windows, as the only process. A lock there would keep readers out too.
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

/// Whether a name still means an open file: the process that held its lock may have renamed it meanwhile.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |data: io::Result<std::fs::Metadata>| data.ok().map(|data| (data.dev(), data.ino()));
    let there = id(path.symlink_metadata());
    there.is_some() && there == id(file.metadata())
}
