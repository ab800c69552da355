//! Standoffs: where agents block each other's paths and cannot pass, some step aside and let the other agents by.
//!
//! After the local planning for stuck groups of Dergachev and Yakovlev, CASE 2021 (arXiv 2107.00246), with paths in
//! place of plans in time. Two agents that get no nearer to their goals and stand in each other's way agree, together
//! with the agents around them, which side goes first. The agents of the other side go to the nearest places off its
//! path, wait there, and continue when it has passed.

use super::agree::{StandoffAgreement, StandoffView};
use super::standoff_division::run_divided;
use crate::agent::{AgentId, Status};
use crate::halo::Link;
use crate::navigate::{NeighbourData, Path, Route, RouteProgress, Turn};
use crate::perceive::Perceived;
use crate::sleep::SleepBlocks;
use crate::world::State;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// Time without progress by one radius, in walked radii at the preferred speed, after which an agent looks for a
/// partner. It looks again each time this time has doubled. At 1.3 m/s and 0.2 m it is 0.3 s.
const LOOKS: f32 = 2.0;
/// The same for an agent that is stuck where two agents could pass: 2.5 s.
const STUCK: f32 = 16.0;
/// Distance, in sums of radii, within which two agents block each other; and the distance where the path is too narrow
/// for two.
const CLOSE: f32 = 1.6;
pub(super) const CLOSE_IF_NARROW: f32 = 8.0;
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

/// An agent of a standoff. Its id leads to its row in an undivided world; a world of a division finds it by its number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Member {
    number: u32,
    id: AgentId,
}

/// Rows by the numbers of their agents, in a world of a division. In an undivided world it is empty.
pub(super) type RowsByNumber = BTreeMap<u32, usize>;

/// An agent that goes first: the leg it is on, and the distance to its goal, metres, at which it is past all agents
/// that stepped aside.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct First {
    agent: Member,
    leg: u32,
    past: f32,
}

/// A standoff that begins, with the paths of the agents that step aside, in their order.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct NewStandoff {
    standoff: Standoff,
    retreats: Vec<Path>,
}

/// Agents that join a standoff: they step aside along their paths.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Newcomers(Vec<(Member, Path)>);

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
        link: &mut Link<'_>,
    ) {
        let remaining = &|row: usize| shown[row].way.remaining;
        if state.others.are_there {
            if state.others.any_standoff {
                self.find_stuck(state, sleep, seconds);
                run_divided(state, seen, remaining, &self.stuck, seconds, link);
            }
            return;
        }
        let rows = RowsByNumber::new();
        let passing = state.members_that_pass(remaining, &rows);
        let looking = state.update_standoffs(&passing, &rows, seconds);
        for index in looking {
            let view = StandoffView { state, grid: seen.grid, rows: None, remaining };
            let newcomers = view.newcomers_of(&state.standoffs[index], &rows);
            state.join_standoff(index, newcomers, &rows);
        }
        if state.groups_in_use().all(|group| !group.resolve) {
            return;
        }
        self.find_stuck(state, sleep, seconds);
        for &row in &self.stuck {
            let view = StandoffView { state, grid: seen.grid, rows: None, remaining };
            if let Some(new) = view.new_standoff(row, seen.near.of(row)) {
                state.tally.standoffs += 1;
                state.begin_standoff(new, &rows);
            }
        }
    }

    /// Finds the stuck agents that look for a partner in this sub-step, sorted by number.
    fn find_stuck(&mut self, state: &State, sleep: &SleepBlocks, seconds: f32) {
        let agents = &state.agents;
        self.stuck.clear();
        let rows = sleep.awake(state.own()).flatten();
        self.stuck.extend(rows.filter(|&row| state.looks_for_partner(row, seconds) && state.may_seek(row)));
        self.stuck.sort_unstable_by_key(|&row| agents.number[row]);
    }
}

impl Standoff {
    /// Updates a standoff. Returns whether it continues: an agent that goes first is not yet past the agents that
    /// stepped aside.
    fn go_on(&mut self, state: &mut State, passing: &BTreeSet<u32>, rows: &RowsByNumber, seconds: f32) -> bool {
        self.left -= seconds;
        let left = self.left;
        self.first.retain(|first| {
            let passes = left > 0.0 && passing.contains(&first.agent.number);
            if let Some(row) = state.row_of(first.agent, rows).filter(|_| !passes) {
                let travel = &mut state.agents.travel[row];
                if first.has_turn(travel) {
                    travel.take(Turn::Free);
                }
            }
            passes
        });
        if self.first.is_empty() {
            for row in state.rows_of(&self.aside, rows) {
                state.agents.travel[row].give_up_turn();
            }
        }
        !self.first.is_empty()
    }

