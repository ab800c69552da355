//! Agents: their properties and ids.
//!
//! [`Agent`] describes one agent for [`World::add_agent`](crate::World::add_agent). The world stores the same
//! properties as [columns](Columns). [`Group`] holds the properties that many agents share, such as the local model and
//! the neighbour distance.

mod body;
mod column;
mod columns;
mod cycles;
mod ghost;
mod group;
mod guidance;
mod hindrance;
mod id;
mod memory;
mod rounding;
mod row;
mod statistics;

pub use body::{Body, MARGIN, MARGIN_LONG_STEP};
pub use column::{Column, ColumnValue};
pub use columns::Columns;
pub(crate) use columns::Row;
pub(crate) use cycles::Cycles;
pub(crate) use ghost::GhostWords;
pub use group::Group;
pub use guidance::Guidance;
pub use hindrance::{Hindered, Hindrance, ProgressMark};
pub use id::{AgentId, GoalId, GroupId, JourneyId, ObstacleId, ScriptId};
pub use memory::Memory;
pub use rounding::Rounding;
pub use statistics::TripStatistics;

use crate::motion::Motor;
use crate::navigate::Goal;
use crate::{Error, Position};
use glam::{DVec3, Vec2};
use serde::{Deserialize, Serialize};

/// Speed, m/s, below which a velocity has no visible direction.
pub(crate) const SEEN: f32 = 0.1;

/// The description of an agent, for [`World::add_agent`](crate::World::add_agent).
///
/// Lengths are metres, times seconds, angles radians.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Agent {
    /// Centre of the body, world coordinates; z is its height above the ground, more than 0 for agents that fly. Limit:
    /// z from 0 to 20000.
    pub position: DVec3,
    /// Velocity at the start, along the ground.
    pub velocity: Vec2,
    /// Direction of the body, counter-clockwise from +x; `None`: towards the first goal.
    pub heading: Option<f32>,
    /// The group it belongs to.
    pub group: GroupId,
    /// The journey that it follows.
    pub journey: JourneyId,
    /// A script that it follows instead of a journey. It moves regardless of the guidance and the local model of its
    /// group, turns as if it had no vehicle, and is no faster than its motor.
    pub script: Option<ScriptId>,
    /// Radius of the body, or of its rounding if it is not a disc ([`Body`]). Limit: 0.001 to 1000.
    pub radius: f32,
    /// Half extents of the core of the body ([`Body`]), along and across the heading; zero for a disc. Limit: 0 to
    /// 1000.
    pub core: Vec2,
    /// Speed at which it walks when nothing hinders it. Limit: >= 0.
    pub preferred_speed: f32,
    /// What moves it, and the limits of its motion. Limit: a maximum speed of at least `preferred_speed`.
    pub motor: Motor,
    /// Time gap, seconds. An agent that looks ahead walks no faster than the gap to the agent ahead divided by the time
    /// gap. People in single file need 0.36 m each, plus 1.06 s times their speed (Seyfried et al. 2005). Bodies 0.26 m
    /// deep keep the same distance with 1.15 s at 1 m/s. Limit: 0.05 to 10.
    pub time_gap: f32,
    /// Right of way: of two agents, the agent with the lower priority takes the larger avoidance share. Equal
    /// priorities mean equal shares. With a difference of 1 the other agent takes all of it.
    pub priority: f32,
    /// Factor on the ratio with which the field of its group governs it. Limit: 0 to 1.
    pub governed: f32,
    /// The layers that this agent is on, one bit each.
    pub layers: u32,
    /// The layers that this agent avoids, one bit each.
    pub avoids: u32,
    /// Number of the agent. Ties, random numbers and hashes depend on it, so that a world does not depend on the order
    /// in which agents are added. `None`: the next free number. Limit: less than 4294967295.
    pub number: Option<u32>,
    /// A single goal in place of the journey; `None`: the journey counts. A copy of an agent with such a goal has it too.
    pub goal: Option<Goal>,
    /// A number for the program's own use, such as an index into its tables. The engine does not read it.
    pub user_data: u64,
}

