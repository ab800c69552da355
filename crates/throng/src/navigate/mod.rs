//! How do I get there: goals, journeys, the navigation mesh and the paths on it.

mod goal;
mod travel;
mod way;

pub use goal::{Goal, Journey, Stop};
pub use travel::Travel;
pub(crate) use travel::{Dice, turned_right};
pub use way::{Meshes, Route, Unreachable};
pub(crate) use way::{Way, plan};
