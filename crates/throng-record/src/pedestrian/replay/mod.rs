//! Recorded people once more, by a model: each enters where and when it was seen first, with its velocity there, and walks to where it was
//! seen last at its own speed, and stands on the way where and while it stood.
//!
//! [`Cast`] is who they are, [`Stage`] where and as whom they walk; a [`Replay`] lets them in and moves them on. [`Sample`] says how far
//! that is from what was recorded, beside two predictions that know nothing of others; [`Compared`], how both are distributed.
//! `docs/replay.md` defines the figures. Goals and pauses are known in advance, which no prediction of real people could know.

mod cast;
mod compare;
mod pause;
mod predict;
mod seen;
mod stage;
mod world;

pub use cast::{Cast, Pace, Walker};
pub use compare::{Compared, Pair, kolmogorov_smirnov};
pub use pause::Pause;
pub use predict::{PREDICTORS, Sample, from_entry, predict};
pub use seen::Seen;
pub use stage::Stage;
pub use world::{Replay, Replayed};
