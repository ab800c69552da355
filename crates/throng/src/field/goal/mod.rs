//! Fields that lead to goals round everything that is in the way.

mod cover;
mod density;
mod destination;
mod limits;
mod links;
mod terrain;
mod to_goal;

pub use density::Density;
pub use destination::Destination;
pub use terrain::{Survey, Terrain};
pub use to_goal::ToGoal;