impl Agent {
    /// A pedestrian of the usual size and speed at a place.
    ///
    /// ```
    /// use throng::Agent;
    /// let agent = Agent::at([2.0, 3.0]).goal([9.0, 3.0]).radius(0.2).speed(1.4).user_data(7);
    /// assert!(agent.position.x == 2.0 && agent.preferred_speed == 1.4 && agent.goal.is_some());
    /// ```
    pub fn at(place: impl Into<Position>) -> Self {
        Self { position: place.into().0, ..Self::default() }
    }

    /// Sends the agent to a single goal: a place, or a [`Goal`].
    #[must_use]
    pub fn goal(self, goal: impl Into<Goal>) -> Self {
        Self { goal: Some(goal.into()), ..self }
    }

    /// Puts the agent into a group.
    #[must_use]
    pub fn group(self, group: GroupId) -> Self {
        Self { group, ..self }
    }

    /// Sets the radius of the body, metres.
    #[must_use]
    pub fn radius(self, radius: f32) -> Self {
        Self { radius, ..self }
    }

    /// Sets the preferred speed, m/s, and a top speed that exceeds it as the [default](Self::default) top speed does.
    #[must_use]
    pub fn speed(self, speed: f32) -> Self {
        let usual = Self::default();
        let mut motor = self.motor;
        motor.set_max_speed(speed * (usual.motor.max_speed() / usual.preferred_speed));
        Self { preferred_speed: speed, motor, ..self }
    }

    /// Sets the motor. The preferred speed is then at most the motor's maximum speed.
    #[must_use]
    pub fn motor(self, motor: impl Into<Motor>) -> Self {
        let motor = motor.into();
        Self { motor, preferred_speed: self.preferred_speed.min(motor.max_speed()), ..self }
    }

    /// Sets the heading at the start, radians counter-clockwise from +x.
    #[must_use]
    pub fn heading(self, heading: f32) -> Self {
        Self { heading: Some(heading), ..self }
    }

    /// Sets the number for the program's own use.
    #[must_use]
    pub fn user_data(self, user_data: u64) -> Self {
        Self { user_data, ..self }
    }

    /// Checks whether the agent is valid at any position.
    pub(crate) fn check(&self) -> Result<(), Error> {
        Error::unless_finite("velocity", f64::from(self.velocity.x + self.velocity.y))?;
        Error::unless_finite("heading", f64::from(self.heading.unwrap_or(0.0)))?;
        Error::unless(self.radius >= 1e-3 && self.radius <= 1e3, "radius", self.radius, "from 0.001 to 1000 m")?;
        for half in [self.core.x, self.core.y] {
            Error::unless((0.0..=1e3).contains(&half), "half extent of the core", half, "from 0 to 1000 m")?;
        }
        let limit = "at least 0 m/s and at most 1000 m/s";
        Error::unless((0.0..=1e3).contains(&self.preferred_speed), "preferred speed", self.preferred_speed, limit)?;
        self.motor.check()?;
        let most = self.motor.max_speed();
        Error::unless(most >= self.preferred_speed, "max speed", most, "at least the preferred speed")?;
        Error::unless((0.05..=10.0).contains(&self.time_gap), "time gap", self.time_gap, "from 0.05 to 10 s")?;
        Error::unless_finite("priority", f64::from(self.priority))?;
        Error::unless((0.0..=1.0).contains(&self.governed), "governed", self.governed, "from 0 to 1")
    }
}

impl Default for Agent {
    /// A pedestrian of typical size and speed, standing at the origin.
    fn default() -> Self {
        Self {
            position: DVec3::ZERO,
            velocity: Vec2::ZERO,
            heading: None,
            group: GroupId(0),
            journey: JourneyId::STAY,
            script: None,
            radius: 0.13,
            core: Vec2::ZERO,
            preferred_speed: 1.3,
            motor: Motor::default(),
            time_gap: 1.15,
            priority: 0.0,
            governed: 1.0,
            layers: 1,
            avoids: u32::MAX,
            number: None,
            goal: None,
            user_data: 0,
        }
    }
}

/// The status of an agent's trip.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Status {
    /// Walking to its next stop.
    #[default]
    Walking,
    /// Waiting at a stop of its journey.
    Waiting,
    /// At the end of its journey.
    Arrived,
    /// Standing, because its goal cannot be reached.
    Stranded,
}
