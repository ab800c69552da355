//! Fields that lead to goals round obstacles.

mod cover;
mod density;
mod destination;
mod limits;
mod links;
mod terrain;
mod to_goal;

pub use density::Density;
pub use destination::Destination;
pub use terrain::{Terrain, TerrainSettings};
pub use to_goal::ToGoal;
