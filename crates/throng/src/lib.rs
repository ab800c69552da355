//! throng

pub mod agent;
pub mod avoid;
pub mod navigate;
pub mod space;
mod world;

pub use agent::{Agent, AgentId, GoalId, Group, GroupId, JourneyId, ObstacleId, Status};
pub use navigate::{Goal, Journey, Stop};
pub use space::{Obstacle, Walkable};
pub use world::{Settings, SubSteps, World};

/// What can be wrong with what a world is given.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A number is out of its limits.
    #[error("{what} is {value}, but must be {limit}")]
    Limit {
        /// Which number.
        what: &'static str,
        /// What it was.
        value: f64,
        /// What it may be.
        limit: &'static str,
    },
}
