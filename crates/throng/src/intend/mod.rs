//! Stage 2b, intention: the preferred velocities of all agents. They come from journeys, fields, steering behaviours and
//! the program. Interaction rules change them.

mod adapt;
mod agree;
mod crowd_ahead;
mod facing;
mod flock;
mod govern;
mod hindrance;
mod intention;
mod intention_simd;
mod look_ahead;
mod right_of_way;
mod standoff;
mod standoff_division;
mod steering;
mod steering_simd;
mod trace;
mod velocities;
mod walls_ahead;

pub(crate) use adapt::Adapted;
pub(crate) use agree::STANDOFF_REACH;
pub(crate) use facing::Facing;
pub(crate) use hindrance::ProgressCheck;
pub(crate) use intention::{Intend, Intended};
pub(crate) use right_of_way::{YIELD_AT_REST, YIELD_TO_FIRST};
pub(crate) use standoff::Standoff;
pub(crate) use steering::Planned;
pub use trace::{Trace, TraceRequest};
pub(crate) use velocities::{Rows, Velocities, set};
