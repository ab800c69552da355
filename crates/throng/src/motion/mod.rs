//! Move: what a body can do. Acceleration and turn limits come before the [guard](crate::guard), headings after it.

mod angle;
mod drive;
mod heading;
mod limits;

pub(crate) use angle::{angle, angles};
pub(crate) use drive::{follow, followable};
pub(crate) use heading::Turning;
pub(crate) use heading::wrap;
pub use heading::{faces, turn};
pub use limits::{Limits, limit};
