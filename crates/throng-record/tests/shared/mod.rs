//! Where the recorded trajectories of real people are.

use std::path::{Path, PathBuf};

/// A file of the trajectories, if they are there.
pub fn data(name: &str) -> Option<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let found = here.ancestors().map(|up| up.join("shared/data/trajectories").join(name)).find(|path| path.is_file());
    if found.is_none() {
        eprintln!("skipped: no shared/data/trajectories/{name} above {}", here.display());
    }
    found
}
