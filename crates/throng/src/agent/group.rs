//! The properties that the agents of a group share.

use super::Guidance;
use crate::Error;
use crate::avoid::{LocalModel, NoAvoidance, Orca};
use crate::motion::WrapAround;
use crate::steer::{Barriers, BoxedBehaviour};
use glam::DVec2;
use std::sync::Arc;

/// The properties that the agents of a group share: their local model, neighbour search and interaction rules.
#[derive(Clone, Debug)]
pub struct Group {
    /// Name, for display.
    pub name: String,
    /// World coordinates of the origin of the group's own coordinates. Its field, behaviour, wrapping and solids have
    /// places in `f32`, relative to this origin: by default they are world coordinates. Where these exceed some 1000 m,
    /// `f32` rounds to more than 0.1 mm; the [origin of the world](crate::Settings::origin) is then the better origin, and
    /// the fastest.
    pub origin: DVec2,
    /// The local model: it turns the preferred velocity into a safe one.
    pub model: Arc<dyn LocalModel>,
    /// Distance within which an agent searches for neighbours, metres between centres (between cores, for bodies that
    /// are not discs). Limit: > 0.
    pub neighbour_distance: f32,
    /// Number of nearest neighbours that an agent takes into account, 1 to 1000. Agents that avoid no other agent may
    /// also have [`ALL_NEIGHBOURS`](Self::ALL_NEIGHBOURS) within `neighbour_distance`, or 0, which disables the neighbour
    /// search; separations are then not measured.
    pub neighbours: usize,
    /// Whether agents look ahead: they go where there is free space, keep a time gap to the agent ahead, and turn from
    /// agents that come the opposite way. Without it they head straight along their paths and leave all else to the
    /// local model.
    pub look_ahead: bool,
    /// Lateral distance within which another agent is ahead of an agent, metres, and no less than the breadth of its
    /// body. Shoulders are broader than a body is deep, and people turn them where it is narrow. Limit: 0 to 10.
    pub shoulders: f32,
    /// Distance that an agent prefers to keep from agents that come the opposite way or stay where they are, metres. At
    /// smaller gaps less of it counts. Limit: 0 to 10.
    pub personal_space: f32,
    /// Relaxation time of an agent that looks ahead, seconds: its acceleration is the difference between preferred and
    /// present velocity divided by this time, and across its path by half of this time (Moussaïd et al. 2009 measured
    /// 0.54 ± 0.05 s along the path). 0: at once, within the maximum acceleration. Agents that a field governs follow
    /// it at once. Models with their own delay ignore it. Limit: 0 to 10.
    pub relaxation_time: f32,
    /// Greatest angle by which an agent that looks ahead turns from an agent that comes the opposite way, radians. An
    /// undecided encounter is passed on the right, or on the left if the angle is negative. Agents that do not look
    /// ahead are always turned by this angle. Limit: -0.5 to 0.5.
    pub keep_right: f32,
    /// Whether agents that block each other's paths agree on which of them step aside, after Dergachev and Yakovlev,
    /// CASE 2021.
    pub resolve: bool,
    /// What guides its agents: their journeys, a behaviour, a field.
    pub guidance: Guidance,
    /// A ball that the agents leave on one side and enter on the other; `None`: space does not wrap. An agent enters as
    /// soon as nothing that it is kept from is in its way there: the agents and walls that the guard keeps it from, and
    /// `solid`. Until then it moves on outside. An agent that neither flies nor walks in the air leaves the circle in
    /// which the ball cuts its height. A walker keeps its goal and plans its path anew; a goal outside the ball is out of
    /// reach. Moving obstacles ([`Script`](crate::Script)) stay outside.
    pub wrap_around: Option<WrapAround>,
    /// Surfaces in space that no agent of the group enters, guarded or not, with the side from which they are seen:
    /// columns from outside, a cage from inside. A body counts as its bounding ball. An agent that would enter moves
    /// along the surface, or stops. An agent that starts inside is led out, and counts as an
    /// [overlap](crate::Summary::overlaps) until then. The surfaces do not move and hide no agent;
    /// behaviours (`throng_steer::AvoidObstacles`) can avoid them in advance.
    pub solid: Barriers,
    /// Whether the [guard](crate::guard) prevents its agents from overlapping other agents and walls. Only two agents
    /// that both belong to groups without the guard may overlap.
    pub guard: bool,
}

