//! The exchanges of a step: agents that change their world, ghosts, and what is computed for ghosts elsewhere.

use super::packet::{BROKEN, read, write};
use super::{Agreement, Halo};
use crate::agent::{GoalId, Row};
use crate::guard::{Clamping, Spreading};
use crate::intend::{STANDOFF_REACH, Velocities, set};
use crate::navigate::{Arrivals, Unreachable};
use crate::perceive::Grid;
use crate::world::State;
use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::Range;

/// Contacts beyond the rounds of a batch up to which ghosts must be known: 2 for complete lists of contacts, 4 for the
/// relaxations, 2 for the places of ghosts after the motion.
const CONTACTS: usize = 8;
/// Least and greatest number of rounds of clamping between two exchanges.
const LEAST_ROUNDS: usize = 2;
const MOST_ROUNDS: usize = 64;

/// What a division adds to the state of a world. Of a world alone: nothing.
#[derive(Clone, Debug)]
pub(crate) struct Others {
    /// Whether the world is one of a division.
    pub are_there: bool,
    /// Number of rows, the last ones, that are ghosts.
    pub ghosts: usize,
    /// Whether an agent of any world may be guarded, and the least radius of all agents, metres. Of a step.
    pub any_guarded: bool,
    pub least_radius: f32,
}

impl Default for Others {
    fn default() -> Self {
        Self { are_there: false, ghosts: 0, any_guarded: false, least_radius: f32::INFINITY }
    }
}

/// An agent that changes its world, with the reason why it cannot reach its goal.
#[derive(Serialize, Deserialize)]
struct Migrant {
    row: Row,
    stranded: Option<Unreachable>,
}

/// The border of a world of a division: which of its rows other worlds have as ghosts, and the other way round.
#[derive(Clone, Debug)]
pub(crate) struct Border {
    /// Own rows that are ghosts elsewhere in this sub-step, by world.
    sent: Vec<Vec<u32>>,
    /// The rows of the ghosts of each world.
    ghosts: Vec<Range<usize>>,
    /// Distance from the ground of a world within which it has ghosts, metres.
    depth: f32,
    /// Rounds of clamping between two exchanges.
    rounds: usize,
    /// Distance from the places at which standoffs begin within which all worlds have all agents as ghosts, metres; and
    /// these places.
    standoff_reach: f32,
    standoffs: Grid,
    /// Numbers of own agents that have arrived at goals, as the other worlds know them; and of the agents of all worlds.
    told: BTreeMap<u32, i64>,
    arrived: BTreeMap<u32, i64>,
}

impl Default for Border {
    fn default() -> Self {
        let (sent, ghosts, told, arrived) = Default::default();
        let (depth, standoff_reach, standoffs) = Default::default();
        Self { sent, ghosts, depth, rounds: usize::MAX, standoff_reach, standoffs, told, arrived }
    }
}

impl Border {
    /// Moves agents to the worlds that own their places. Between two steps.
    pub fn migrate(&self, state: &mut State, halo: &mut dyn Halo) {
        if !state.others.are_there {
            return;
        }
        let mut packets = vec![Vec::new(); halo.worlds()];
        for row in (0..state.agents.len()).rev() {
            let owner = halo.owner(state.agents.position[row]);
            if owner != halo.index() {
                let number = state.agents.number[row];
                let stranded = state.stranded.iter().find(|&&(stranded, _)| stranded == number);
                let stranded = stranded.map(|&(_, why)| why);
                write(&mut packets[owner], &Migrant { row: state.agents.copy(row), stranded });
                state.remove_row(row);
            }
        }
        for packet in halo.exchange(packets) {
            for Migrant { row, stranded } in read(&packet) {
                state.stranded.extend(stranded.map(|why| (row.number, why)));
                state.put_copy(row);
            }
        }
        state.stranded.sort_by_key(|&(number, _)| number);
    }

    /// Returns the number of sub-steps of the step that begins. Agrees on the sizes and speeds of all agents, and sets the
    /// depth of the ghosts.
    pub fn sub_steps(&mut self, state: &mut State, halo: &mut dyn Halo) -> u32 {
        if !state.others.are_there {
            return state.sub_steps(|| state.longest_sub_step());
        }
        let mut own = Agreement { longest_sub_step: state.longest_sub_step(), ..Agreement::default() };
        let agents = &state.agents;
        own.any = !agents.is_empty() && state.is_any_guarded_here();
        let most = |all: &[f32]| all.iter().copied().fold(0.0, f32::max);
        own.least_radius = agents.radius.values().iter().copied().fold(f32::INFINITY, f32::min);
        own.core = agents.core.values().iter().map(|core| core.length()).fold(0.0, f32::max);
        own.bound = most(agents.radius.values()) + own.core;
        own.speed = most(agents.max_speed.values());
        own.range = agents.group.values().iter().map(|group| state.range_of(group.index())).fold(0.0, f32::max);
        let all = halo.agree(own);
        (state.others.any_guarded, state.others.least_radius) = (all.any, all.least_radius);
        let parts = state.sub_steps(|| all.longest_sub_step);
        let seconds = state.settings.step as f32;
        self.set_depth(&all, seconds, seconds / parts as f32);
        parts
    }

    /// Sets the depth of the ghosts for a step of `seconds` that is divided into sub-steps of `part` seconds.
    fn set_depth(&mut self, all: &Agreement, seconds: f32, part: f32) {
        // between centres, while agents see the distance of cores
        let sees = all.range + 2.0 * all.core;
        let contact = 2.002 * (all.bound + all.speed * part);
        let rounds = (sees / contact) as usize;
        self.rounds = rounds.saturating_sub(CONTACTS).clamp(LEAST_ROUNDS, MOST_ROUNDS);
        let guards = (self.rounds + CONTACTS) as f32 * contact;
        // own agents leave the ground of their world by what they move in the step; a little more for rounding
        self.standoff_reach = 1.01 * (sees + STANDOFF_REACH * all.bound) + 0.1;
        self.depth = 1.01 * (sees.max(guards) + all.speed * seconds) + 0.1;
    }

