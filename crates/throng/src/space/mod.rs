//! Geometry: what is solid, what can be walked on, where the nearest wall is, surfaces and paths that steering asks.

mod cells;
mod pathway;
mod place;
mod raster;
mod rounded;
mod shape;
pub mod surface;
mod walls;

pub(crate) use cells::Cells;
pub use pathway::{OnPath, Pathway, Segment, Way};
pub use place::{Place, check_polygon, is_inside};
pub use raster::Raster;
pub use rounded::{Core, Separation};
pub use shape::{Obstacle, Walkable};
pub use walls::{Disc, Edge, NearWalls, Walls, nearest_on_outline, nearest_on_segment};
pub(crate) use walls::{Met, Wall};
