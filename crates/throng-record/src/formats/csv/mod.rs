//! Trajectories as a table of comma-separated values.
//!
//! One line an agent and moment, moment after moment, under a line of names:
//!
//! | column | what | unit |
//! |---|---|---|
//! | `number` | the agent's own number | |
//! | `group` | the name of its group; its index where it has no name | |
//! | `time` | time since the start | s |
//! | `x`, `y` | centre, world coordinates | m |
//! | `vx`, `vy` | velocity | m/s |
//! | `heading` | direction of the body, counter-clockwise from +x | rad |
//! | `radius` | radius of the body; of one that is no disc, half of its narrower side | m |
//! | `status` | `walking`, `waiting`, `arrived` or `stranded` | |
//! | `z` | height of the centre above the ground | m |
//! | `vz` | velocity upwards | m/s |
//!
//! The last two are there only where somebody flies, or will ([`Setting::in_space`](crate::Setting::in_space)).
//!
//! Numbers are written with as many digits as it takes to read the same bits back. Text is UTF-8, quoted where it
//! holds commas, quotes or line breaks; lines end in a line feed. A name that a spreadsheet would take for a formula, as it
//! begins with `=`, `+`, `-`, `@`, a tab or a carriage return, is written with an apostrophe in front of it (`'=1+1`), and so
//! is a name that begins so after apostrophes. The apostrophe is taken off when the table is read.

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
    create: Some(|output, setting, columns| Ok(Box::new(CsvWriter::new(output, setting, columns)?))),
    read: Some(read::read),
    sniff: None,
};