    /// Exchanges ghosts: copies of the agents near the ground of another world. All worlds have the agents of standoffs, and
    /// the agents around places where standoffs begin, so that all decide alike.
    fn exchange_ghosts(&mut self, state: &mut State, members: &[u32], halo: &mut dyn Halo) {
        let Self { sent, ghosts, depth, standoff_reach, standoffs, .. } = self;
        let mut packets = vec![Vec::new(); halo.worlds()];
        sent.resize_with(halo.worlds(), Vec::new);
        sent.iter_mut().for_each(Vec::clear);
        for row in 0..state.agents.len() {
            let at = state.agents.position[row];
            let mut send = |world: usize| {
                sent[world].push(row as u32);
                write(&mut packets[world], &state.agents.copy(row));
            };
            let mut for_all = members.binary_search(&state.agents.number[row]).is_ok();
            standoffs.within(at, *standoff_reach, |_| for_all = true);
            if for_all {
                (0..halo.worlds()).filter(|&world| world != halo.index()).for_each(send);
            } else {
                halo.near(at, *depth, &mut send);
            }
        }
        let own = state.agents.len();
        ghosts.clear();
        for packet in halo.exchange(packets) {
            let first = state.agents.len();
            read(&packet).for_each(|row| state.agents.push_copy(row));
            ghosts.push(first..state.agents.len());
        }
        state.others.ghosts = state.agents.len() - own;
        state.prepare_meshes_of(own..state.agents.len());
    }

    /// Replaces velocities of ghosts by those that their owners have computed.
    pub fn exchange_velocities(&self, state: &State, velocities: &mut Velocities, halo: &mut dyn Halo) {
        if !state.others.are_there {
            return;
        }
        for (row, words) in self.trade(halo, |row| velocities.at(row).to_array().map(f32::to_bits)) {
            set(&mut velocities.rows(), row, Vec3::from_array(words.map(f32::from_bits)));
        }
    }

    /// Removes the ghosts.
    pub fn drop_ghosts(&self, state: &mut State) {
        if state.others.ghosts > 0 {
            state.agents.truncate(state.own().end);
            state.others.ghosts = 0;
        }
    }

    /// Sends the words of own rows to the worlds that have them as ghosts. Returns the ghosts with their words.
    fn trade<const N: usize>(&self, halo: &mut dyn Halo, of: impl Fn(usize) -> [u32; N]) -> Vec<(usize, [u32; N])> {
        let bytes = |row: &u32| of(*row as usize).into_iter().flat_map(u32::to_le_bytes);
        let packets = self.sent.iter().map(|rows| rows.iter().flat_map(bytes).collect()).collect();
        let received = halo.exchange(packets);
        let words = received.iter().flat_map(|packet| packet.as_chunks::<4>().0);
        let words: Vec<u32> = words.copied().map(u32::from_le_bytes).collect();
        let ghosts = self.ghosts.iter().cloned().flatten();
        let all: Vec<_> = ghosts.zip(words.as_chunks::<N>().0.iter().copied()).collect();
        assert_eq!(words.len(), all.len() * N, "{BROKEN}");
        all
    }

    /// Begins a sub-step of `seconds`: replaces the numbers of own agents that have arrived at goals by those of the agents
    /// of all worlds, and finds the places where standoffs begin. Then exchanges ghosts.
    pub fn begin(&mut self, state: &mut State, arrivals: &mut Arrivals, halo: &mut dyn Halo, seconds: f32) {
        if !state.others.are_there {
            return;
        }
        let (members, places) = state.standoffs_that_begin(seconds);
        let places = places.into_iter().map(|place| place.to_array().map(f32::to_bits)).collect();
        let own: BTreeMap<u32, i64> = arrivals.all().map(|(goal, count)| (goal.0, count.into())).collect();
        let mut counts: BTreeMap<u32, i64> = self.told.iter().map(|(&goal, &count)| (goal, -count)).collect();
        own.iter().for_each(|(&goal, count)| *counts.entry(goal).or_default() += count);
        counts.retain(|_, change| *change != 0);
        self.told = own;
        let all = halo.agree(Agreement { counts, places, ..Agreement::default() });
        for (goal, change) in all.counts {
            *self.arrived.entry(goal).or_default() += change;
        }
        self.arrived.retain(|_, count| *count != 0);
        arrivals.replace(self.arrived.iter().map(|(&goal, &count)| (GoalId(goal), count as u32)));
        let places: Vec<Vec2> = all.places.iter().map(|place| Vec2::from_array(place.map(f32::from_bits))).collect();
        let numbers: Vec<u32> = (0..places.len() as u32).collect();
        self.standoffs.rebuild(&places, &numbers, self.standoff_reach);
        self.exchange_ghosts(state, &members, halo);
    }
}

/// A border and its halo, for the guard.
pub(crate) struct Link<'a> {
    pub border: &'a Border,
    pub halo: &'a mut dyn Halo,
}

impl Spreading for Link<'_> {
    fn rounds(&self) -> usize {
        self.border.rounds
    }

    fn go_on(&mut self, spreads: bool, clamping: &mut Clamping<'_>) -> bool {
        let all = self.halo.agree(Agreement { any: spreads, ..Agreement::default() });
        if all.any {
            for (row, words) in self.border.trade(&mut *self.halo, |row| clamping.words(row)) {
                clamping.set_words(row, words);
            }
        }
        all.any
    }
}
