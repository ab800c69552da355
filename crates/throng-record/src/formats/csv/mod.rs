//! Trajectories as a table of comma-separated values.
//!
//! A line of names comes first. Every further line holds an agent at a frame; lines are sorted by frame.
//!
//! | column | what | unit |
//! |---|---|---|
//! | `number` | agent number | |
//! | `group` | name of the group; its index if the group has no name | |
//! | `time` | time since the start | s |
//! | `x`, `y` | centre, world coordinates | m |
//! | `vx`, `vy` | velocity | m/s |
//! | `heading` | direction of the body, counter-clockwise from +x | rad |
//! | `radius` | radius of the body; for bodies other than discs, half of the narrower side | m |
//! | `status` | `walking`, `waiting`, `arrived` or `stranded` | |
//! | `z` | height of the centre above the ground | m |
//! | `vz` | velocity upwards | m/s |
//!
//! The last two columns are written only in scenes with flying agents
//! ([`Setting::in_space`](crate::Setting::in_space)).
//!
//! Numbers are written with as many digits as it takes to read the same bits back. Text is UTF-8, quoted if it contains
//! commas, quotes or line breaks; lines end in a line feed. A spreadsheet takes a name that begins with `=`, `+`, `-`,
//! `@`, a tab or a carriage return for a formula. Such a name is written with an apostrophe before it (`'=1+1`), and so
//! is a name that begins with apostrophes followed by such a character. The reader removes the apostrophe.

mod read;
mod write;

#[cfg(feature = "parquet")]
pub(super) use write::status_of;
pub use write::{CsvWriter, status_name};

use super::Format;

/// A table: written and read.
pub(super) const FORMAT: Format = Format {
    ending: "csv",
    title: "a table of comma-separated values",
    kept: false,
    columns: true,
    styles: &[],
    create: Some(|output, setting, choice| Ok(Box::new(CsvWriter::new(output, setting, &choice.columns)?))),
    read: Some(read::read),
    figures: None,
    sniff: None,
};
