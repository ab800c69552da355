//! Move: what a body can do. Acceleration and turn limits come before the [guard](crate::guard), headings after it.

mod heading;
mod limits;

pub use heading::{faces, turn};
pub use limits::{Limits, limit};
