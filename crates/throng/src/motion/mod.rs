//! Motion of bodies. Limits of acceleration and turning apply before the [guard](crate::guard), headings after it.
//! [`Vehicle`] is the body that [steering behaviours](crate::steer) control.

mod angle;
mod drive;
mod heading;
mod limits;
mod motor;
mod vehicle;
mod wrap_around;

pub use angle::angle;
pub(crate) use angle::angles;
pub(crate) use drive::{follow, followable};
pub(crate) use heading::Turning;
pub(crate) use heading::wrap;
pub use heading::{faces, turn};
pub use limits::{Limits, limit};
pub use motor::{Holonomic, Motor, TwoWheels};
pub use vehicle::{
    Attitude, Basis, Forces, Integrator, Locomotion, Motion, Steering, Vehicle, angle_between, turned, turned_towards,
};
pub(crate) use vehicle::{Attitudes, Motions, Stepping, part_in};
pub use wrap_around::WrapAround;
