//! Who is near: neighbour search. A grid over the agents answers for all of them.

mod block;
mod grid;
mod nearest;
mod tile;

pub use grid::Grid;
pub use nearest::Near;
