//! The laws of walking and running: numbers from speed, length of the leg and phase.
//!
//! Source, where no other is named: Boulic, Magnenat-Thalmann, Thalmann, "A global human walking model with real-time
//! kinematic personification", The Visual Computer 6, 1990. *Relative speed* is the speed in lengths of the leg per
//! second. The *phase* counts cycles of two steps: the left foot strikes the ground at whole numbers, the right foot at
//! halves.

mod curves;
mod timing;

pub(crate) use curves::{
    elbow, lateral, pelvis_list, pelvis_tilt, pelvis_yaw, running_vertical, shoulder, thorax_yaw, vertical,
};
pub use timing::{Cycle, FASTEST_TURN, cycle, cycle_duration, duty, running_cycle, running_duty, step_width};
pub(crate) use timing::{RUN_FROM, RUN_TO};
