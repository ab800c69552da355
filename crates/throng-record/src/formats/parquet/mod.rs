//! Trajectories as [Apache Parquet](https://parquet.apache.org): a table by columns, compressed, for data frames.
//!
//! One row an agent and moment, moment after moment, by number; no value is missing.
//!
//! | column | what | unit | type |
//! |---|---|---|---|
//! | `number` | the agent's own number | | 32 bits without sign |
//! | `group` | the name of its group; its index where it has no name | | text |
//! | `time` | time since the start | s | double |
//! | `x`, `y` | centre, world coordinates | m | double |
//! | `z` | height of the centre above the ground | m | single |
//! | `vx`, `vy`, `vz` | velocity | m/s | single |
//! | `heading` | direction of the body, counter-clockwise from +x | rad | single |
//! | `radius` | radius of the body; of one that is no disc, half of its narrower side | m | single |
//! | `status` | `walking`, `waiting`, `arrived` or `stranded` | | text |
//!
//! The file's metadata has the keys of [`keys`](super::keys). Numbers are kept to the bit. Rows come in groups of 131,072, which is what
//! is held in memory while a file is written.

mod read;
mod table;
mod write;

pub use write::ParquetWriter;

use super::Format;

/// Parquet: written and read.
pub(super) const FORMAT: Format = Format {
    ending: "parquet",
    title: "Apache Parquet",
    kept: false,
    sniff: None,
    columns: true,
    create: Some(|output, setting, columns| Ok(Box::new(ParquetWriter::new(output, setting, columns)?))),
    read: Some(read::read),
};
