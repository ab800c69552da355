//! The exchanges of a step: agents that change their world, ghosts, and what is computed for ghosts elsewhere.

use super::packet::{BROKEN, push_words, read, words, write};
use super::{Agreement, Halo};
use crate::agent::{Columns, GhostWords, GoalId, Row, Status};
use crate::guard::{Clamping, Spreading};
use crate::intend::{STANDOFF_REACH, Velocities, set};
use crate::navigate::{Arrivals, NavFlags, NeighbourData, Unreachable};
use crate::parallel::WORD;
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
    /// Number of ghosts, the last ones, that are lean: they have what other agents read before and in the guard. The
    /// ghosts before them are whole: they have all that their agents have.
    pub lean: usize,
    /// Whether an agent of any world may be guarded, and the least radius of all agents, metres. Of a step.
    pub any_guarded: bool,
    pub least_radius: f32,
}

impl Default for Others {
    fn default() -> Self {
        Self { are_there: false, ghosts: 0, lean: 0, any_guarded: false, least_radius: f32::INFINITY }
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
    /// Own rows that are ghosts elsewhere in this sub-step, by world; whole ones first.
    sent: Vec<Vec<u32>>,
    /// The rows of the ghosts of each world: whole ones, and lean ones.
    ghosts: Vec<[Range<usize>; 2]>,
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
        let rows: Vec<usize> = rows_near_others(&state.agents.position, &*halo, 0.0).collect();
        for row in rows.into_iter().rev() {
            let owner = halo.owner(state.agents.position[row]);
            if owner != halo.index() {
                let number = state.agents.number[row];
                let stranded = state.stranded.iter().find(|&&(stranded, _)| stranded == number);
                let stranded = stranded.map(|&(_, why)| why);
                write(&mut packets[owner], &Migrant { row: state.agents.copy(row), stranded });
                state.remove_row(row);
            }
        }
        let stayed = state.agents.len();
        for packet in halo.exchange(packets) {
            for Migrant { row, stranded } in read(&packet) {
                state.stranded.extend(stranded.map(|why| (row.number, why)));
                state.put_copy(row);
            }
        }
        // agents from far come with paths on meshes that no agent here has needed
        state.prepare_meshes_of(stayed..state.agents.len());
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

    /// Exchanges ghosts: copies of the agents near the ground of another world. All worlds have whole ghosts of the agents
    /// of standoffs, and of the agents around places where standoffs begin, so that all decide alike.
    fn exchange_ghosts(&mut self, state: &mut State, members: &[u32], halo: &mut dyn Halo) {
        let Self { sent, ghosts, depth, standoff_reach, standoffs, .. } = self;
        let (index, agents) = (halo.index(), &mut state.agents);
        sent.resize_with(halo.worlds(), Vec::new);
        sent.iter_mut().for_each(Vec::clear);
        let is_whole = |row: usize| {
            let mut near = members.binary_search(&agents.number[row]).is_ok();
            standoffs.within(agents.position[row], *standoff_reach, |_| near = true);
            near
        };
        let any = halo.worlds() > 1 && (!members.is_empty() || !standoffs.is_empty());
        let whole: Vec<u32> = (0..agents.len() as u32).filter(|&row| any && is_whole(row as usize)).collect();
        sent.iter_mut().enumerate().filter(|&(world, _)| world != index).for_each(|(_, rows)| rows.extend(&whole));
        let rows = rows_near_others(&agents.position, &*halo, *depth);
        for row in rows.filter(|&row| whole.binary_search(&(row as u32)).is_err()) {
            halo.near(agents.position[row], *depth, &mut |world| sent[world].push(row as u32));
        }
        let packet = |rows: &Vec<u32>| {
            let (whole, lean) = rows.split_at(whole.len().min(rows.len()));
            let (mut packet, mut all) = (Vec::with_capacity(size_of::<GhostWords>() * rows.len() + 4), Vec::new());
            if !rows.is_empty() {
                whole.iter().for_each(|&row| write(&mut all, &agents.copy(row as usize)));
                push_words(&mut packet, [all.len() as u32]);
                packet.extend(all);
                lean.iter().for_each(|&row| push_words(&mut packet, agents.ghost(row as usize)));
            }
            packet
        };
        let packets = halo.exchange(sent.iter().map(packet).collect());
        let own = agents.len();
        let parts: Vec<(&[u8], &[u8])> = packets.iter().map(|packet| split(packet)).collect();
        ghosts.clear();
        for (whole, _) in &parts {
            let first = agents.len();
            read(whole).for_each(|row| agents.push_copy(row));
            ghosts.push([first..agents.len(), 0..0]);
        }
        let acting = agents.len();
        for ((_, lean), [_, rows]) in parts.iter().zip(&mut *ghosts) {
            let first = agents.len();
            let lean: Vec<GhostWords> = words(lean).collect();
            agents.push_ghosts(&lean).expect(BROKEN);
            *rows = first..agents.len();
        }
        (state.others.ghosts, state.others.lean) = (agents.len() - own, agents.len() - acting);
        state.prepare_meshes_of(own..acting);
    }

    /// Replaces what neighbours know of the paths of ghosts, and their status, by those that their owners have computed.
    pub fn exchange_ways(&self, state: &mut State, shown: &mut [NeighbourData], halo: &mut dyn Halo) {
        let agents = &mut state.agents;
        let of = |(agents, shown): &(&mut Columns, &mut [NeighbourData]), row: usize| {
            let [x, y, remaining, key] = shown[row].way.words();
            [x, y, remaining, key, agents.status[row] as u32]
        };
        let set = |(agents, shown): &mut (&mut Columns, &mut [NeighbourData]), row: usize, words: [u32; 5]| {
            let [x, y, remaining, key, status] = words;
            let way = NavFlags::of_words([x, y, remaining, key]);
            agents.status[row] = Status::numbered(status).expect(BROKEN);
            shown[row] = NeighbourData::new(agents.position[row], agents.velocity[row], way);
        };
        if state.others.are_there {
            self.trade(halo, &mut (agents, shown), of, set);
        }
    }

    /// Replaces velocities of ghosts by those that their owners have computed.
    pub fn exchange_velocities(&self, state: &State, velocities: &mut Velocities, halo: &mut dyn Halo) {
        if !state.others.are_there {
            return;
        }
        let of = |velocities: &Velocities, row: usize| velocities.at(row).to_array().map(f32::to_bits);
        let put = |velocities: &mut Velocities, row: usize, words: [u32; 3]| {
            set(&mut velocities.rows(), row, Vec3::from_array(words.map(f32::from_bits)));
        };
        self.trade(halo, velocities, of, put);
    }

    /// Removes the ghosts.
    pub fn drop_ghosts(&self, state: &mut State) {
        if state.others.ghosts > 0 {
            state.agents.truncate(state.own().end);
            (state.others.ghosts, state.others.lean) = (0, 0);
        }
    }

    /// Sends the words of own rows to the worlds that have them as ghosts, and sets the words of the ghosts.
    fn trade<const N: usize, T: ?Sized>(
        &self,
        halo: &mut dyn Halo,
        all: &mut T,
        of: impl Fn(&T, usize) -> [u32; N],
        set: impl Fn(&mut T, usize, [u32; N]),
    ) {
        let packet = |rows: &Vec<u32>| {
            let mut packet = Vec::with_capacity(size_of::<[u32; N]>() * rows.len());
            rows.iter().for_each(|&row| push_words(&mut packet, of(&*all, row as usize)));
            packet
        };
        let packets = halo.exchange(self.sent.iter().map(packet).collect());
        for (packet, [whole, lean]) in packets.iter().zip(&self.ghosts) {
            assert_eq!(packet.len(), size_of::<[u32; N]>() * (whole.len() + lean.len()), "{BROKEN}");
            for (row, words) in whole.clone().chain(lean.clone()).zip(words(packet)) {
                set(all, row, words);
            }
        }
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
            let of = |clamping: &Clamping<'_>, row| clamping.words(row);
            self.border.trade(&mut *self.halo, clamping, of, |clamping, row, words| clamping.set_words(row, words));
        }
        all.any
    }
}

