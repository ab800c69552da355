//! What happened in a world: its moments ([`Setting`], [`Frame`], [`Body`]) and the files that hold them.
//!
//! [`series`] makes figures over time of them, [`swarm`] those of a swarm, [`pedestrian`] those of people; [`formats`] are the files of
//! trajectories, [`Tracks`] what is read back; [`moment`] makes moments of the world of a scene. Every file is written through
//! [`Output`], under a temporary name until it is complete. [`Behind`] lets another thread write them.

mod behind;
mod capture;
mod flow;
pub mod formats;
mod frame;
mod map;
pub mod moment;
mod output;
pub mod pedestrian;
pub mod series;
pub mod swarm;
mod tracks;

pub use behind::{Behind, Pool};
pub use flow::Flow;
pub use formats::{Flaw, Format, Reading, Writer, csv};
pub use frame::{Body, Frame, Setting, Shell};
pub use map::map;
pub use output::{Hand, Output, OutputError};
pub use tracks::{Spot, Tracks, TracksError};
