//! Changing agents from outside: where they are, how they move, what they are.

use super::World;
use crate::agent::{Agent, AgentId, GroupId};
use crate::perceive::Grid;
use crate::{Error, Status};
use glam::{DVec2, DVec3, Vec2, Vec3};

impl World {
    /// The group of a name; the one added last, if several have it.
    ///
    /// # Errors
    /// [`Error::NoGroup`] if there is none.
    pub fn group_named(&self, name: &str) -> Result<GroupId, Error> {
        let index = self.groups.iter().rposition(|group| group.name == name);
        index.map(|index| GroupId(index as u32)).ok_or_else(|| Error::NoGroup { name: name.to_owned() })
    }

    /// The agents of a group, in the order of their numbers.
    pub fn members(&self, group: GroupId) -> Vec<AgentId> {
        self.in_order(|row| self.agents.group[row] == group)
    }

    /// All agents, in the order of their numbers.
    pub fn everybody(&self) -> Vec<AgentId> {
        self.in_order(|_| true)
    }

    fn in_order(&self, counts: impl Fn(usize) -> bool) -> Vec<AgentId> {
        let mut rows: Vec<usize> = (0..self.agents.len()).filter(|&row| counts(row)).collect();
        rows.sort_unstable_by_key(|&row| self.agents.number[row]);
        rows.into_iter().map(|row| self.id(row)).collect()
    }

    /// An agent as it is now, as [`add_agent`](Self::add_agent) would take it; `None` if it has been removed.
    pub fn agent(&self, id: AgentId) -> Option<Agent> {
        let (row, agents) = (self.row(id)?, &self.agents);
        Some(Agent {
            position: self.world_position(row),
            altitude: agents.altitude[row],
            velocity: agents.velocity[row],
            heading: Some(agents.heading[row]),
            group: agents.group[row],
            journey: agents.journey[row],
            script: agents.script[row],
            radius: agents.radius[row],
            core: agents.core[row],
            preferred_speed: agents.preferred_speed[row],
            max_speed: agents.max_speed[row],
            max_acceleration: agents.max_acceleration[row],
            max_turn_rate: agents.max_turn_rate[row],
            time_gap: agents.time_gap[row],
            tracking_error: agents.tracking_error[row],
            priority: agents.priority[row],
            governed: agents.governed[row],
            layers: agents.layers[row],
            avoids: agents.avoids[row],
            number: Some(agents.number[row]),
        })
    }

    /// Lets an agent begin anew as another: elsewhere, in another group, with another journey. Its id and its number stay
    /// (`agent.number` does not count), its trip and what its behaviour remembers begin with it.
    /// It may overlap others as [one that is added](Self::add_agent) may; [`is_free`](Self::is_free) tells beforehand.
    ///
    /// # Errors
    /// Those of [`add_agent`](Self::add_agent), and [`Error::Gone`] for an agent that has been removed; the world is as it
    /// was.
    pub fn replace(&mut self, id: AgentId, agent: Agent) -> Result<(), Error> {
        let row = self.row(id).ok_or(Error::Gone)?;
        self.check(&agent)?;
        let number = self.agents.number[row];
        self.remove_row(row);
        // the slot that has just become free is the first to be taken again
        let AgentId { slot, generation } = self.put(&agent, number, self.time());
        debug_assert_eq!(slot, id.slot);
        self.slots.generations.set(slot as usize, generation - 1);
        Ok(())
    }

    /// Gives an agent another velocity, metres a second, as a kick does; its body and its behaviour make of it what they can.
    ///
    /// # Errors
    /// [`Error::Limit`] if it is not finite, [`Error::Gone`] for an agent that has been removed.
    pub fn set_velocity(&mut self, id: AgentId, velocity: Vec3) -> Result<(), Error> {
        let row = self.row(id).ok_or(Error::Gone)?;
        Error::unless_finite("velocity", f64::from(velocity.element_sum()))?;
        self.agents.velocity[row] = velocity.truncate();
        self.agents.climb.set(row, velocity.z);
        if self.agents.status[row] != Status::Walking {
            self.step.rest.end();
        }
        Ok(())
    }

    /// Whether a disc (a sphere, at an altitude) could be there, and would touch nobody.
    pub fn is_free(&self, at: DVec3, radius: f32) -> bool {
        let place: DVec2 = at.truncate();
        if !place.is_finite() || self.no_room(place, radius).is_some() {
            return false;
        }
        let agents = &self.agents;
        let largest = agents.bodies().map(|body| body.bound()).fold(0.0, f32::max);
        let center = (place - self.settings.origin).extend(at.z);
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
