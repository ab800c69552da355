//! Geometry: what is solid, what can be walked on.

mod shape;

pub use shape::{Obstacle, Walkable};
