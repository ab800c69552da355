//! # throng: crowds and groups that never overlap, never get stuck and never tremble
//!
//! A [`World`] holds agents, obstacles and goals. [`World::step`] advances all agents by one time step, in five stages:
//! [perceive], intend ([navigate]), [avoid], [guard], and [motion].
//!
#![doc = concat!("```\n", include_str!("../examples/hello.rs"), "```")]
//!
//! The simple case needs no more than [`Agent::at`], [`Agent::goal`], [`World::add_agent`] and [`World::step`].
//! [`World::agents`] reads the result. A program that decides itself uses [`World::set_goal`],
//! [`World::set_preferred_velocity`] and [`World::set_position`]; [`World::events`] lists what happened in the last step. A
//! [`Group`] chooses the local model, the steering behaviour or the field of its agents.
//!
//! Units are metres, seconds and radians. Coordinates are right-handed with z up; ground crowds live in the plane z =
//! 0. A world stores positions in `f32`, relative to its own origin. Places that pass through [`World`] are `f64` in world
//! coordinates; [`Position`] states the rule for two and three dimensions. Fields, surfaces, behaviours and
//! [`World::relative_columns`] work in local coordinates: [`Settings::to_local`] and [`Settings::to_world`] convert.

pub mod agent;
pub mod avoid;
mod error;
pub mod field;
pub mod guard;
pub mod motion;
pub mod navigate;
mod parallel;
pub mod perceive;
mod position;
mod random;
mod rules;
mod simd;
pub mod space;
pub mod steer;
mod summary;
mod world;

pub use agent::{
    Agent, AgentId, Body, GoalId, Group, GroupId, Hindered, Hindrance, JourneyId, ObstacleId, ScriptId, Status,
};
pub use error::Error;
pub use navigate::{Goal, Journey, Keyframe, Script, Stop};
pub use position::Position;
pub use rules::Rules;
pub use space::{Obstacle, Walkable};
pub use summary::{Counts, Summary};
pub use world::{
    AgentRef, Agents, ConsideredAgent, Event, EventKind, Explanation, Settings, Stage, SubSteps, Trace, TraceRequest,
    World,
};
