//! Watching a file that another program may write, such as an editor.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

/// The interval of the checks.
const PERIOD: Duration = Duration::from_millis(300);

/// Reports changes of a file, by its modification time.
#[derive(Clone, Debug)]
pub struct Watched {
    path: PathBuf,
    seen: Option<SystemTime>,
    looked: Instant,
}

impl Watched {
    /// Starts to watch a file.
    pub fn new(path: &Path) -> Self {
        Self { path: path.to_owned(), seen: modified(path), looked: Instant::now() }
    }

    /// Returns the text of the file if it has changed since the last check.
    pub fn changed(&mut self) -> Option<String> {
        if self.looked.elapsed() < PERIOD {
            return None;
        }
        self.looked = Instant::now();
        let modified = modified(&self.path);
        // while an editor replaces the file, it may be missing
        if modified.is_none() || modified == self.seen {
            return None;
        }
        let text = std::fs::read_to_string(&self.path).ok()?;
        self.seen = modified;
        Some(text)
    }

    /// Marks the current content as known.
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
    fn a_change_by_another_program_is_seen_once() {
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
