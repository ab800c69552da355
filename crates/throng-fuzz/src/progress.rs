//! The progress of a worker, in a file that its driver can read even after the worker crashed.

use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;

/// The progress of a worker.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Progress {
    /// The number of the current or the next input.
    pub current: u64,
    /// Number of accepted inputs.
    pub accepted: u64,
    /// Number of rejected inputs.
    pub refused: u64,
    /// The longest processor time, microseconds, and its input.
    pub slowest: (u64, u64),
    /// The largest peak of memory, bytes, and its input.
    pub largest: (u64, u64),
}

impl Progress {
    /// Adds the progress of a later worker.
    pub fn add(&mut self, later: &Self) {
        self.current = later.current;
        self.accepted += later.accepted;
        self.refused += later.refused;
        self.slowest = self.slowest.max(later.slowest);
        self.largest = self.largest.max(later.largest);
    }

    /// Overwrites a file with the progress.
    pub fn write(&self, file: &mut File) -> io::Result<()> {
        let words =
            [self.current, self.accepted, self.refused, self.slowest.0, self.slowest.1, self.largest.0, self.largest.1];
        file.seek(SeekFrom::Start(0))?;
        file.write_all(&words.map(u64::to_le_bytes).concat())
    }

    /// Reads the progress from a file; the default if the file is missing or incomplete.
    pub fn read(path: &Path) -> Self {
        let bytes = std::fs::read(path).unwrap_or_default();
        let words: Vec<u64> = bytes.as_chunks().0.iter().map(|&word| u64::from_le_bytes(word)).collect();
        match words[..] {
            [current, accepted, refused, a, b, c, d] => {
                Self { current, accepted, refused, slowest: (a, b), largest: (c, d) }
            }
            _ => Self::default(),
        }
    }
}