    /// Returns the numbers of all its agents.
    pub fn numbers(&self) -> impl Iterator<Item = u32> + '_ {
        self.first.iter().map(|first| first.agent.number).chain(self.aside.iter().map(|member| member.number))
    }

    /// Whether it looks for newcomers in a sub-step that begins.
    pub fn looks_for_newcomers(&self, seconds: f32) -> bool {
        (self.left / LOOK).floor() > ((self.left - seconds) / LOOK).floor()
    }
}

impl First {
    /// Whether the agent still goes first, on the same leg.
    fn has_turn(&self, travel: &RouteProgress) -> bool {
        travel.turn == Turn::First && travel.leg == self.leg
    }
}

impl NewStandoff {
    /// Returns the numbers of its agents.
    pub fn numbers(&self) -> impl Iterator<Item = u32> + '_ {
        self.standoff.numbers()
    }
}

impl Newcomers {
    /// Returns the numbers of the agents.
    pub fn numbers(&self) -> impl Iterator<Item = u32> + '_ {
        self.0.iter().map(|(member, _)| member.number)
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl StandoffView<'_> {
    /// Returns the standoff that a stuck agent begins with its partner. `near` are its neighbours, nearest first.
    pub fn new_standoff(&self, row: usize, near: &[u32]) -> Option<NewStandoff> {
        let other = self.partner(row, near)?;
        let StandoffAgreement { first, aside } = self.agree(row, other)?;
        let (state, agents) = (self.state, &self.state.agents);
        let way = first.iter().map(|&(row, past)| (self.remaining)(row) - past).fold(0.0, f32::max);
        let retreat = aside.iter().map(|(_, path)| path.length as f32).fold(0.0, f32::max);
        let slowest = first.iter().map(|&(row, _)| agents.preferred_speed[row]).fold(f32::INFINITY, f32::min);
        let goes = |&(row, past): &(usize, f32)| First { agent: state.member(row), leg: agents.travel[row].leg, past };
        let standoff = Standoff {
            first: first.iter().map(goes).collect(),
            aside: aside.iter().map(|&(row, _)| state.member(row)).collect(),
            left: PATIENCE * (way + retreat) / slowest + GRACE,
        };
        Some(NewStandoff { standoff, retreats: aside.into_iter().map(|(_, path)| path).collect() })
    }

    /// Returns the nearest agent with which it blocks each other's paths, if both are stuck.
    fn partner(&self, row: usize, near: &[u32]) -> Option<usize> {
        let state = self.state;
        // an agent that joined a standoff in this sub-step already has a partner
        if !state.may_seek(row) {
            return None;
        }
        let mut near = near.iter().map(|&other| other as usize);
        let nearest = near.find(|&other| state.may_be_partner(other) && state.opposed(row, other));
        nearest.filter(|&other| state.block_each_other(row, other))
    }

