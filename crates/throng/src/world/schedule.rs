//! The schedule of agents that enter later.

use super::{EventKind, State};
use crate::agent::{Agent, Body};
use crate::halo::{Agreement, Halo};
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
    pub(crate) fn all(&self) -> impl Iterator<Item = &Agent> {
        self.entries.iter().map(|(_, agent)| agent)
    }

    /// Returns all scheduled agents, mutable.
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
    /// Adds the agents that are due and have a free place; the other agents wait. All worlds of a division have the same
    /// schedule. Each agent enters the world that owns its place.
    pub(crate) fn enter(&mut self, halo: &mut dyn Halo) {
        let now = self.time();
        let due = self.schedule.due(now + 1e-9);
        if due.is_empty() {
            return;
        }
        let mut grid = Grid::default();
        grid.rebuild(&self.agents.position, &self.agents.number, 1.0);
        let largest = self.agents.bodies().map(|body| body.bounding_radius()).fold(0.0, f32::max);
        let bodies: Vec<Entering> = due.iter().map(|(_, agent)| self.entering(agent)).collect();
        let mut flags = Vec::with_capacity(due.len());
        for body in &bodies {
            let mut any = false;
            let reach = (body.body.bounding_radius() + largest) * 1.02;
            grid.within(body.at, reach, |near| any = any || body.touches(&self.present(near.row as usize)));
            flags.push(any);
        }
        let taken = halo.agree(Agreement { flags, ..Agreement::default() }).flags;
        let mut entered: Vec<&Entering> = Vec::new();
        for (((time, agent), body), taken) in due.into_iter().zip(&bodies).zip(taken) {
            if taken || entered.iter().any(|other| body.touches(other)) || self.no_room_for(&agent).is_some() {
                self.schedule.add(time, agent);
                continue;
            }
            entered.push(body);
            if halo.owner(body.at) == halo.index() {
                let number = agent.number.unwrap_or_default();
                self.put(&agent, number, now);
                self.happened(self.agents.len() - 1, EventKind::Entered, now);
            }
        }
    }

    /// Returns the body of an agent that enters.
    fn entering(&self, agent: &Agent) -> Entering {
        Entering {
            at: (agent.position.truncate() - self.settings.origin).as_vec2(),
            altitude: agent.position.z,
            heading: self.first_heading(agent),
            body: agent.body(),
        }
    }

    /// Returns the body of an agent that is present.
    fn present(&self, row: usize) -> Entering {
        let agents = &self.agents;
        let altitude = agents.altitude[row].into();
        Entering { at: agents.position[row], altitude, heading: agents.heading[row], body: agents.body(row) }
    }
}

/// A body where an agent enters.
struct Entering {
    at: Vec2,
    altitude: f64,
    heading: f32,
    body: Body,
}

impl Entering {
    /// Whether a body that enters touches one that is there, or nearly so.
    fn touches(&self, other: &Self) -> bool {
        let is_disc = |one: &Self| one.body.core == Vec2::ZERO;
        let distance = if is_disc(self) && is_disc(other) {
            // present agents have their altitudes in `f32`
            let there = other.at.as_dvec2().extend(f64::from(other.altitude as f32));
            there.distance(self.at.as_dvec2().extend(self.altitude))
        } else {
            self.core().separation(&other.core()).distance
        };
        distance < (f64::from(other.body.radius) + f64::from(self.body.radius)) * 1.01
    }

    fn core(&self) -> Core {
        Core::new(self.at.as_dvec2(), self.heading, self.body.core)
    }
}
