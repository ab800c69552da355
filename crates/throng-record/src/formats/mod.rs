//! The kinds of files that hold trajectories: by the ending of a name, what writes them, and what reads them back.
//!
//! Where several kinds share an ending, the file itself says which it is.

mod archive;
#[cfg(any(feature = "glb", feature = "usda"))]
mod body;
mod columns;
pub mod csv;
#[cfg(any(feature = "glb", feature = "parquet", feature = "sqlite", feature = "usda"))]
mod describe;
#[cfg(feature = "glb")]
pub mod glb;
#[cfg(feature = "hdf5")]
mod hdf5;
pub mod keys;
#[cfg(any(feature = "glb", feature = "usda"))]
mod mesh;
#[cfg(any(feature = "glb", feature = "parquet", feature = "sqlite", feature = "usda"))]
mod names;
mod obsmat;
#[cfg(feature = "parquet")]
pub mod parquet;
#[cfg(any(feature = "glb", feature = "parquet", feature = "sqlite", feature = "usda"))]
mod place;
#[cfg(any(feature = "glb", feature = "parquet", feature = "sqlite", feature = "usda"))]
mod rate;
pub mod rec;
#[cfg(any(feature = "glb", feature = "usda"))]
mod spill;
#[cfg(feature = "sqlite")]
pub mod sqlite;
#[cfg(test)]
mod tests;
mod text;
#[cfg(feature = "usda")]
pub mod usda;
mod vadere;

pub use columns::Column;

use crate::tracks::Tracks;
use crate::{Frame, Output, OutputError, Setting};
use std::fmt;
use std::path::Path;

/// The program and its version, as files name it.
const PROGRAM: &str = concat!("throng ", env!("CARGO_PKG_VERSION"));

/// Every kind that there is.
pub const FORMATS: &[Format] = &[
    csv::FORMAT,
    #[cfg(feature = "parquet")]
    parquet::FORMAT,
    rec::FORMAT,
    #[cfg(feature = "sqlite")]
    sqlite::FORMAT,
    #[cfg(feature = "usda")]
    usda::FORMAT,
    #[cfg(feature = "glb")]
    glb::FORMAT,
    obsmat::FORMAT,
    archive::FORMAT,
    vadere::FORMAT,
    #[cfg(feature = "hdf5")]
    hdf5::FORMAT,
];

/// Writes trajectories, moment by moment. Dropped before it is finished, it leaves nothing, or what can be read
/// ([`Output::create_kept`]).
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

/// What makes a writer, of a table with these columns; none: its own.
type Create = fn(Output, &Setting, &[Column]) -> Result<Box<dyn Writer>, OutputError>;

/// What reads a file that is in memory.
type Read = fn(&[u8], &Reading) -> Result<Tracks, Flaw>;

/// What tells whether a file that is in memory is of a kind.
type Sniff = fn(&[u8]) -> bool;

/// A kind of file.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// How names of such files end, without the dot.
    pub ending: &'static str,
    /// What it is, for people.
    pub title: &'static str,
    /// Whether a file that is not complete can be read: it is called `NAME.part` until it is.
    kept: bool,
    /// Whether its columns can be chosen.
    columns: bool,
    create: Option<Create>,
    read: Option<Read>,
    /// Where another kind has the same ending: whether a file is of this one.
    sniff: Option<Sniff>,
}

/// What people say of a file; it goes before what the file says itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reading {
    /// Frames a second, where it counts frames; of a file of footsteps, at how many moments a second it is read.
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

impl fmt::Display for Flaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.why)
    }
}

impl std::error::Error for Flaw {}

impl Format {
    /// The kind of a file, by the ending of its name; `.part` behind that of a kind that can be read before it is complete does not
    /// count.
    pub fn of(path: impl AsRef<Path>) -> Option<&'static Self> {
        let path = path.as_ref();
        let extension = path.extension()?;
        let (extension, part) = match Path::new(path.file_stem()?).extension() {
            Some(inner) if extension == "part" => (inner, true),
            _ => (extension, false),
        };
        FORMATS.iter().find(|format| extension.eq_ignore_ascii_case(format.ending) && (format.kept || !part))
    }

    /// Begins a file of this kind, as a [`Choice`](crate::Choice) takes it.
    ///
    /// # Errors
    /// Those of [`Output::create`].
    pub fn output(&self, path: impl AsRef<Path>) -> Result<Output, OutputError> {
        if self.kept { Output::create_kept(path) } else { Output::create(path) }
    }

    /// The kind of a file that is in memory, by the ending of its name and by what is in it.
    pub fn of_file(path: impl AsRef<Path>, bytes: &[u8]) -> Option<&'static Self> {
        let first = Self::of(path)?;
        let alike = FORMATS.iter().filter(|format| format.ending == first.ending);
        let mut is = alike.filter(|format| format.sniff.is_none_or(|sniff| sniff(bytes)));
        is.next().or(Some(first))
    }

    pub(crate) fn reader(&self) -> Option<Read> {
        self.read
    }

    /// Whether such files are read.
    pub fn is_read(&self) -> bool {
        self.read.is_some()
    }

    /// Whether such files are written.
    pub fn is_written(&self) -> bool {
        self.create.is_some()
    }

    /// Whether such files are tables whose columns can be chosen.
    pub fn has_columns(&self) -> bool {
        self.columns
    }

    /// Begins such a file, a table with these columns (none: those it has by itself); `None` if they are only read.
    ///
    /// # Errors
    /// The system's, such as a full disk.
    pub(crate) fn create(
        &self,
        output: Output,
        setting: &Setting,
        columns: &[Column],
    ) -> Option<Result<Box<dyn Writer>, OutputError>> {
        self.create.map(|create| create(output, setting, columns))
    }
}
