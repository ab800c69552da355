//! Changes of groups and agents while the world runs. Positions and destinations stay as they are.

use super::build::known;
use super::{AgentRef, World};
use crate::Error;
use crate::agent::{Agent, Group, GroupId, Guidance};

impl World {
    /// Replaces a group from the next step on: its local model, interaction rules and guidance. Its agents
    /// stay where they are and continue to their goals. The memory of a behaviour starts again, unless the group had the
    /// same object before.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use throng::avoid::{Orca, Rvo};
    /// use throng::{Agent, Group, Settings, World};
    ///
    /// let mut world = World::new(Settings::default())?;
    /// let walkers = world.add_group(Group { model: Arc::new(Orca::default()), ..Group::default() })?;
    /// world.add_agent(Agent { group: walkers, ..Agent::default() })?;
    /// world.step();
    /// world.set_group(walkers, Group { model: Arc::new(Rvo::default()), ..world.group(walkers).clone() })?;
    /// world.step();
    /// # Ok::<(), throng::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`add_group`](Self::add_group), and [`Error::Unknown`] for a group that does not exist. The world is
    /// unchanged.
    pub fn set_group(&mut self, id: GroupId, group: Group) -> Result<(), Error> {
        known("group", id.index(), self.state.local_groups.len())?;
        let local = self.state.checked_group(&group)?;
        self.state.agents.memory.widen(group.guidance.words());
        self.step.guard.solids_mut().set(id.index(), local.solid.0.clone());
        let keeps = group.guidance.has_behaviour_of(&self.state.groups[id.index()].guidance);
        self.state.local_groups[id.index()] = local;
        self.state.groups[id.index()] = group;
        self.state.end_standoffs();
        self.step.wake();
        for row in (0..self.state.agents.len()).filter(|&row| self.state.agents.group[row] == id).collect::<Vec<_>>() {
            if !keeps {
                self.state.agents.memory.forget(row);
            }
            if self.state.agents.script[row].is_none() {
                self.state.update_status_without_stops(row);
            }
        }
        Ok(())
    }

    /// Sets what guides the agents of a group from the next step on: a behaviour instead of their journeys, another field.
    /// An interactive program calls it while the user draws a field.
    ///
    /// ```
    /// use throng::agent::Guidance;
    /// use throng::{Agent, GroupId, Settings, World};
    /// use throng_steer::Wander;
    /// let mut world = World::new(Settings::default())?;
    /// let id = world.add_agent(Agent::at([0.0, 0.0]).goal([4.0, 0.0]))?;
    /// world.set_guidance(GroupId::DEFAULT, Guidance::behaviour(Wander::default()))?;
    /// for _ in 0..100 {
    ///     world.step();
    /// }
    /// world.set_guidance(GroupId::DEFAULT, Guidance::JOURNEY)?;
    /// while !world.finished() {
    ///     world.step();
    /// }
    /// assert!(world.position(id).is_some_and(|at| (at.x - 4.0).abs() < 0.5));
    /// # Ok::<(), throng::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`set_group`](Self::set_group).
    pub fn set_guidance(&mut self, group: GroupId, guidance: Guidance) -> Result<(), Error> {
        known("group", group.index(), self.state.groups.len())?;
        self.set_group(group, Group { guidance, ..self.group(group).clone() })
    }

    /// Changes the properties of agents, including agents that are scheduled to enter. `into` gets the number of each
    /// agent and its present properties, and changes its body, motor, preferred speed, priority, share of the field, or
    /// layers. Other changes are ignored: an agent stays where it is, in its group, on its path. Bodies that come to
    /// overlap part as in an [overlapping start](crate::guard).
    ///
    /// ```
    /// use throng::{Agent, Settings, World};
    ///
    /// let mut world = World::new(Settings::default())?;
    /// world.add_agent(Agent::default())?;
    /// world.adjust(|_, agent| agent.preferred_speed = 0.8)?;
    /// assert_eq!(world.relative_columns().preferred_speed[0], 0.8);
    /// # Ok::<(), throng::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Limit`] names the parameter that is out of range. The world is unchanged.
    pub fn adjust(&mut self, mut into: impl FnMut(u32, &mut Agent)) -> Result<(), Error> {
        let mut changed = |number: u32, agent: &Agent| -> Result<Agent, Error> {
            let mut other = agent.clone();
            into(number, &mut other);
            other.check()?;
            Ok(other)
        };
        let mut here = Vec::with_capacity(self.state.agents.len());
        for row in 0..self.state.agents.len() {
            if let Some(agent) = self.agent(self.state.id(row)).map(AgentRef::to_agent) {
                here.push(changed(self.state.agents.number[row], &agent)?);
            }
        }
        let mut to_come = self.state.schedule.clone();
        for agent in to_come.agents() {
            let other = changed(agent.number.unwrap_or_default(), agent)?;
            *agent = Agent {
                position: agent.position,
                velocity: agent.velocity,
                heading: agent.heading,
                group: agent.group,
                journey: agent.journey,
                script: agent.script,
                number: agent.number,
                ..other
            };
        }
        self.state.schedule = to_come;
        for (row, agent) in here.iter().enumerate() {
            let agents = &mut self.state.agents;
            if agents.radius[row] != agent.radius || agents.core[row] != agent.core {
                agents.travel[row].lose_way();
            }
            agents.radius.set(row, agent.radius);
            agents.core.set(row, agent.core);
            agents.preferred_speed.set(row, agent.preferred_speed);
            agents.set_motor(row, agent.motor);
            agents.time_gap.set(row, agent.time_gap);
            agents.priority.set(row, agent.priority);
            agents.governed.set(row, agent.governed);
            agents.layers.set(row, agent.layers);
            agents.avoids.set(row, agent.avoids);
        }
        self.step.wake();
        Ok(())
    }
}
