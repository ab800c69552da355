//! Geometry: solid obstacles, walkable ground, walls, and the surfaces and paths that steering queries.

mod cells;
mod collision;
mod pathway;
mod place;
mod raster;
mod rounded;
mod segment;
mod shape;
pub mod surface;
mod wall_cells;
mod walls;

pub(crate) use cells::{Cells, Squares};
pub(crate) use collision::{is_between, times_to_discs};
pub use collision::{time_to_disc, time_to_segment};
pub use pathway::{OnPath, PathDirection, Pathway, Segment};
pub use place::{Place, check_polygon, is_inside};
pub use raster::Raster;
pub use rounded::{Core, CoreSeparation};
pub use segment::{crosses_line, crossing};
pub use shape::{Obstacle, Walkable};
pub(crate) use walls::VisitedWalls;
pub use walls::{Disc, Edge, NearWalls, Wall, Walls, nearest_on_outline, nearest_on_segment};
