//! `.rec`: what happened in few bytes, to be gone on with, and readable as far as it got.
//!
//! A file is a sequence of records, each with its length and its checksum: what stays the same, then the moments, and at the end
//! where which moment is. Every 64th moment stands by itself, those between say what has changed. All numbers are whole, in
//! steps small enough for every use:
//!
//! | what | step | error at most |
//! |---|---|---|
//! | places, radii | 0.1 mm | 0.05 mm |
//! | velocities | 1 mm/s | 0.5 mm/s |
//! | headings | 1/8192 of a turn | 0.39 mrad (0.022°) |
//! | times, numbers, groups, status | | none |
//!
//! Until it is complete it is called `NAME.rec.part`. What was written more than a second ago is there whatever happens to the program:
//! [`Tracks::read`](crate::Tracks::read) reads such a file up to its last whole record. A changed byte is found. The layout is in
//! `docs/rec.md`.

mod file;
mod frame;
mod pack;
mod read;
mod state;
mod write;

pub use read::{Contents, Key};
pub use write::{AppendError, RecWriter};

use super::Format;

/// Our own: written and read.
pub(super) const FORMAT: Format = Format {
    ending: "rec",
    title: "throng's own: few bytes, readable as far as it got",
    kept: true,
    sniff: None,
    columns: false,
    create: Some(|output, setting, _| Ok(Box::new(RecWriter::new(output, setting)?))),
    read: Some(read::read),
};
