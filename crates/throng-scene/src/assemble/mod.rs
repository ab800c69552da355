//! Builds a world from a scene: checks, lays out, adds.

mod agents;
mod annulus;
mod check;
mod count;
mod expect;
mod flow;
mod goals;
mod ground;
mod intervene;
mod limits;
mod looks;
mod motor;
mod movers;
mod place;
mod plan;
mod rules;
mod size;
mod steer;
mod surface;
mod tune;
mod world;

pub use count::MAX_AGENTS;
pub use intervene::Interventions;
pub use limits::MAX_COORDINATE;
pub use plan::{Plan, PlannedAgent, PlannedField, PlannedJourney};
pub use world::{Built, BuiltGroup};

pub(crate) use ground::{has_room, solid_shape};
