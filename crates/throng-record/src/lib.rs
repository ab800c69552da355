//! Recordings of a world: its frames ([`Setting`], [`Frame`], [`Body`]) and the files that hold them.
//!
//! [`series`] computes figures over time, [`swarm`] those of a swarm, [`pedestrian`] those of pedestrians, which
//! [`validate`] compares with experiments. [`formats`] are the formats of trajectory files, [`Trajectories`] the trajectories
//! of a file, and [`Moments`] the same grouped by time. A [`Choice`] selects what is written. [`moment`] makes frames
//! of a scene's world. [`color`] distinguishes groups. Every file is written through [`Output`], under a temporary name
//! until it is complete. [`BackgroundWriter`] writes in the background.

mod background;
mod capture;
mod cell;
mod choice;
pub mod color;
mod consistency;
#[cfg(test)]
mod draws;
mod flow;
pub mod formats;
mod frame;
mod limits;
mod map;
pub mod moment;
mod moments;
mod output;
pub mod pedestrian;
pub mod people;
mod resample;
pub mod series;
mod set;
mod summary_cells;
pub mod swarm;
pub mod sweep;
mod table;
mod trajectories;
pub mod validate;

pub use background::{BackgroundWriter, Pool};
pub use cell::Cell;
pub use choice::{Choice, ChoiceError};
pub use flow::Flow;
pub use formats::{Column, Format, FormatFlaw, Reading, Writer, csv};
pub use frame::{AdaptedField, Body, Frame, Setting, Shell};
pub use map::map;
pub use moments::Moments;
pub use output::{Hand, Output, OutputError};
pub use set::SetMesh;
pub use summary_cells::summary_cells;
pub use table::Table;
pub use trajectories::{Sample, Trajectories, TrajectoriesError};
