//! Standoffs: where agents block each other's paths and cannot pass, some step aside and let the other agents by.
//!
//! After the local planning for stuck groups of Dergachev and Yakovlev, CASE 2021 (arXiv 2107.00246), with paths in
//! place of plans in time. Two agents that get no nearer to their goals and stand in each other's way agree, together
//! with the agents around them, which side goes first. The agents of the other side go to the nearest places off its
//! path, wait there, and continue when it has passed.

use super::agree::{StandoffAgreement, StandoffView};
use crate::agent::{AgentId, Status};
use crate::navigate::{NeighbourData, Route, Turn};
use crate::perceive::Perceived;
use crate::sleep::SleepBlocks;
use crate::world::State;
use glam::Vec2;
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
pub(crate) struct Standoff {
    first: Vec<First>,
    aside: Vec<Member>,
    /// Seconds after which the standoff ends in any case.
    left: f32,
}

/// An agent of a standoff. Its id leads to its row fast; another world of a division finds it by its number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Member {
    number: u32,
    id: AgentId,
}

/// An agent that goes first: the leg it is on, and the distance to its goal, metres, at which it is past all agents
/// that stepped aside.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct First {
    agent: Member,
    leg: u32,
    past: f32,
}

/// The search for stuck agents.
#[derive(Clone, Debug, Default)]
pub(super) struct Standoffs {
    stuck: Vec<usize>,
}

impl Standoffs {
    /// Ends standoffs that are over, and lets stuck agents agree on new ones.
    pub fn run(
        &mut self,
        state: &mut State,
        seen: Perceived<'_>,
        shown: &[NeighbourData],
        sleep: &SleepBlocks,
        seconds: f32,
    ) {
        // taken out, because standoffs change the agents
        let mut standoffs = std::mem::take(&mut state.standoffs);
        standoffs.retain_mut(|standoff| standoff.go_on(state, seen, shown, seconds));
        state.standoffs = standoffs;
        if state.groups_in_use().all(|group| !group.resolve) {
            return;
        }
        self.find_stuck(state, sleep, seconds);
        for &row in &self.stuck {
            let view = StandoffView { state, near: seen.near, grid: seen.grid, shown };
            if let Some(agreement) = view.partner(row).and_then(|other| view.agree(row, other)) {
                let standoff = Standoff::begin(agreement, state, shown);
                state.tally.standoffs += u64::from(state.own().contains(&row));
                state.standoffs.push(standoff);
            }
        }
    }

    /// Finds the stuck agents that look for a partner in this sub-step, sorted by number.
    fn find_stuck(&mut self, state: &State, sleep: &SleepBlocks, seconds: f32) {
        let agents = &state.agents;
        self.stuck.clear();
        let rows = sleep.awake(0..agents.len()).flatten();
        self.stuck.extend(rows.filter(|&row| state.looks_for_partner(row, seconds)));
        self.stuck.sort_unstable_by_key(|&row| agents.number[row]);
    }
}

impl Standoff {
    /// Begins a standoff: the agents take their turns.
    fn begin(agreement: StandoffAgreement, state: &mut State, shown: &[NeighbourData]) -> Self {
        let agents = &state.agents;
        let way = agreement.first.iter().map(|&(row, past)| shown[row].way.remaining - past).fold(0.0, f32::max);
        let retreat = agreement.aside.iter().map(|(_, path)| path.length as f32).fold(0.0, f32::max);
        let slowest = agreement.first.iter().map(|&(row, _)| agents.preferred_speed[row]).fold(f32::INFINITY, f32::min);
        let first =
            |&(row, past): &(usize, f32)| First { agent: state.member(row), leg: state.agents.travel[row].leg, past };
        let standoff = Self {
            first: agreement.first.iter().map(first).collect(),
            aside: agreement.aside.iter().map(|&(row, _)| state.member(row)).collect(),
            left: PATIENCE * (way + retreat) / slowest + GRACE,
        };
        for (row, _) in agreement.first {
            state.agents.travel[row].take(Turn::First);
        }
        for (row, path) in agreement.aside {
            state.agents.travel[row].step_aside(Route::new(&path));
        }
        standoff
    }

    /// Updates a standoff. Returns whether it continues: an agent that goes first is not yet past the agents that
    /// stepped aside.
    fn go_on(&mut self, state: &mut State, seen: Perceived<'_>, shown: &[NeighbourData], seconds: f32) -> bool {
        let before = self.left;
        self.left -= seconds;
        let left = self.left;
        self.first.retain(|first| {
            let Some(row) = state.row_of(first.agent) else { return false };
            let walks = state.agents.status[row] == Status::Walking;
            let remaining = shown[row].way.remaining;
            let travel = &mut state.agents.travel[row];
            let mine = travel.turn == Turn::First && travel.leg == first.leg;
            let passes = mine && walks && remaining > first.past && left > 0.0;
            if mine && !passes {
                travel.take(Turn::Free);
            }
            passes
        });
        if self.first.is_empty() {
            for row in state.rows_of(&self.aside) {
                state.agents.travel[row].give_up_turn();
            }
        } else if looks_for_newcomers(before, seconds) {
            self.join(state, seen, shown);
        }
        !self.first.is_empty()
    }

