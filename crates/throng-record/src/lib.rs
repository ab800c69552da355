//! What happened in a world: its moments ([`Setting`], [`Frame`], [`Body`]) and the files that hold them.
//!
//! [`series`] makes figures over time of them, [`swarm`] those of a swarm, [`pedestrian`] those of people, which [`validate`] compares with experiments; [`formats`] are the files of
//! trajectories, [`Tracks`] what is read back, and [`Moments`] the same moment by moment; a [`Choice`] says what of it all is written;
//! [`moment`] makes moments of the world of a scene; [`color`] tells groups apart. Every file is written through
//! [`Output`], under a temporary name until it is complete. [`Behind`] lets another thread write them.

mod behind;
mod capture;
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
mod resample;
pub mod series;
pub mod swarm;
mod table;
mod tracks;
pub mod validate;

pub use behind::{Behind, Pool};
pub use choice::{Choice, ChoiceError};
pub use flow::Flow;
pub use formats::{Column, Flaw, Format, Reading, Writer, csv};
pub use frame::{Body, Frame, Setting, Shell};
pub use map::map;
pub use moments::Moments;
pub use output::{Hand, Output, OutputError};
pub use table::Table;
pub use tracks::{Spot, Tracks, TracksError};
