//! The schedule of agents that enter later.

use super::{EventKind, State};
use crate::agent::Agent;
use crate::perceive::Grid;
use crate::space::Core;
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// Agents that have yet to enter.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Schedule {
    /// By time, then number, in descending order: the last entry enters first.
    entries: Vec<(f64, Agent)>,
    sorted: bool,
}

impl Schedule {
    pub(super) fn add(&mut self, time: f64, agent: Agent) {
        self.entries.push((time, agent));
        self.sorted = false;
    }

    pub(super) fn len(&self) -> usize {
        self.entries.len()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    pub(super) fn any_flies(&self) -> bool {
        self.entries.iter().any(|(_, agent)| agent.position.z != 0.0)
    }

    pub(super) fn has(&self, number: u32) -> bool {
        self.entries.iter().any(|(_, agent)| agent.number == Some(number))
    }

    /// Returns all scheduled agents.
    pub(super) fn agents(&mut self) -> impl Iterator<Item = &mut Agent> {
        self.entries.iter_mut().map(|(_, agent)| agent)
    }

    /// Removes and returns the agents that are due.
    fn due(&mut self, now: f64) -> Vec<(f64, Agent)> {
        if !self.sorted {
            self.entries.sort_by(|a, b| b.0.total_cmp(&a.0).then(b.1.number.cmp(&a.1.number)));
            self.sorted = true;
        }
        let first = self.entries.partition_point(|(time, _)| *time > now);
        if first == self.entries.len() {
            return Vec::new();
        }
        let mut due = self.entries.split_off(first);
        due.reverse();
        due
    }
}

impl State {
    /// Adds the agents that are due and have a free place; the other agents wait.
    pub(crate) fn enter(&mut self) {
        let now = self.time();
        let due = self.schedule.due(now + 1e-9);
        if due.is_empty() {
            return;
        }
        let mut grid = Grid::default();
        grid.rebuild(&self.agents.position, &self.agents.number, 1.0);
        let largest = self.agents.bodies().map(|body| body.bounding_radius()).fold(0.0, f32::max);
        let settled = self.agents.len();
        for (time, agent) in due {
            let at = (agent.position.truncate() - self.settings.origin).as_vec2();
            let core = Core::new(at.as_dvec2(), self.first_heading(&agent), agent.core);
            let touches = |other: usize| {
                let d = if agent.core == Vec2::ZERO && self.agents.is_disc(other) {
                    self.agents.center(other).distance(core.center.extend(agent.position.z))
                } else {
                    core.separation(&self.agents.core_of(other)).distance
                };
                d < (f64::from(self.agents.radius[other]) + f64::from(agent.radius)) * 1.01
            };
            let mut taken = (settled..self.agents.len()).any(touches);
            grid.within(at, (agent.body().bounding_radius() + largest) * 1.02, |near| {
                taken |= touches(near.row as usize)
            });
            if taken || self.no_room_for(&agent).is_some() {
                self.schedule.add(time, agent);
            } else {
                let number = agent.number.unwrap_or_default();
                self.put(&agent, number, now);
                self.happened(self.agents.len() - 1, EventKind::Entered, now);
            }
        }
    }
}
