//! Inputs as files, for readers that open files.

use std::path::Path;
use tempfile::TempDir;

/// Calls a reader with an input as a file of this name, in a temporary folder.
pub(super) fn file<T>(name: &str, bytes: &[u8], read: impl FnOnce(&Path) -> T) -> T {
    thread_local! {
        static FOLDER: TempDir = tempfile::tempdir().expect("a temporary folder");
    }
    FOLDER.with(|folder| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("a file in the temporary folder");
        read(&path)
    })
}
