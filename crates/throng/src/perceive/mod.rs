//! Who is near.

mod grid;

pub use grid::{Grid, Near};
