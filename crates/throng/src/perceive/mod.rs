//! Who is near: neighbour search. A grid over the agents answers for all of them.

mod block;
mod cells;
mod grid;
mod instructions;
mod lattice;
mod nearest;
mod tile;

pub use grid::Grid;
pub use instructions::Instructions;
pub(crate) use lattice::Lattice;
pub use nearest::Near;
pub(crate) use tile::{MOST_NEIGHBOURS, Pack};
