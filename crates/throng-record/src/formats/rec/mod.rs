//! `.rec`: compact recordings that can be appended to and read up to where they end.
//!
//! A file is a sequence of records, each with its length and its checksum: first the constant data, then the frames,
//! and at the end the positions of key frames. Every 64th frame is a key frame; the frames between store changes. All
//! numbers are whole multiples of a step:
//!
//! | what | step | greatest error |
//! |---|---|---|
//! | positions, radii | 0.1 mm | 0.05 mm |
//! | velocities | 1 mm/s | 0.5 mm/s |
//! | headings | 1/8192 of a turn | 0.39 mrad (0.022°) |
//! | times, numbers, groups, status | | none |
//!
//! Until it is complete, a file is called `NAME.rec.part`. Frames written more than a second ago survive a crash of the
//! program: [`Trajectories::read`](crate::Trajectories::read) reads such a file up to its last complete record. Changed bytes are
//! detected. `docs/rec.md` describes the layout.

mod file;
mod frame;
mod pack;
mod read;
mod state;
mod write;

pub use read::{Contents, Key};
pub use write::{AppendError, RecWriter};

use super::Format;

/// The format of throng: written and read.
pub(super) const FORMAT: Format = Format {
    ending: "rec",
    title: "throng's own: few bytes, readable as far as it got",
    kept: true,
    sniff: None,
    columns: false,
    styles: &[],
    create: Some(|output, setting, _| Ok(Box::new(RecWriter::new(output, setting)?))),
    read: Some(read::read),
    figures: None,
};
