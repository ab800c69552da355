//! Agents: what is known of each, and how they are named.
//!
//! [`Agent`] describes one agent for [`World::add_agent`](crate::World::add_agent); inside the world the same
//! facts live as [columns](Columns). [`Group`] holds what many agents share: the local model and its reach.

mod body;
mod column;
mod columns;
mod cycles;
mod group;
mod hindrance;
mod id;
mod memory;
mod trip;

pub use body::Body;
pub use column::{Column, Value};
pub use columns::Columns;
pub(crate) use cycles::Cycles;
pub use group::Group;
pub use hindrance::{Hindered, Hindrance, ProgressMark};
pub use id::{AgentId, GoalId, GroupId, JourneyId, ObstacleId, ScriptId};
pub use memory::Memory;
pub use trip::Trip;

use crate::Error;
use glam::{DVec2, Vec2};
use serde::{Deserialize, Serialize};

/// One agent, as handed to [`World::add_agent`](crate::World::add_agent).
///
/// Lengths are metres, times seconds, angles radians.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Agent {
    /// Centre of the body, world coordinates.
    pub position: DVec2,
    /// Height of the centre above the ground; more than 0 for those who fly. Limit: 0 to 20000.
    pub altitude: f32,
    /// Velocity at the start, along the ground.
    pub velocity: Vec2,
    /// Direction of the body, counter-clockwise from +x; `None`: towards the first goal.
    pub heading: Option<f32>,
    /// The group whose model and reach it uses.
    pub group: GroupId,
    /// Where it goes.
    pub journey: JourneyId,
    /// A script that it follows instead of a journey: it moves whatever its group's model says, and no faster than
    /// `max_speed`.
    pub script: Option<ScriptId>,
    /// Radius of the body, or of its rounding if it is no disc ([`Body`]). Limit: 0.001 to 1000.
    pub radius: f32,
    /// Half extents of the core of the body ([`Body`]), along and across the heading; zero for a disc. Limit: 0 to 1000.
    pub core: Vec2,
    /// Speed it walks at when nothing hinders it. Limit: >= 0.
    pub preferred_speed: f32,
    /// Speed it never exceeds. Limit: >= preferred_speed.
    pub max_speed: f32,
    /// Greatest change of velocity a second; infinite for none. Limit: > 0.
    pub max_acceleration: f32,
    /// Greatest change of heading a second; infinite for none. The ends of a body that is no disc turn no faster than
    /// `preferred_speed` besides. Limit: > 0.
    pub max_turn_rate: f32,
    /// Time gap, seconds: an agent that looks ahead walks no faster than the gap to the agent ahead divided by it. People in
    /// single file need 0.36 m and 1.06 s of their speed each (Seyfried et al. 2005); bodies 0.26 m deep are as far apart with
    /// 1.15 s at 1 m/s. Limit: 0.05 to 10.
    pub time_gap: f32,
    /// How far beside the straight way to what it chose the body may get while it turns, metres; 0 for one that moves
    /// in any direction at once, as people do. More is a robot on two wheels (Alonso-Mora et al. 2010), which needs a
    /// finite `max_turn_rate`; it and all others take it to be larger by so much. Limit: 0 to 10.
    pub tracking_error: f32,
    /// Right of way: of two agents the one with the lower priority does more of the avoiding. Equal shares by
    /// default; a difference of 1 leaves all of it to the other.
    pub priority: f32,
    /// How much the field of its group has to say: the group's ratio is multiplied by it. Limit: 0 to 1.
    pub governed: f32,
    /// The layers this agent is on, a bit each.
    pub layers: u32,
    /// The layers this agent avoids, a bit each.
    pub avoids: u32,
    /// A name for the agent that is its own: ties are broken, random numbers drawn and states hashed by it, so
    /// that a world does not depend on the order in which agents are added. `None`: the next free number. Limit:
    /// less than 4294967295.
    pub number: Option<u32>,
}

impl Agent {
    /// Whether a world can have it, wherever it is.
    pub(crate) fn check(&self) -> Result<(), Error> {
        Error::unless_finite("velocity", f64::from(self.velocity.x + self.velocity.y))?;
        Error::unless_finite("heading", f64::from(self.heading.unwrap_or(0.0)))?;
        Error::unless(self.radius >= 1e-3 && self.radius <= 1e3, "radius", self.radius, "from 0.001 to 1000 m")?;
        for half in [self.core.x, self.core.y] {
            Error::unless((0.0..=1e3).contains(&half), "half extent of the core", half, "from 0 to 1000 m")?;
        }
        let limit = "at least 0 m/s and at most 1000 m/s";
        Error::unless((0.0..=1e3).contains(&self.preferred_speed), "preferred speed", self.preferred_speed, limit)?;
        Error::unless(
            self.max_speed >= self.preferred_speed && self.max_speed <= 1e3,
            "max speed",
            self.max_speed,
            "at least the preferred speed and at most 1000 m/s",
        )?;
        Error::unless(self.max_acceleration > 0.0, "max acceleration", self.max_acceleration, "greater than 0")?;
        Error::unless(self.max_turn_rate > 0.0, "max turn rate", self.max_turn_rate, "greater than 0")?;
        Error::unless((0.05..=10.0).contains(&self.time_gap), "time gap", self.time_gap, "from 0.05 to 10 s")?;
        let error = self.tracking_error;
        Error::unless((0.0..=10.0).contains(&error), "tracking error", error, "from 0 to 10 m")?;
        let turns = error == 0.0 || self.max_turn_rate.is_finite();
        Error::unless(turns, "max turn rate", self.max_turn_rate, "finite where there is a tracking error")?;
        Error::unless_finite("priority", f64::from(self.priority))?;
        Error::unless((0.0..=1.0).contains(&self.governed), "governed", self.governed, "from 0 to 1")
    }
}

impl Default for Agent {
    /// A pedestrian of the field's usual size and speed, standing at the origin.
    fn default() -> Self {
        Self {
            position: DVec2::ZERO,
            altitude: 0.0,
            velocity: Vec2::ZERO,
            heading: None,
            group: GroupId(0),
            journey: JourneyId::STAY,
            script: None,
            radius: 0.13,
            core: Vec2::ZERO,
            preferred_speed: 1.3,
            max_speed: 1.8,
            max_acceleration: 5.0,
            max_turn_rate: f32::INFINITY,
            time_gap: 1.15,
            tracking_error: 0.0,
            priority: 0.0,
            governed: 1.0,
            layers: 1,
            avoids: u32::MAX,
            number: None,
        }
    }
}

/// What an agent is doing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Status {
    /// On its way.
    #[default]
    Walking,
    /// Waiting at a stop of its journey.
    Waiting,
    /// At the end of its journey.
    Arrived,
    /// Its goal cannot be reached; it stands.
    Stranded,
}
