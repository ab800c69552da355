//! Changes of agents by the program: position, motion and properties.

use super::{State, World};
use crate::agent::{Agent, AgentId, GroupId};
use crate::perceive::Grid;
use crate::{Error, Status};
use glam::{DVec2, DVec3, Vec2, Vec3};

impl World {
    /// Returns the group with a name; the last one added, if several groups have it.
    ///
    /// # Errors
    /// [`Error::NoGroup`] if no group has the name.
    pub fn group_named(&self, name: &str) -> Result<GroupId, Error> {
        let index = self.state.local_groups.iter().rposition(|group| group.name == name);
        index.map(|index| GroupId(index as u32)).ok_or_else(|| Error::NoGroup { name: name.to_owned() })
    }

    /// Returns the agents of a group, in the order of their numbers.
    pub fn members(&self, group: GroupId) -> Vec<AgentId> {
        self.state.in_order(|row| self.state.agents.group[row] == group)
    }

    /// Returns all agents, in the order of their numbers.
    pub fn agent_ids(&self) -> Vec<AgentId> {
        self.state.in_order(|_| true)
    }

    /// Replaces an agent by another: at another position, in another group, with another journey. Its id and number
    /// stay (`agent.number` is ignored). Its trip statistics and the memory of its behaviours start again. It may
    /// overlap other agents as [a new agent](Self::add_agent) may; [`is_free`](Self::is_free) tests a place beforehand.
    ///
    /// # Errors
    /// Those of [`add_agent`](Self::add_agent), and [`Error::Gone`] for an agent that has been removed. The world is
    /// unchanged.
    pub fn replace(&mut self, id: AgentId, agent: Agent) -> Result<(), Error> {
        let row = self.state.row(id).ok_or(Error::Gone)?;
        let agent = self.state.with_journey(agent)?;
        let number = self.state.agents.number[row];
        self.step.remove(&mut self.state, row);
        // the slot that has just become free is the next to be used
        let AgentId { slot, generation } = self.state.put(&agent, number, self.state.time());
        debug_assert_eq!(slot, id.slot);
        self.state.slots.generations.set(slot as usize, generation - 1);
        Ok(())
    }

    /// Sets the velocity of an agent, m/s, as a kick would. The body and the behaviour of the agent act on it from the
    /// next step on.
    ///
    /// # Errors
    /// [`Error::Limit`] if the velocity is not finite, [`Error::Gone`] for an agent that has been removed.
    pub fn set_velocity(&mut self, id: AgentId, velocity: Vec3) -> Result<(), Error> {
        let row = self.state.row(id).ok_or(Error::Gone)?;
        Error::unless_finite("velocity", f64::from(velocity.element_sum()))?;
        self.state.agents.velocity[row] = velocity.truncate();
        self.state.agents.vertical_velocity.set(row, velocity.z);
        if self.state.agents.status[row] != Status::Walking {
            self.step.wake();
        }
        Ok(())
    }

    /// Whether a disc (a sphere, at an altitude) can be at a place and touches no agent there.
    pub fn is_free(&self, at: DVec3, radius: f32) -> bool {
        let place: DVec2 = at.truncate();
        if !place.is_finite() || self.state.no_room(place, radius).is_some() {
            return false;
        }
        let agents = &self.state.agents;
        let largest = agents.bodies().map(|body| body.bounding_radius()).fold(0.0, f32::max);
        let center = (place - self.state.settings.origin).extend(at.z);
        let disc = crate::space::Core::new(center.truncate(), 0.0, Vec2::ZERO);
        let touches = |row: usize| {
            let distance = if agents.is_disc(row) {
                agents.center(row).distance(center)
            } else {
                disc.separation(&agents.core_of(row)).distance
            };
            distance < f64::from(agents.radius[row] + radius)
        };
        let mut grid = Grid::default();
        grid.rebuild(&agents.position, &agents.number, 1.0);
        let mut free = true;
        let reach = (radius + largest) * 1.01;
        grid.within(center.truncate().as_vec2(), reach, |near| free &= !touches(near.row as usize));
        free
    }
}

impl State {
    fn in_order(&self, counts: impl Fn(usize) -> bool) -> Vec<AgentId> {
        let mut rows: Vec<usize> = (0..self.agents.len()).filter(|&row| counts(row)).collect();
        rows.sort_unstable_by_key(|&row| self.agents.number[row]);
        rows.into_iter().map(|row| self.id(row)).collect()
    }

    /// Returns the present state of an agent, in the form that [`add_agent`](Self::add_agent) takes.
    pub(crate) fn to_agent(&self, row: usize) -> Agent {
        let agents = &self.agents;
        Agent {
            position: self.world_place(row),
            velocity: agents.velocity[row],
            heading: Some(agents.heading[row]),
            group: agents.group[row],
            journey: agents.journey[row],
            script: agents.script[row],
            radius: agents.radius[row],
            core: agents.core[row],
            preferred_speed: agents.preferred_speed[row],
            motor: agents.motor(row),
            time_gap: agents.time_gap[row],
            priority: agents.priority[row],
            governed: agents.governed[row],
            layers: agents.layers[row],
            avoids: agents.avoids[row],
            number: Some(agents.number[row]),
            goal: self.own_goal(row),
            user_data: agents.user_data[row],
        }
    }
}
