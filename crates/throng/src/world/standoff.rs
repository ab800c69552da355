//! Standoffs: where agents block each other's paths and cannot pass, some step aside and let the other agents by.
//!
//! After the local planning for stuck groups of Dergachev and Yakovlev, CASE 2021 (arXiv 2107.00246), with paths in
//! place of plans in time. Two agents that get no nearer to their goals and stand in each other's way agree, together
//! with the agents around them, which side goes first. The agents of the other side go to the nearest places off its
//! path, wait there, and continue when it has passed.

use super::{State, World};
use super::agree::StandoffAgreement;
use crate::agent::{AgentId, Status};
use crate::navigate::{Route, Turn};
use serde::{Deserialize, Serialize};

/// Time without progress by one radius, in walked radii at the preferred speed, after which an agent looks for a
/// partner. It looks again each time this time has doubled. At 1.3 m/s and 0.2 m it is 0.3 s.
const LOOKS: f32 = 2.0;
/// The same for an agent that is stuck where two agents could pass: 2.5 s.
const STUCK: f32 = 16.0;
/// Distance, in sums of radii, within which two agents block each other; and the distance where the path is too narrow
/// for two.
const CLOSE: f32 = 1.6;
const CLOSE_IF_NARROW: f32 = 8.0;
/// Factor on the expected duration of a standoff for which agents wait, and seconds added to it.
const PATIENCE: f32 = 2.0;
const GRACE: f32 = 5.0;
/// Seconds between two searches for newcomers.
const LOOK: f32 = 0.5;

/// Agents that go first, and agents that step aside for them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Standoff {
    first: Vec<First>,
    aside: Vec<AgentId>,
    /// Seconds after which the standoff ends in any case.
    left: f32,
}

/// An agent that goes first: the leg it is on, and the distance to its goal, metres, at which it is past all agents
/// that stepped aside.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct First {
    agent: AgentId,
    leg: u32,
    past: f32,
}

impl World {
    /// Ends standoffs that are over, and lets stuck agents agree on new ones.
    pub(super) fn resolve(&mut self, seconds: f32) {
        let mut standoffs = std::mem::take(&mut self.state.standoffs);
        standoffs.retain_mut(|standoff| self.go_on(standoff, seconds));
        self.state.standoffs = standoffs;
        if self.state.groups_in_use().all(|group| !group.resolve) {
            return;
        }
        let mut stuck = std::mem::take(&mut self.step.stuck);
        self.find_stuck(seconds, &mut stuck);
        for &row in &stuck {
            if let Some(agreement) = self.partner(row).and_then(|other| self.agree(row, other)) {
                self.begin(agreement);
            }
        }
        self.step.stuck = stuck;
    }

    /// Finds the stuck agents that look for a partner in this sub-step, sorted by number.
    fn find_stuck(&self, seconds: f32, rows: &mut Vec<usize>) {
        let agents = &self.state.agents;
        let looks = |&row: &usize| {
            let stalled = agents.travel[row].stalled;
            let before = || stalled - seconds * agents.preferred_speed[row] / agents.radius[row];
            stalled >= LOOKS && libm::log2f(stalled).floor() > libm::log2f(before().max(0.5 * LOOKS)).floor()
        };
        rows.clear();
        rows.extend(self.step.rest.awake(0..agents.len()).flatten().filter(looks));
        rows.sort_unstable_by_key(|&row| agents.number[row]);
    }

    /// Returns the nearest agent with which it blocks each other's paths, if both are stuck.
    fn partner(&self, row: usize) -> Option<usize> {
        let agents = &self.state.agents;
        // in the open only stuck agents agree
        let may_be_narrow = self.state.meshes.mesh(agents.body(row).clearance_radius()).is_some();
        // an agent that joined a standoff in this sub-step already has a partner
        if !self.state.may_resolve(row) || agents.travel[row].stalled < STUCK && !may_be_narrow {
            return None;
        }
        let nearest = self.neighbours(row).iter().map(|&other| other as usize).find(|&other| {
            agents.travel[other].stalled >= 0.5 * LOOKS && self.state.may_resolve(other) && self.state.opposed(row, other)
        });
        nearest.filter(|&other| {
            let close =
                agents.position[row].distance(agents.position[other]) / (agents.radius[row] + agents.radius[other]);
            let stuck = agents.travel[row].stalled >= STUCK && agents.travel[other].stalled >= 0.5 * STUCK;
            stuck && close < CLOSE || close < CLOSE_IF_NARROW && self.state.is_narrow(row, other)
        })
    }