impl Group {
    /// Value of [`neighbours`](Self::neighbours): all agents within `neighbour_distance`. Flocks need it: it is fast at
    /// any density, and fastest for agents with a plain `throng_steer::Flocking` behaviour.
    pub const ALL_NEIGHBOURS: usize = usize::MAX;

    /// Checks whether the group is valid.
    pub(crate) fn check(&self) -> Result<(), Error> {
        Error::unless_positive("neighbour distance", self.neighbour_distance)?;
        let count = self.neighbours;
        let all_or_none = matches!(count, 0 | Self::ALL_NEIGHBOURS) && !self.model.avoids();
        let counts = (1..=1000).contains(&count) || all_or_none;
        let limit = "from 1 to 1000, or 0 or all for agents that avoid no other agent";
        Error::unless(counts, "neighbours", count as f64, limit)?;
        Error::unless(self.keep_right.abs() <= 0.5, "keep right", self.keep_right, "from -0.5 to 0.5 rad")?;
        self.check_look_ahead()?;
        self.model.check()?;
        self.guidance.check()?;
        self.wrap_around.as_ref().map_or(Ok(()), WrapAround::check)
    }

    /// Whether it has anything that its origin counts for.
    pub(crate) fn has_places(&self) -> bool {
        let Self { guidance, wrap_around, solid, .. } = self;
        !guidance.is_journey() || wrap_around.is_some() || !solid.0.is_empty()
    }

    /// Returns the number of nearest neighbours that the neighbour search finds for each of its agents.
    pub(crate) fn nearest(&self) -> usize {
        if self.looks_at_all() { 0 } else { self.neighbours }
    }

    /// Whether its agents search for all neighbours within the distance, instead of the nearest few.
    pub(crate) fn looks_at_all(&self) -> bool {
        self.neighbours == Self::ALL_NEIGHBOURS
    }

    /// Returns a group of agents that move only as a behaviour steers them: without interaction rules, avoidance or
    /// guard. They may overlap.
    ///
    /// ```
    /// use throng::motion::Vehicle;
    /// use throng_steer::Wander;
    /// use throng::{Agent, Group, Settings, World};
    /// let mut world = World::new(Settings::default())?;
    /// let cars = world.add_group(Group { name: "cars".into(), ..Group::steered(Wander::default()) })?;
    /// world.add_agent(Agent::at([0.0, 0.0]).motor(Vehicle::default()).group(cars))?;
    /// # Ok::<(), throng::Error>(())
    /// ```
    pub fn steered(behaviour: impl Into<BoxedBehaviour>) -> Self {
        Self {
            model: Arc::new(NoAvoidance),
            guidance: Guidance::behaviour(behaviour),
            look_ahead: false,
            keep_right: 0.0,
            resolve: false,
            guard: false,
            ..Self::default()
        }
    }
}

impl Default for Group {
    fn default() -> Self {
        Self {
            name: "agents".into(),
            origin: DVec2::ZERO,
            model: Arc::new(Orca::default()),
            neighbour_distance: 8.0,
            neighbours: 10,
            look_ahead: true,
            shoulders: 0.415,
            personal_space: 0.4,
            relaxation_time: 0.45,
            keep_right: 20.0_f32.to_radians(),
            resolve: true,
            guidance: Guidance::JOURNEY,
            wrap_around: None,
            solid: Barriers::default(),
            guard: true,
        }
    }
}
