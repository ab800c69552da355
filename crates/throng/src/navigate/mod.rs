//! How do I get there: goals, journeys, the navigation mesh and the paths on it.

mod goal;

pub use goal::{Goal, Journey, Stop};
