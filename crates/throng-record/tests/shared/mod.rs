//! Where the recorded trajectories of real people are.

use std::path::{Path, PathBuf};

/// A file or folder of the trajectories, if they are there.
pub fn data(name: &str) -> Option<PathBuf> {
    found(&format!("trajectories/{name}"))
}

/// A file or folder of the data, if it is there.
pub fn found(name: &str) -> Option<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let found = here.ancestors().map(|up| up.join("shared/data").join(name)).find(|path| path.exists());
    if found.is_none() {
        eprintln!("skipped: no shared/data/{name} above {}", here.display());
    }
    found
}
