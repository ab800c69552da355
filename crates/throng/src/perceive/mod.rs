//! Stage 1, perception: the number of sub-steps, and the neighbour search. One grid answers the queries of all agents.

mod block;
mod cells;
mod grid;
mod lattice;
mod long_bodies;
mod nearest;
mod neighbours;
mod order;
mod perception;
mod simd_level;
mod sub_steps;
mod tile;

#[cfg_attr(not(feature = "internals"), doc(hidden))]
pub use grid::Grid;
pub use lattice::CellLattice;
pub(crate) use lattice::Extent;
use long_bodies::LongBodies;
#[cfg_attr(not(feature = "internals"), doc(hidden))]
pub use nearest::Near;
pub(crate) use neighbours::Neighbours;
pub(crate) use perception::{AvoidsAll, Nearby, Perceive, Perceived};
pub use simd_level::SimdLevel;
pub(crate) use sub_steps::SubStep;
pub(crate) use tile::{FEW_NEIGHBOURS, MOST_NEIGHBOURS, TileScratch};
