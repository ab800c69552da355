//! The files of a run, written while it proceeds: films and trajectories.

mod files;
mod pace;
mod recorder;

pub use files::{Files, Plan};
pub use pace::Pace;
pub use recorder::{Moment, Recorder};
