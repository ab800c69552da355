//! Stage 5, motion: agents move to where the guard finds no overlap.

mod flight_simd;
mod movement;
mod movement_simd;
mod wrap;

pub(crate) use movement::{Move, velocity};
