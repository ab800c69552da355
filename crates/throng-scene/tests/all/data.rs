//! The files of other projects in the repository.

use std::path::PathBuf;

/// Returns the path of a file or folder of `tests/data`.
pub fn data(name: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "tests", "data", name].iter().collect()
}
