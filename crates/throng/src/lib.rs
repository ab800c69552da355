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
//! 0. Every place is in world coordinates; [`Position`] states the rule for two and three dimensions. Two kinds of places
//! are `f32`, which is exact to 1 mm within 10 km of an origin. The field, the behaviour and the surfaces of a group are
//! relative to [`Group::origin`], (0, 0) by default. [`World::relative_columns`] and [`World::relative_traces`] are
//! relative to [`Settings::origin`], near which a world keeps its agents; [`Settings::to_local`] and
//! [`Settings::to_world`] convert.
//!
//! # The interface on one page
//!
//! | to | calls of [`World`] |
//! |---|---|
//! | make a world | [`new`](World::new), [`set_simd_level`](World::set_simd_level), [`reserve`](World::reserve) |
//! | add what shapes the place | [`set_walkable`](World::set_walkable), [`add_obstacle`](World::add_obstacle), [`add_obstacles`](World::add_obstacles), [`set_obstacle`](World::set_obstacle), [`move_obstacle`](World::move_obstacle), [`remove_obstacle`](World::remove_obstacle), [`find_obstacle`](World::find_obstacle) |
//! | add agents | [`add_agent`](World::add_agent), [`schedule_agent`](World::schedule_agent), [`remove_agent`](World::remove_agent), [`replace`](World::replace), [`is_free`](World::is_free), [`no_room`](World::no_room) |
//! | say what groups do | [`add_group`](World::add_group), [`set_group`](World::set_group), [`set_guidance`](World::set_guidance), [`set_rules`](World::set_rules), [`notify`](World::notify) |
//! | send agents | [`set_goal`](World::set_goal), [`set_journey`](World::set_journey), [`add_goal`](World::add_goal), [`add_journey`](World::add_journey), [`add_choice`](World::add_choice), [`add_script`](World::add_script), [`face_ways`](World::face_ways) |
//! | decide for an agent | [`set_preferred_velocity`](World::set_preferred_velocity), [`set_position`](World::set_position), [`set_velocity`](World::set_velocity), [`set_user_data`](World::set_user_data), [`adjust`](World::adjust) |
//! | go on | [`step`](World::step), [`step_in_stages`](World::step_in_stages), [`finished`](World::finished), [`time`](World::time), [`steps`](World::steps) |
//! | read agents | [`agents`](World::agents), [`agent`](World::agent), [`agent_ids`](World::agent_ids), [`members`](World::members), [`position`](World::position), [`positions_into`](World::positions_into), [`events`](World::events), [`stranded`](World::stranded), [`overlapping`](World::overlapping) |
//! | read in bulk, by rows | [`relative_columns`](World::relative_columns), [`row`](World::row), [`id`](World::id), [`goal_of`](World::goal_of), [`hindrance`](World::hindrance), [`sort_rows`](World::sort_rows) |
//! | read what was given | [`settings`](World::settings), [`groups`](World::groups), [`group`](World::group), [`group_named`](World::group_named), [`adapted_field`](World::adapted_field), [`goals`](World::goals), [`journey`](World::journey), [`scripts`](World::scripts), [`place`](World::place), [`in_space`](World::in_space) |
//! | read results | [`summary`](World::summary), [`counts`](World::counts), [`figures`](World::figures), [`figure`](World::figure), [`standing`](World::standing), [`refused`](World::refused), [`draw`](World::draw) |
//! | see reasons | [`explain`](World::explain), [`explain_all`](World::explain_all), [`request_traces`](World::request_traces), [`relative_traces`](World::relative_traces) |
//! | keep a run | [`save`](World::save), [`load`](World::load), [`state_hash`](World::state_hash) |
//!
//! Several worlds, in threads or processes, can step one crowd together with the bits of one world: [halo].
//!
//! A program of its own extends the engine at four traits: [`LocalModel`](avoid::LocalModel),
//! [`Behaviour`](steer::Behaviour), [`Field`](field::Field) and [`Rules`]. The crates `throng-steer` and `throng-field`
//! are such extensions: they use nothing that a program cannot use, such as the helpers in [parallel], [simd] and
//! [random]. The parts of the stages that tests and benchmarks reach are documented with the feature `internals` only.

// the code that `#[parameters]` writes names this crate
extern crate self as throng;

pub mod agent;
pub mod avoid;
mod error;
pub mod field;
pub mod guard;
pub mod halo;
mod intend;
pub mod motion;
mod moving;
pub mod navigate;
pub mod parallel;
pub mod parameters;
pub mod perceive;
mod position;
pub mod random;
mod rules;
pub mod simd;
mod sleep;
pub mod space;
pub mod steer;
mod step;
mod summary;
mod world;

pub use agent::{
    Agent, AgentId, Body, GoalId, Group, GroupId, Hindered, Hindrance, JourneyId, ObstacleId, ScriptId, Status,
};
pub use error::Error;
pub use intend::{Trace, TraceRequest};
pub use navigate::{Goal, Journey, Keyframe, Script, Stop};
pub use position::Position;
pub use rules::Rules;
pub use space::{Obstacle, Walkable};
pub use step::Stage;
pub use summary::{Counts, Summary};
pub use world::{AgentRef, Agents, ConsideredAgent, Event, EventKind, Explanation, Settings, SubSteps, World};
