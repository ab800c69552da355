//! Stage 2a, navigation: goals, journeys, the navigation mesh, the paths on it, and the progress of agents on them.
//!
//! [`NavMesh::build`] turns ground and obstacles into triangles of the ground that is free for the centre of a disc.
//! [`NavMesh::path`] finds shortest paths on them, and a [`Route`] guides an agent along its path from step to step.

mod area;
mod arrivals;
mod bend;
mod bridges;
mod choose;
mod error;
mod fan;
mod fill;
mod goal;
mod inflate;
mod interval;
mod lattice;
mod legs;
mod locate;
mod mesh;
mod meshes;
mod navigation;
mod neighbour_data;
mod outline;
mod outlook;
mod passage;
mod path;
mod planning;
mod planning_simd;
mod polyanya;
mod progress;
mod reached;
mod refuge;
mod route;
mod script;
mod standing;
mod sweep;
mod tangents;
mod tree;
mod triangulate;
mod visible;

pub use area::Area;
pub(crate) use arrivals::Arrivals;
pub use error::{NavError, Ring, Unreachable};
pub(crate) use fill::RETURN_TIME;
pub use goal::{Goal, Journey, Stop};
pub(crate) use legs::{Leg, Legs};
pub use mesh::NavMesh;
pub use meshes::Meshes;
pub(crate) use meshes::PathRequest;
pub(crate) use meshes::nearest_on_ring;
pub(crate) use navigation::Navigate;
pub(crate) use neighbour_data::{GOAL, NavFlags, NeighbourData, SAME_WAY, Surroundings, WALKS};
pub(crate) use outline::union;
pub use path::Path;
pub use polyanya::PathSearch;
pub use progress::{RouteProgress, Standing, Turn};
pub(crate) use refuge::Refuge;
pub use route::{Heading, Route};
pub use script::{Keyframe, Script};
pub(crate) use standing::StandingPlaces;
