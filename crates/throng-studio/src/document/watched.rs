//! A file that somebody else may write, an editor for one.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

/// How often it is looked at.
const PERIOD: Duration = Duration::from_millis(300);

/// Tells when a file has changed, by its time of modification.
#[derive(Clone, Debug)]
pub struct Watched {
    path: PathBuf,
    seen: Option<SystemTime>,
    looked: Instant,
}

impl Watched {
    /// Watches a file from now on.
    pub fn new(path: &Path) -> Self {
        Self { path: path.to_owned(), seen: modified(path), looked: Instant::now() }
    }

    /// The text it has now, if it has changed since it was last looked at.
    pub fn changed(&mut self) -> Option<String> {
        if self.looked.elapsed() < PERIOD {
            return None;
        }
        self.looked = Instant::now();
        let modified = modified(&self.path);
        // while an editor replaces the file there may be none
        if modified.is_none() || modified == self.seen {
            return None;
        }
        let text = std::fs::read_to_string(&self.path).ok()?;
        self.seen = modified;
        Some(text)
    }

    /// What the file holds now is known.
    pub fn know(&mut self) {
        self.seen = modified(&self.path);
    }
}

fn modified(path: &Path) -> Option<SystemTime> {
    std::fs::metadata(path).and_then(|file| file.modified()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_somebody_else_writes_is_seen_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.toml");
        std::fs::write(&path, "one").unwrap();
        let mut watched = Watched::new(&path);
        std::thread::sleep(PERIOD);
        assert_eq!(watched.changed(), None);
        std::fs::write(&path, "two").unwrap();
        std::thread::sleep(PERIOD);
        assert_eq!(watched.changed().as_deref(), Some("two"));
        std::thread::sleep(PERIOD);
        assert_eq!(watched.changed(), None);
        std::fs::remove_file(&path).unwrap();
        std::thread::sleep(PERIOD);
        assert_eq!(watched.changed(), None);
    }
}
