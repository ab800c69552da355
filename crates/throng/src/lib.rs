//! # throng: crowds and groups that never overlap, never get stuck and never tremble
//!
//! A [`World`] holds agents, obstacles and goals; [`World::step`] moves everybody on by one time step, through five
//! stages: [perceive], intend ([navigate]), [avoid], [guard], and [motion].
//!
//! ```
//! use glam::DVec2;
//! use throng::{Agent, Goal, Journey, Settings, Stop, World};
//!
//! let mut world = World::new(Settings { step: 0.04, ..Settings::default() })?;
//! for x in [-4.0, 4.0] {
//!     let goal = world.add_goal(Goal::Point { at: DVec2::new(-x, 0.0), tolerance: 0.1 })?;
//!     let journey = world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false })?;
//!     world.add_agent(Agent { position: DVec2::new(x, 0.0), journey, ..Agent::default() })?;
//! }
//! while !world.finished() && world.time() < 20.0 {
//!     world.step();
//! }
//! assert_eq!(world.summary().arrived, 2);
//! assert!(world.summary().least_separation >= 0.9999);
//! # Ok::<(), throng::Error>(())
//! ```
//!
//! Metres, seconds, radians; right-handed, z up; ground crowds live in the plane z = 0. A world keeps positions
//! relative to an origin of its own in `f32`; everything handed to it or asked of it by id is in world coordinates.

pub mod agent;
pub mod avoid;
mod error;
pub mod field;
pub mod guard;
mod lanes;
pub mod motion;
pub mod navigate;
mod parallel;
pub mod perceive;
mod random;
mod rules;
pub mod space;
pub mod steer;
mod summary;
mod world;

pub use agent::{
    Agent, AgentId, Body, GoalId, Group, GroupId, Hindered, Hindrance, JourneyId, ObstacleId, ScriptId, Status,
};
pub use error::Error;
pub use navigate::{Goal, Journey, Keyframe, Script, Stop};
pub use rules::Rules;
pub use space::{Obstacle, Walkable};
pub use summary::{Counts, Summary};
pub use world::{Account, Asked, Explanation, Seen, Settings, Stage, SubSteps, World};
