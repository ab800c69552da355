//! The files of a run, which grow while it goes on: films and tables of trajectories.

mod files;
mod pace;
mod recorder;

pub use files::{Files, Plan};
pub use pace::Pace;
pub use recorder::{Moment, Recorder};
