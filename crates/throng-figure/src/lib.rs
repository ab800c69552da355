//! People on foot: from trajectories of agents to poses of a skeleton, with feet that do not slide.
//!
//! Footfalls are planned: a foot is put where the body *will be* and stays there until it is lifted. So turns, side
//! steps, steps backwards, starts, stops and queues need no cases of their own. [`Walk`] is a person on a recorded
//! trajectory: its future is known. [`Live`] follows an agent while it moves and extrapolates its motion. Both use the
//! same laws ([`gait`]). [`Mesh`] is a body for the [`Skeleton`], and [`measure`] says how far feet slide in any
//! motion. [`Character`] is a body of a file, with a skeleton of its own, that walks in the same way.
//!
//! Coordinates are metres, with z up; angles are radians. The same input gives the same bits on every machine.

mod character;
mod error;
pub mod gait;
mod live;
mod math;
pub mod measure;
mod mesh;
mod path;
mod person;
mod pose;
mod steps;
mod walk;

pub use character::{Character, CharacterError, RestBody};
pub use error::Error;
pub use live::Live;
pub use math::slerp;
pub use mesh::{LOOKS, Level, Look, Mesh, Region};
pub use path::Sample;
pub use person::{Build, Person, Side};
pub use pose::{JOINTS, Joint, Legs, Placed, Pose, Skeleton};
pub use steps::Plant;
pub use walk::{FASTEST, Walk};

/// The code of `docs/characters.md`, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/characters.md")]
struct Page;
