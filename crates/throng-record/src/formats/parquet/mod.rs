//! Trajectories as [Apache Parquet](https://parquet.apache.org): a compressed columnar table, for data frames.
//!
//! A row holds an agent at a frame. Rows are sorted by frame, then by number. No value is missing.
//!
//! | column | what | unit | type |
//! |---|---|---|---|
//! | `number` | agent number | | 32 bits without sign |
//! | `group` | name of the group; its index if the group has no name | | text |
//! | `time` | time since the start | s | double |
//! | `x`, `y` | centre, world coordinates | m | double |
//! | `z` | height of the centre above the ground | m | single |
//! | `vx`, `vy`, `vz` | velocity | m/s | single |
//! | `heading` | direction of the body, counter-clockwise from +x | rad | single |
//! | `radius` | radius of the body; for bodies other than discs, half of the narrower side | m | single |
//! | `status` | `walking`, `waiting`, `arrived` or `stranded` | | text |
//!
//! The file's metadata has the keys of [`keys`](super::keys). Numbers are stored exactly. Row groups have 131,072 rows;
//! a single row group is held in memory while a file is written.

mod read;
mod table;
mod write;

pub(crate) use table::write_results;
pub use write::ParquetWriter;

use super::Format;

/// Parquet: written and read.
pub(super) const FORMAT: Format = Format {
    ending: "parquet",
    title: "Apache Parquet",
    kept: false,
    sniff: None,
    columns: true,
    styles: &[],
    create: Some(|output, setting, choice| Ok(Box::new(ParquetWriter::new(output, setting, &choice.columns)?))),
    read: Some(read::read),
    figures: None,
};