    /// Returns all its agents.
    fn members(&self) -> impl Iterator<Item = Member> + '_ {
        self.first.iter().map(|first| first.agent).chain(self.aside.iter().copied())
    }

    /// Makes agents that come towards the agents that go first step aside too.
    fn join(&mut self, state: &mut State, seen: Perceived<'_>, shown: &[NeighbourData]) {
        let first: Vec<Member> = self.first.iter().map(|first| first.agent).collect();
        let view = StandoffView { state, near: seen.near, grid: seen.grid, shown };
        for (row, path) in view.newcomers(&state.rows_of(&first), &state.rows_of(&self.aside)) {
            self.aside.push(state.member(row));
            state.agents.travel[row].step_aside(Route::new(&path));
        }
    }
}

/// Whether a standoff with this time left looks for newcomers in a sub-step.
fn looks_for_newcomers(left: f32, seconds: f32) -> bool {
    (left / LOOK).floor() > ((left - seconds) / LOOK).floor()
}

impl StandoffView<'_> {
    /// Returns the nearest agent with which it blocks each other's paths, if both are stuck.
    fn partner(&self, row: usize) -> Option<usize> {
        let agents = &self.state.agents;
        // in the open only stuck agents agree
        let may_be_narrow = self.state.meshes.mesh(agents.body(row).clearance_radius()).is_some();
        // an agent that joined a standoff in this sub-step already has a partner
        if !self.state.may_resolve(row) || agents.travel[row].stalled < STUCK && !may_be_narrow {
            return None;
        }
        let nearest = self.near.of(row).iter().map(|&other| other as usize).find(|&other| {
            agents.travel[other].stalled >= 0.5 * LOOKS
                && self.state.may_resolve(other)
                && self.state.opposed(row, other)
        });
        nearest.filter(|&other| {
            let close =
                agents.position[row].distance(agents.position[other]) / (agents.radius[row] + agents.radius[other]);
            let stuck = agents.travel[row].stalled >= STUCK && agents.travel[other].stalled >= 0.5 * STUCK;
            stuck && close < CLOSE || close < CLOSE_IF_NARROW && self.state.is_narrow(row, other)
        })
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

    /// Whether an agent has been stuck for so long that it looks for a partner in this sub-step.
    fn looks_for_partner(&self, row: usize, seconds: f32) -> bool {
        let stalled = self.agents.travel[row].stalled;
        let before = || stalled - seconds * self.agents.preferred_speed[row] / self.agents.radius[row];
        stalled >= LOOKS && libm::log2f(stalled).floor() > libm::log2f(before().max(0.5 * LOOKS)).floor()
    }

    /// Returns the numbers of the agents in standoffs, sorted, and the places around which standoffs may begin or look for
    /// newcomers in the sub-step that begins: those of own agents.
    pub(crate) fn standoffs_that_begin(&self, seconds: f32) -> (Vec<u32>, Vec<Vec2>) {
        let mut members: Vec<u32> =
            self.standoffs.iter().flat_map(Standoff::members).map(|member| member.number).collect();
        members.sort_unstable();
        let looking = self.standoffs.iter().filter(|standoff| looks_for_newcomers(standoff.left, seconds));
        let mut looking: Vec<u32> = looking.flat_map(Standoff::members).map(|member| member.number).collect();
        looking.sort_unstable();
        let begins = |&row: &usize| {
            self.looks_for_partner(row, seconds) && self.may_resolve(row)
                || looking.binary_search(&self.agents.number[row]).is_ok()
        };
        (members, self.own().filter(begins).map(|row| self.agents.position[row]).collect())
    }

    fn member(&self, row: usize) -> Member {
        let number = self.agents.number[row];
        // a ghost has no id here
        let id = if self.own().contains(&row) { self.id(row) } else { AgentId { slot: u32::MAX, generation: 0 } };
        Member { number, id }
    }

    /// Returns the row of an agent of a standoff.
    fn row_of(&self, member: Member) -> Option<usize> {
        let numbers = &self.agents.number;
        match self.row(member.id).filter(|&row| numbers[row] == member.number) {
            None if self.others.are_there => numbers.iter().position(|&number| number == member.number),
            row => row,
        }
    }

    fn rows_of(&self, members: &[Member]) -> Vec<usize> {
        members.iter().filter_map(|&member| self.row_of(member)).collect()
    }

    /// Ends all standoffs.
    pub(crate) fn end_standoffs(&mut self) {
        self.standoffs.clear();
        for travel in &mut self.agents.travel {
            travel.give_up_turn();
        }
    }
}
