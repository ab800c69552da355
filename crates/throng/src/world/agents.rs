//! Reading agents: one by id, or all in the order of their ids.

use super::World;
use crate::agent::{Agent, AgentId, GroupId, Hindrance, Status};
use crate::navigate::Goal;
use glam::{DVec3, Vec3};

/// An agent of a [`World`], for reading.
///
/// Places are `f64` in world coordinates, metres, z up from the ground. Velocities, sizes and angles are `f32`.
///
/// ```
/// use throng::{Agent, Settings, World};
/// let mut world = World::new(Settings::default())?;
/// let id = world.add_agent(Agent::at([3.0, 4.0]).goal([9.0, 4.0]))?;
/// world.step();
/// let agent = world.agent(id).expect("the agent is there");
/// assert!(agent.position().x > 3.0 && agent.velocity().x > 0.0);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct AgentRef<'a> {
    world: &'a World,
    row: usize,
}

impl<'a> AgentRef<'a> {
    /// The agent's id.
    pub fn id(&self) -> AgentId {
        self.world.id(self.row)
    }

    /// The agent's number: ties, random draws and hashes depend on it.
    pub fn number(&self) -> u32 {
        self.world.state.agents.number[self.row]
    }

    /// Centre of the body, world coordinates; z is 0 on the ground.
    pub fn position(&self) -> DVec3 {
        self.world.state.world_place(self.row)
    }

    /// Velocity, m/s; z is the vertical velocity.
    pub fn velocity(&self) -> Vec3 {
        self.world.state.agents.velocity_in_space(self.row)
    }

    /// Direction of the body, radians counter-clockwise from +x, -pi to pi.
    pub fn heading(&self) -> f32 {
        self.world.state.agents.heading[self.row]
    }

    /// Radius of the body, or of the rounding of a body that is not a disc, metres.
    pub fn radius(&self) -> f32 {
        self.world.state.agents.radius[self.row]
    }

    /// The agent's group.
    pub fn group(&self) -> GroupId {
        self.world.state.agents.group[self.row]
    }

    /// What the agent is doing.
    pub fn status(&self) -> Status {
        self.world.state.agents.status[self.row]
    }

    /// The goal that the agent is on its way to; `None` without a goal, or at the end of its journey.
    pub fn goal(&self) -> Option<&'a Goal> {
        self.world.goal_of(self.row).map(|goal| &self.world.state.goals[goal.index()])
    }

    /// Returns a copy of the agent as it is now, in the form that [`World::add_agent`] and [`World::replace`] take.
    pub fn to_agent(self) -> Agent {
        self.world.state.to_agent(self.row)
    }

    /// What hinders the agent, as found within the last half second.
    pub fn hindrance(&self) -> Hindrance {
        self.world.hindrance(self.row)
    }

    /// The number that the program has given the agent; see [`Agent::user_data`](crate::Agent::user_data).
    pub fn user_data(&self) -> u64 {
        self.world.state.agents.user_data[self.row]
    }
}

/// The agents of a [`World`] in the order of their ids: [`World::agents`].
#[derive(Clone, Debug)]
pub struct Agents<'a> {
    world: &'a World,
    /// Slots not yet visited.
    slots: std::ops::Range<usize>,
    /// Agents not yet visited.
    left: usize,
}

impl<'a> Iterator for Agents<'a> {
    type Item = AgentRef<'a>;

    fn next(&mut self) -> Option<AgentRef<'a>> {
        let rows = &self.world.state.slots.rows;
        let slot = self.slots.find(|&slot| rows[slot] != u32::MAX)?;
        self.left -= 1;
        Some(AgentRef { world: self.world, row: rows[slot] as usize })
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.left, Some(self.left))
    }
}

impl ExactSizeIterator for Agents<'_> {}

impl World {
    /// Returns the agents in the order of their ids.
    ///
    /// ```
    /// use throng::{Agent, Settings, World};
    /// let mut world = World::new(Settings::default())?;
    /// for x in 0..3 {
    ///     world.add_agent(Agent::at([f64::from(x), 0.0]).goal([5.0, 5.0]))?;
    /// }
    /// world.step();
    /// let fastest = world.agents().map(|agent| agent.velocity().length()).fold(0.0, f32::max);
    /// assert!(world.agents().len() == 3 && fastest > 0.0);
    /// # Ok::<(), throng::Error>(())
    /// ```
    pub fn agents(&self) -> Agents<'_> {
        Agents { world: self, slots: 0..self.state.slots.rows.len(), left: self.state.agents.len() }
    }

    /// Returns an agent for reading; `None` if it has been removed.
    pub fn agent(&self, id: AgentId) -> Option<AgentRef<'_>> {
        Some(AgentRef { world: self, row: self.state.row(id)? })
    }

    /// Writes the centres of all agents, world coordinates, in the order of [`agents`](Self::agents): for programs that read
    /// them every frame and keep the memory.
    pub fn positions_into(&self, positions: &mut Vec<DVec3>) {
        positions.clear();
        positions.extend(self.agents().map(|agent| agent.position()));
    }
}
