//! Neighbour search: one grid over the agents answers the queries of all agents.

mod block;
mod cells;
mod grid;
mod lattice;
mod nearest;
mod simd_level;
mod tile;

#[cfg_attr(not(feature = "internals"), doc(hidden))]
pub use grid::Grid;
pub(crate) use lattice::CellLattice;
#[cfg_attr(not(feature = "internals"), doc(hidden))]
pub use nearest::Near;
pub use simd_level::SimdLevel;
pub(crate) use tile::{MOST_NEIGHBOURS, TileScratch};
