//! Replays of recorded pedestrians by a model. Each pedestrian enters at its first recorded position and time, with its
//! velocity there. It walks to its last recorded position at its own speed, and stands where and while it stood in the
//! recording.
//!
//! [`RecordedPeople`] holds the pedestrians, [`ReplayScene`] the place and their model. A [`Replay`] adds and moves them. A [`PredictionSample`]
//! is the displacement from the recording, also for two predictions that ignore other pedestrians. [`Compared`]
//! compares the distributions. `docs/replay.md` defines the figures. Goals and pauses are known in advance, which no
//! true prediction could know.

mod compare;
mod pause;
mod predict;
mod recorded;
mod scene;
mod seen;
mod world;

pub use compare::{Compared, Pair, kolmogorov_smirnov};
pub use pause::Pause;
pub use predict::{PREDICTORS, PredictionSample, from_entry, predict};
pub use recorded::{Pace, RecordedPeople, Walker};
pub use scene::ReplayScene;
pub use seen::Seen;
pub use world::{Replay, Replayed};
