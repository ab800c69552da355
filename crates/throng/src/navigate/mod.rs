//! How do I get there: goals, journeys, the navigation mesh and the paths on it.
//!
//! [`NavMesh::build`] turns ground and obstacles into the triangles that the centre of a disc may be in;
//! [`NavMesh::path`] finds shortest ways on them, and a [`Route`] keeps an agent on its way from step to step.

mod area;
mod bend;
mod bridges;
mod error;
mod fan;
mod goal;
mod inflate;
mod interval;
mod lattice;
mod legs;
mod locate;
mod mesh;
mod meshes;
mod outline;
mod passage;
mod path;
mod polyanya;
mod refuge;
mod route;
mod script;
mod standing;
mod sweep;
mod tangents;
mod travel;
mod tree;
mod triangulate;
mod visible;

pub use area::Area;
pub use error::{NavError, Ring, Unreachable};
pub use goal::{Goal, Journey, Stop};
pub(crate) use legs::{Leg, Legs};
pub use mesh::NavMesh;
pub(crate) use meshes::Asked;
pub use meshes::Meshes;
pub(crate) use meshes::nearest_on_ring;
pub(crate) use outline::union;
pub use path::Path;
pub use polyanya::Search;
pub(crate) use refuge::Refuge;
pub use route::{Heading, Route};
pub use script::{Keyframe, Script};
pub(crate) use standing::StandingPlaces;
pub use travel::{Standing, Travel, Turn};