    /// Returns the agents that come towards the agents of a standoff that go first.
    pub fn newcomers_of(&self, standoff: &Standoff, rows: &RowsByNumber) -> Newcomers {
        let first: Vec<Member> = standoff.first.iter().map(|first| first.agent).collect();
        let all = self.newcomers(&self.state.rows_of(&first, rows), &self.state.rows_of(&standoff.aside, rows));
        Newcomers(all.into_iter().map(|(row, path)| (self.state.member(row), path)).collect())
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

    /// Whether a standoff goes on in the sub-step that begins, or an own agent may look for a partner.
    pub(crate) fn any_standoff(&self, seconds: f32) -> bool {
        let looks = |row| self.looks_for_partner(row, seconds) && self.may_resolve(row);
        !self.standoffs.is_empty() || self.own().any(looks)
    }

    /// Whether an agent that looks for a partner may agree with one. In the open only agents that are stuck agree.
    pub(super) fn may_seek(&self, row: usize) -> bool {
        let may_be_narrow = || self.meshes.mesh(self.agents.body(row).clearance_radius()).is_some();
        self.may_resolve(row) && (self.agents.travel[row].stalled >= STUCK || may_be_narrow())
    }

    /// Whether an agent may be the partner of an agent that it blocks.
    pub(super) fn may_be_partner(&self, row: usize) -> bool {
        self.agents.travel[row].stalled >= 0.5 * LOOKS && self.may_resolve(row)
    }

    /// Whether two agents on opposed paths are so close that they block each other: both are stuck, or the path is narrow.
    pub(super) fn block_each_other(&self, row: usize, other: usize) -> bool {
        let agents = &self.agents;
        let close = agents.position[row].distance(agents.position[other]) / (agents.radius[row] + agents.radius[other]);
        let stuck = agents.travel[row].stalled >= STUCK && agents.travel[other].stalled >= 0.5 * STUCK;
        stuck && close < CLOSE || close < CLOSE_IF_NARROW && self.is_narrow(row, other)
    }

    /// Returns the numbers of the own agents that go first in a standoff and are not past the agents that stepped aside.
    pub(super) fn members_that_pass(&self, remaining: &dyn Fn(usize) -> f32, rows: &RowsByNumber) -> BTreeSet<u32> {
        let passes = |first: &&First| {
            self.row_of(first.agent, rows).filter(|row| self.own().contains(row)).is_some_and(|row| {
                let walks = self.agents.status[row] == Status::Walking;
                walks && first.has_turn(&self.agents.travel[row]) && remaining(row) > first.past
            })
        };
        let first = self.standoffs.iter().flat_map(|standoff| &standoff.first);
        first.filter(passes).map(|first| first.agent.number).collect()
    }

    /// Ends the standoffs that are over. Returns the indices of those that look for newcomers in the sub-step.
    pub(super) fn update_standoffs(
        &mut self,
        passing: &BTreeSet<u32>,
        rows: &RowsByNumber,
        seconds: f32,
    ) -> Vec<usize> {
        // taken out, because standoffs change the agents
        let (mut standoffs, mut looking) = (std::mem::take(&mut self.standoffs), Vec::new());
        standoffs.retain_mut(|standoff| {
            let looks = standoff.looks_for_newcomers(seconds);
            let goes_on = standoff.go_on(self, passing, rows, seconds);
            looking.extend(goes_on.then_some(looks));
            goes_on
        });
        self.standoffs = standoffs;
        (0..looking.len()).filter(|&index| looking[index]).collect()
    }

    /// Begins a standoff: the agents take their turns.
    pub(super) fn begin_standoff(&mut self, new: NewStandoff, rows: &RowsByNumber) {
        self.take_turns(&new, rows);
        self.standoffs.push(new.standoff);
    }

    /// Gives the agents of a standoff that begins their turns.
    pub(super) fn take_turns(&mut self, NewStandoff { standoff, retreats }: &NewStandoff, rows: &RowsByNumber) {
        for first in &standoff.first {
            if let Some(row) = self.row_of(first.agent, rows) {
                self.agents.travel[row].take(Turn::First);
            }
        }
        for (&member, path) in standoff.aside.iter().zip(retreats) {
            self.step_aside(member, path, rows);
        }
    }

    /// Lets agents join a standoff.
    pub(super) fn join_standoff(&mut self, index: usize, newcomers: Newcomers, rows: &RowsByNumber) {
        self.make_room(&newcomers, rows);
        self.standoffs[index].aside.extend(newcomers.0.into_iter().map(|(member, _)| member));
    }

    /// Makes newcomers step aside.
    pub(super) fn make_room(&mut self, newcomers: &Newcomers, rows: &RowsByNumber) {
        for (member, path) in &newcomers.0 {
            self.step_aside(*member, path, rows);
        }
    }

    fn step_aside(&mut self, member: Member, path: &Path, rows: &RowsByNumber) {
        if let Some(row) = self.row_of(member, rows) {
            self.agents.travel[row].step_aside(Route::new(path));
        }
    }

    fn member(&self, row: usize) -> Member {
        // rows behind the own ones have no id here
        let id = if self.own().contains(&row) { self.id(row) } else { AgentId { slot: u32::MAX, generation: 0 } };
        Member { number: self.agents.number[row], id }
    }

    /// Returns the row of an agent of a standoff.
    fn row_of(&self, member: Member, rows: &RowsByNumber) -> Option<usize> {
        if self.others.are_there { rows.get(&member.number).copied() } else { self.row(member.id) }
    }

    fn rows_of(&self, members: &[Member], rows: &RowsByNumber) -> Vec<usize> {
        members.iter().filter_map(|&member| self.row_of(member, rows)).collect()
    }

    /// Ends all standoffs.
    pub(crate) fn end_standoffs(&mut self) {
        self.standoffs.clear();
        for travel in &mut self.agents.travel {
            travel.give_up_turn();
        }
    }
}
