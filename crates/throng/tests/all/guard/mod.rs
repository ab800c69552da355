//! The guard: its guarantee, in the plane and in space, and its results, which are kept.

mod kept;
mod plane;
mod space;
