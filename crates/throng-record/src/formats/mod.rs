//! The kinds of files that hold trajectories: by the ending of a name, what writes them, and what reads them back.

pub mod csv;

use crate::tracks::Tracks;
use crate::{Frame, Output, OutputError, Setting};
use std::path::Path;

/// Every kind that there is.
pub const FORMATS: &[Format] = &[csv::FORMAT];

/// Writes trajectories, moment by moment. Dropped before it is finished, it leaves nothing.
pub trait Writer: Send {
    /// Writes everybody of one moment, which is later than those before.
    ///
    /// # Errors
    /// The system's, such as a full disk.
    fn push(&mut self, frame: &Frame) -> Result<(), OutputError>;

    /// Gives the complete file its name.
    ///
    /// # Errors
    /// Those of [`Output::finish`].
    fn finish(self: Box<Self>) -> Result<(), OutputError>;
}

/// What makes a writer.
type Create = fn(Output, &Setting) -> Result<Box<dyn Writer>, OutputError>;

/// What reads a file that is in memory.
type Read = fn(&[u8], &Reading) -> Result<Tracks, Flaw>;

/// A kind of file.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// How names of such files end, without the dot.
    pub ending: &'static str,
    /// What it is, for people.
    pub title: &'static str,
    create: Option<Create>,
    read: Option<Read>,
}

/// What people say of a file that it does not say itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reading {
    /// Frames a second, where it counts frames.
    pub rate: Option<f64>,
    /// Metres in its unit of length.
    pub unit: Option<f64>,
}

/// What is wrong with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Flaw {
    /// The line it is on, from 1, where there are lines.
    pub line: Option<usize>,
    /// What it is.
    pub why: String,
    /// What to do about it.
    pub hint: Option<&'static str>,
}

impl Format {
    /// The kind of a file, by the ending of its name.
    pub fn of(path: impl AsRef<Path>) -> Option<&'static Self> {
        let extension = path.as_ref().extension()?;
        FORMATS.iter().find(|format| extension.eq_ignore_ascii_case(format.ending))
    }

    pub(crate) fn reader(&self) -> Option<Read> {
        self.read
    }

    /// Whether such files are written.
    pub fn is_written(&self) -> bool {
        self.create.is_some()
    }

    /// Begins such a file; `None` if they are only read.
    ///
    /// # Errors
    /// The system's, such as a full disk.
    pub fn create(&self, output: Output, setting: &Setting) -> Option<Result<Box<dyn Writer>, OutputError>> {
        self.create.map(|create| create(output, setting))
    }
}