    fn begin(&mut self, agreement: StandoffAgreement) {
        let agents = &self.state.agents;
        let way =
            agreement.first.iter().map(|&(row, past)| self.step.shown[row].way.remaining - past).fold(0.0, f32::max);
        let retreat = agreement.aside.iter().map(|(_, path)| path.length as f32).fold(0.0, f32::max);
        let slowest = agreement.first.iter().map(|&(row, _)| agents.preferred_speed[row]).fold(f32::INFINITY, f32::min);
        let first = |&(row, past): &(usize, f32)| First { agent: self.state.id(row), leg: self.state.agents.travel[row].leg, past };
        let standoff = Standoff {
            first: agreement.first.iter().map(first).collect(),
            aside: agreement.aside.iter().map(|&(row, _)| self.state.id(row)).collect(),
            left: PATIENCE * (way + retreat) / slowest + GRACE,
        };
        for (row, _) in agreement.first {
            self.state.agents.travel[row].take(Turn::First);
        }
        for (row, path) in agreement.aside {
            self.state.agents.travel[row].step_aside(Route::new(&path));
        }
        self.state.tally.standoffs += 1;
        self.state.standoffs.push(standoff);
    }

    /// Updates a standoff. Returns whether it continues: an agent that goes first is not yet past the agents that
    /// stepped aside.
    fn go_on(&mut self, standoff: &mut Standoff, seconds: f32) -> bool {
        let before = standoff.left;
        standoff.left -= seconds;
        standoff.first.retain(|first| {
            let Some(row) = self.state.row(first.agent) else { return false };
            let walks = self.state.agents.status[row] == Status::Walking;
            let remaining = self.step.shown[row].way.remaining;
            let travel = &mut self.state.agents.travel[row];
            let mine = travel.turn == Turn::First && travel.leg == first.leg;
            let passes = mine && walks && remaining > first.past && standoff.left > 0.0;
            if mine && !passes {
                travel.take(Turn::Free);
            }
            passes
        });
        if standoff.first.is_empty() {
            for row in self.state.rows_of(&standoff.aside) {
                self.state.agents.travel[row].give_up_turn();
            }
        } else if (before / LOOK).floor() > (standoff.left / LOOK).floor() {
            self.join(standoff);
        }
        !standoff.first.is_empty()
    }

    /// Makes agents that come towards the agents that go first step aside too.
    fn join(&mut self, standoff: &mut Standoff) {
        let first: Vec<AgentId> = standoff.first.iter().map(|first| first.agent).collect();
        for (row, path) in self.newcomers(&self.state.rows_of(&first), &self.state.rows_of(&standoff.aside)) {
            standoff.aside.push(self.state.id(row));
            self.state.agents.travel[row].step_aside(Route::new(&path));
        }
    }
}

impl State {
    /// Whether an agent can join an agreement. Agents in the air cannot: they have another way out, above or below.
    pub(crate) fn may_resolve(&self, row: usize) -> bool {
        let agents = &self.agents;
        agents.status[row] == Status::Walking
            && agents.travel[row].turn == Turn::Free
            && agents.altitude[row] == 0.0
            && agents.script[row].is_none()
            && self.local_groups[agents.group[row].index()].resolve
    }

    fn rows_of(&self, ids: &[AgentId]) -> Vec<usize> {
        ids.iter().filter_map(|&id| self.row(id)).collect()
    }

    /// Ends all standoffs.
    pub(crate) fn end_standoffs(&mut self) {
        self.standoffs.clear();
        for travel in &mut self.agents.travel {
            travel.give_up_turn();
        }
    }
}
