//! Move: what a body can do. Acceleration and turn limits come before the [guard](crate::guard), headings after it.

mod heading;
mod limits;

pub(crate) use heading::wrap;
pub use heading::{faces, turn};
pub use limits::{Limits, limit};
