//! The state of a world, apart from the memory of its step.

use super::control::OwnJourneys;
use super::events::Event;
use super::play::RulesState;
use super::schedule::Schedule;
use super::{Settings, TraceRequest};
use crate::agent::{AgentId, Column, Columns, GoalId, Group, JourneyId};
use crate::halo::Others;
use crate::intend::{Adapted, Standoff};
use crate::navigate::{Goal, Journey, Legs, Meshes, Script, Unreachable};
use crate::perceive::SimdLevel;
use crate::random::Rng;
use crate::space::{Place, Walls};
use crate::steer::Stimulus;
use crate::summary::Tally;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// The state of a world: all that a step reads, and all that it changes.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub settings: Settings,
    pub steps: u64,
    pub agents: Columns,
    pub slots: Slots,
    /// Groups as they were given, in local coordinates, and whether they have agents.
    pub groups: Vec<Group>,
    pub local_groups: Vec<Group>,
    pub groups_with_agents: Vec<bool>,
    pub goals: Vec<Goal>,
    pub journeys: Vec<Journey>,
    /// Journeys that are alternatives to each other.
    pub choices: Vec<Vec<JourneyId>>,
    pub scripts: Vec<Script>,
    pub place: Place,
    pub schedule: Schedule,
    pub tally: Tally,
    /// Agents that cannot reach their goals, by number, with the reasons.
    pub stranded: Vec<(u32, Unreachable)>,
    /// Standoffs that are being resolved.
    pub standoffs: Vec<Standoff>,
    /// Recent stimuli, read by steering behaviours.
    pub stimuli: Vec<Stimulus>,
    /// The events of the last step.
    pub events: Vec<Event>,
    pub own_journeys: OwnJourneys,
    pub game: RulesState,
    /// Fields that adapt to the positions of the agents, by group.
    pub adapted: Vec<Option<Adapted>>,
    /// The other worlds of a division.
    pub others: Others,
    /// Box of the ground on which paths are planned where no walkable area bounds it. It is kept, because meshes that
    /// are built later for another box would differ.
    pub extent: Option<(DVec2, DVec2)>,

    // derived from the fields above whenever needed
    pub walls: Walls,
    pub meshes: Meshes,
    pub legs: Legs,
    pub instructions: SimdLevel,
    pub traced: TraceRequest,
}

/// The row of each id.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Slots {
    /// The row of the agent in each slot; `u32::MAX` for an empty slot.
    pub rows: Vec<u32>,
    /// How many agents had the slot before.
    pub generations: Column<u32>,
    pub free: Vec<u32>,
    pub next_number: u32,
}

impl State {
    /// Returns the seconds since the start.
    pub(crate) fn time(&self) -> f64 {
        self.steps as f64 * self.settings.step
    }

    /// Returns the rows of the agents of this world. The rows behind them are ghosts.
    #[inline]
    pub(crate) fn own(&self) -> std::ops::Range<usize> {
        0..self.agents.len() - self.others.ghosts
    }

    /// Returns the number of whole intervals, each of `interval` seconds, in this number of steps.
    pub(crate) fn ticks(&self, steps: u64, interval: f64) -> u64 {
        (steps as f64 * self.settings.step / interval + 1e-9).floor() as u64
    }

    /// Whether any agent is above the ground, moves vertically, or may start to.
    pub(crate) fn in_space_now(&self) -> bool {
        let agents = &self.agents;
        let rises = agents.commanded.values().iter().flatten().any(|velocity| velocity.z != 0.0);
        let in_air = rises || agents.any_flies() || agents.vertical_velocity.uniform() != Some(0.0);
        in_air || self.legs.lead_up() || self.any_vehicle_flies()
    }

    /// Whether an agent needs a local model. A script needs none, and a vehicle without avoidance has limited its
    /// velocity itself.
    pub(crate) fn needs_model(&self, row: usize) -> bool {
        self.agents.script[row].is_none() && (!self.has_vehicle(row) || self.model(row).avoids())
    }

    /// Whether all agents need a local model.
    pub(crate) fn all_need_model(&self) -> bool {
        let Columns { script, vehicle, .. } = &self.agents;
        let avoid = || self.groups_in_use().all(|group| group.model.avoids());
        script.uniform() == Some(None) && (vehicle.uniform() == Some(None) || avoid())
    }

    /// Whether any agent needs a local model, or follows a script and is limited as if it did.
    pub(crate) fn any_needs_model(&self) -> bool {
        let Columns { script, vehicle, .. } = &self.agents;
        script.uniform() != Some(None)
            || vehicle.values().iter().any(Option::is_none)
            || self.groups_in_use().any(|group| group.model.avoids())
    }

    /// Returns the id of the agent in a row.
    pub(crate) fn id(&self, row: usize) -> AgentId {
        let slot = self.agents.slot[row];
        AgentId { slot, generation: self.slots.generations[slot as usize] }
    }

    /// Returns the row of an agent, valid until the next sub-step; `None` if it has been removed.
    pub(crate) fn row(&self, id: AgentId) -> Option<usize> {
        let &row = self.slots.rows.get(id.slot as usize)?;
        (row != u32::MAX && self.slots.generations[id.slot as usize] == id.generation).then_some(row as usize)
    }

    /// Returns the goal that an agent walks to; `None` if its journey has ended or has no stops.
    pub(crate) fn goal_of(&self, row: usize) -> Option<GoalId> {
        let journey = &self.journeys[self.agents.journey[row].index()];
        journey.stops.get(self.agents.travel[row].leg as usize).map(|stop| stop.goal)
    }

    /// Returns the random number generator of an agent in this sub-step.
    pub(crate) fn rng(&self, row: usize) -> Rng {
        Rng { seed: self.settings.seed, number: self.agents.number[row], step: self.tally.sub_steps }
    }
}
