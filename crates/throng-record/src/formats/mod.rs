//! The formats of trajectory files: their endings, writers and readers.
//!
//! If several formats share an ending, the content of the file decides.

mod archive;
#[cfg(any(feature = "glb", feature = "usda"))]
mod body;
#[cfg(feature = "bvh")]
pub mod bvh;
#[cfg(any(feature = "bvh", feature = "glb", feature = "usda"))]
mod by_agent;
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
mod names;
mod obsmat;
#[cfg(feature = "parquet")]
pub mod parquet;
pub(crate) mod parts;
#[cfg(any(feature = "glb", feature = "parquet", feature = "sqlite", feature = "usda"))]
mod place;
#[cfg(any(feature = "bvh", feature = "glb", feature = "parquet", feature = "sqlite", feature = "usda"))]
mod rate;
pub mod rec;
#[cfg(any(feature = "bvh", feature = "glb", feature = "usda"))]
pub(crate) mod spill;
#[cfg(feature = "sqlite")]
pub mod sqlite;
#[cfg(test)]
mod tests;
mod text;
#[cfg(feature = "usda")]
pub mod usda;
mod vadere;

pub use columns::Column;

use crate::people::{FigureStyle, Figures};
use crate::trajectories::Trajectories;
use crate::{Choice, Frame, Output, OutputError, Setting};
use std::fmt;
use std::path::Path;

/// The program and its version, as written to files.
const PROGRAM: &str = concat!("throng ", env!("CARGO_PKG_VERSION"));

/// All formats.
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
    #[cfg(feature = "bvh")]
    bvh::FORMAT,
    obsmat::FORMAT,
    archive::FORMAT,
    vadere::FORMAT,
    #[cfg(feature = "hdf5")]
    hdf5::FORMAT,
];

/// Writes trajectories, frame by frame. A writer that is dropped before it is finished leaves no file, or a readable
/// part ([`Output::create_kept`]).
pub trait Writer: Send {
    /// Writes the agents of a frame, which is later than the frames before.
    ///
    /// # Errors
    /// A system error, such as a full disk.
    fn push(&mut self, frame: &Frame) -> Result<(), OutputError>;

    /// Gives the complete file its name.
    ///
    /// # Errors
    /// The errors of [`Output::finish`].
    fn finish(self: Box<Self>) -> Result<(), OutputError>;
}

/// Creates a writer, of a table with the columns of the choice (without columns, the default ones), or of people in its
/// style.
type Create = fn(Output, &Setting, &Choice) -> Result<Box<dyn Writer>, OutputError>;

/// Reads a file in memory.
type Read = fn(&[u8], &Reading) -> Result<Trajectories, FormatFlaw>;

/// Reads the people of a file in memory.
type ReadFigures = fn(&[u8]) -> Result<Figures, FormatFlaw>;

/// Whether a file in memory has a format.
type Sniff = fn(&[u8]) -> bool;

/// A file format.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// Ending of file names, without the dot.
    pub ending: &'static str,
    /// Name of the format for users.
    pub title: &'static str,
    /// Whether incomplete files can be read. Such a file is called `NAME.part` until it is complete.
    kept: bool,
    /// Whether its columns can be chosen.
    columns: bool,
    /// How people can be written; empty if the format has no figures.
    styles: &'static [FigureStyle],
    create: Option<Create>,
    read: Option<Read>,
    figures: Option<ReadFigures>,
    /// For formats that share an ending: whether a file has this format.
    sniff: Option<Sniff>,
}

/// Properties of a file that the user states; they take precedence over those in the file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reading {
    /// Frames per second, if the file counts frames; for a file of footsteps, the number of samples per second.
    pub rate: Option<f64>,
    /// The unit of length, metres.
    pub unit: Option<f64>,
}

/// An error in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormatFlaw {
    /// The line of the error, from 1, if the file has lines.
    pub line: Option<usize>,
    /// The description of the error.
    pub why: String,
    /// How to fix it.
    pub hint: Option<&'static str>,
}

impl fmt::Display for FormatFlaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&throng_scene::abridged(&self.why))
    }
}

impl std::error::Error for FormatFlaw {}

impl Format {
    /// Returns the format of a file by the ending of its name. `.part` is ignored after the ending of a format that
    /// allows incomplete files to be read.
    pub fn of(path: impl AsRef<Path>) -> Option<&'static Self> {
        let path = path.as_ref();
        let extension = path.extension()?;
        let (extension, part) = match Path::new(path.file_stem()?).extension() {
            Some(inner) if extension == "part" => (inner, true),
            _ => (extension, false),
        };
        FORMATS.iter().find(|format| extension.eq_ignore_ascii_case(format.ending) && (format.kept || !part))
    }

    /// Starts a file of this format, as a [`Choice`] requires.
    ///
    /// # Errors
    /// The errors of [`Output::create`].
    pub fn output(&self, path: impl AsRef<Path>) -> Result<Output, OutputError> {
        if self.kept { Output::create_kept(path) } else { Output::create(path) }
    }

    /// Returns the format of a file in memory, by the ending of its name and by its content.
    pub fn of_file(path: impl AsRef<Path>, bytes: &[u8]) -> Option<&'static Self> {
        let first = Self::of(path)?;
        let alike = FORMATS.iter().filter(|format| format.ending == first.ending);
        let mut is = alike.filter(|format| format.sniff.is_none_or(|sniff| sniff(bytes)));
        is.next().or(Some(first))
    }

    pub(crate) fn reader(&self) -> Option<Read> {
        self.read
    }

    /// Whether the format can be read.
    pub fn is_read(&self) -> bool {
        self.read.is_some()
    }

    /// Whether the format can be written.
    pub fn is_written(&self) -> bool {
        self.create.is_some()
    }

    /// Whether the format is a table with columns that can be chosen.
    pub fn has_columns(&self) -> bool {
        self.columns
    }

    /// The styles in which people can be written; empty if the format has no figures.
    pub fn figure_styles(&self) -> &'static [FigureStyle] {
        self.styles
    }

    pub(crate) fn figures(&self) -> Option<ReadFigures> {
        self.figures
    }

    /// Starts a file as a choice requires. Returns `None` if the format can only be read.
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub(crate) fn create(
        &self,
        output: Output,
        setting: &Setting,
        choice: &Choice,
    ) -> Option<Result<Box<dyn Writer>, OutputError>> {
        self.create.map(|create| create(output, setting, choice))
    }
}