/// Returns rows, among them all with ground of another world within a distance, metres. It asks for blocks of rows: in a
/// large world the rows of most blocks are near each other, and far from others.
fn rows_near_others(positions: &[Vec2], halo: &dyn Halo, distance: f32) -> impl Iterator<Item = usize> {
    let is_near = move |block: &[Vec2]| {
        let ends = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        let (low, high) = block.iter().fold(ends, |(low, high), &at| (low.min(at), high.max(at)));
        let (middle, mut any) = (0.5 * (low + high), false);
        // a little more, for rounding
        let around = 1.001 * (high - low).length() * 0.5 + 1e-6 * high.abs().max(low.abs()).max_element();
        halo.near(middle, distance + around, &mut |_| any = true);
        any
    };
    let blocks = (0..).step_by(WORD).zip(positions.chunks(WORD));
    blocks.filter(move |(_, block)| is_near(block)).flat_map(|(first, block)| first..first + block.len())
}

/// Returns the two parts of a packet of ghosts: whole ones, and lean ones.
fn split(packet: &[u8]) -> (&[u8], &[u8]) {
    let Some((&length, ghosts)) = packet.split_first_chunk() else { return (packet, packet) };
    ghosts.split_at_checked(u32::from_le_bytes(length) as usize).expect(BROKEN)
}
