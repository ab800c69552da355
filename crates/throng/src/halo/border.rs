//! The exchanges of a step: agents that change their world, ghosts, and what is computed for ghosts elsewhere.

use super::far::FarAgents;
use super::packet::{BROKEN, push_words, read, words, write};
use super::{Agreement, Halo};
use crate::agent::{Columns, GhostWords, GoalId, Group, Rounding, Row, Status};
use crate::guard::{Clamping, Spreading};
use crate::intend::{Planned, STANDOFF_REACH, Velocities, set};
use crate::motion::{Attitude, Vehicle};
use crate::navigate::{Arrivals, NavFlags, NeighbourData, Turn, Unreachable};
use crate::parallel::WORD;
use crate::perceive::Extent;
use crate::world::{FARTHEST, State};
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
    /// Whether a vehicle moves any agent of any world, and whether any body is longer than wide. Of a step.
    pub any_vehicle: bool,
    pub any_long: bool,
    /// Whether standoffs go on or may begin in any world. Of a sub-step.
    pub any_standoff: bool,
    /// Extent of all agents, and the greatest distance within which a group searches for all neighbours. Of a sub-step, if
    /// groups do.
    pub flocks: Option<(Extent, f32)>,
    /// Agents of other worlds that behaviours read at any distance.
    pub far: FarAgents,
}

impl Default for Others {
    fn default() -> Self {
        Self {
            are_there: false,
            ghosts: 0,
            any_guarded: false,
            least_radius: f32::INFINITY,
            any_vehicle: false,
            any_long: false,
            any_standoff: false,
            flocks: None,
            far: FarAgents::default(),
        }
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
    /// Greatest bounding radius of all agents, metres.
    pub bound: f32,
    /// Distance from an agent of a standoff that begins within which other agents matter, metres.
    pub standoff_reach: f32,
    /// Numbers of own agents that have arrived at goals, as the other worlds know them; and of the agents of all worlds.
    told: BTreeMap<u32, i64>,
    arrived: BTreeMap<u32, i64>,
}

impl Default for Border {
    fn default() -> Self {
        let (sent, ghosts, told, arrived) = Default::default();
        let (depth, bound, standoff_reach) = Default::default();
        Self { sent, ghosts, depth, rounds: usize::MAX, bound, standoff_reach, told, arrived }
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
        own.flags = vec![state.any_vehicle()];
        let all = halo.agree(own);
        (state.others.any_guarded, state.others.least_radius) = (all.any, all.least_radius);
        (state.others.any_vehicle, state.others.any_long) = (all.flags[0], all.core > 0.0);
        let parts = state.sub_steps(|| all.longest_sub_step);
        let seconds = state.settings.step as f32;
        self.set_depth(&all, seconds, seconds / parts as f32);
        parts
    }

    /// Sets the depth of the ghosts for a step of `seconds` that is divided into sub-steps of `part` seconds.
    fn set_depth(&mut self, all: &Agreement, seconds: f32, part: f32) {
        // between centres, while agents see the distance of cores
        let sees = all.range + 2.0 * all.core;
        // an agent moves by its speed, and by the rounding of positions
        let contact = 2.002 * (all.bound + all.speed * part + Rounding::farther(Vec2::splat(FARTHEST as f32)));
        let rounds = (sees / contact) as usize;
        self.rounds = rounds.saturating_sub(CONTACTS).clamp(LEAST_ROUNDS, MOST_ROUNDS);
        let guards = (self.rounds + CONTACTS) as f32 * contact;
        self.bound = all.bound;
        // own agents leave the ground of their world by what they move in the step; a little more for rounding
        self.standoff_reach = 1.01 * (sees + STANDOFF_REACH * all.bound) + 0.1;
        self.depth = 1.01 * (sees.max(guards) + all.speed * seconds) + 0.1;
    }

    /// Exchanges ghosts: what other agents read of the agents near the ground of another world.
    fn exchange_ghosts(&mut self, state: &mut State, halo: &mut dyn Halo) {
        let Self { sent, ghosts, depth, .. } = self;
        let agents = &mut state.agents;
        sent.resize_with(halo.worlds(), Vec::new);
        sent.iter_mut().for_each(Vec::clear);
        for row in rows_near_others(&agents.position, &*halo, *depth) {
            halo.near(agents.position[row], *depth, &mut |world| sent[world].push(row as u32));
        }
        let packet = |rows: &Vec<u32>| {
            let mut packet = Vec::with_capacity(size_of::<GhostWords>() * rows.len());
            rows.iter().for_each(|&row| push_words(&mut packet, agents.ghost(row as usize)));
            packet
        };
        let packets = halo.exchange(sent.iter().map(packet).collect());
        let own = agents.len();
        ghosts.clear();
        for packet in &packets {
            let first = agents.len();
            let words: Vec<GhostWords> = words(packet).collect();
            agents.push_ghosts(&words).expect(BROKEN);
            ghosts.push(first..agents.len());
        }
        state.others.ghosts = agents.len() - own;
        if state.others.any_vehicle {
            self.exchange_vehicles(agents, halo);
        }
    }

    /// Exchanges the vehicles of ghosts, and their attitudes.
    fn exchange_vehicles(&self, agents: &mut Columns, halo: &mut dyn Halo) {
        let packet = |rows: &Vec<u32>| {
            let mut packet = Vec::new();
            for &row in rows {
                write(&mut packet, &(agents.vehicle[row as usize], agents.attitude[row as usize]));
            }
            packet
        };
        let packets = halo.exchange(self.sent.iter().map(packet).collect());
        for (packet, rows) in packets.iter().zip(&self.ghosts) {
            let all: Vec<(Option<Vehicle>, Attitude)> = read(packet).collect();
            assert_eq!(all.len(), rows.len(), "{BROKEN}");
            for (row, (vehicle, attitude)) in rows.clone().zip(all) {
                agents.vehicle.set(row, vehicle);
                agents.attitude.set(row, attitude);
            }
        }
    }

    /// Returns the world of the agent of a row; `None` for an own one.
    pub fn world_of(&self, row: usize) -> Option<usize> {
        self.ghosts.iter().position(|rows| rows.contains(&row))
    }

    /// Replaces what neighbours know of the paths of ghosts, their status and their right of way by those that their owners
    /// have computed.
    pub fn exchange_ways(&self, state: &mut State, shown: &mut [NeighbourData], halo: &mut dyn Halo) {
        let agents = &mut state.agents;
        let of = |(agents, shown): &(&mut Columns, &mut [NeighbourData]), row: usize| {
            let [x, y, remaining, key] = shown[row].way.words();
            [x, y, remaining, key, agents.status[row] as u32 | (agents.travel[row].turn as u32) << 8]
        };
        let set = |(agents, shown): &mut (&mut Columns, &mut [NeighbourData]), row: usize, words: [u32; 5]| {
            let [x, y, remaining, key, status_and_turn] = words;
            let way = NavFlags::of_words([x, y, remaining, key]);
            agents.status[row] = Status::numbered(status_and_turn & 255).expect(BROKEN);
            agents.travel[row].turn = Turn::numbered(status_and_turn >> 8).expect(BROKEN);
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

    /// Replaces the planned motions of ghosts by those that their owners have computed. Only headings of long bodies
    /// depend on them.
    pub fn exchange_plans(&self, state: &State, planned: &mut Planned, halo: &mut dyn Halo) {
        if !(state.others.any_long && (state.others.any_vehicle || state.may_behave())) {
            return;
        }
        // a world in which no motion is planned has no plans
        let of = |planned: &Planned, row: usize| planned.words(row);
        self.trade(halo, planned, of, |planned, row, words| planned.set_words(row, words));
    }

    /// Removes the ghosts.
    pub fn drop_ghosts(&self, state: &mut State) {
        if state.others.ghosts > 0 {
            state.agents.truncate(state.own().end);
            state.others.ghosts = 0;
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
        for (packet, rows) in packets.iter().zip(&self.ghosts) {
            assert_eq!(packet.len(), size_of::<[u32; N]>() * rows.len(), "{BROKEN}");
            for (row, words) in rows.clone().zip(words(packet)) {
                set(all, row, words);
            }
        }
    }

    /// Begins a sub-step of `seconds`: replaces the numbers of own agents that have arrived at goals by those of the agents
    /// of all worlds. Then exchanges ghosts.
    pub fn begin(&mut self, state: &mut State, arrivals: &mut Arrivals, halo: &mut dyn Halo, seconds: f32) {
        if !state.others.are_there {
            return;
        }
        let own: BTreeMap<u32, i64> = arrivals.all().map(|(goal, count)| (goal.0, count.into())).collect();
        let mut counts: BTreeMap<u32, i64> = self.told.iter().map(|(&goal, &count)| (goal, -count)).collect();
        own.iter().for_each(|(&goal, count)| *counts.entry(goal).or_default() += count);
        counts.retain(|_, change| *change != 0);
        self.told = own;
        let told = state.others.far.answers(state);
        let own = Agreement { counts, any: state.any_standoff(seconds), told, ..Agreement::default() };
        let all = halo.agree(state.tell_flocks(own));
        state.others.any_standoff = all.any;
        state.others.far.learn(&all.told);
        state.others.flocks = all.extent.map(|extent| (extent, all.range));
        for (goal, change) in all.counts {
            *self.arrived.entry(goal).or_default() += change;
        }
        self.arrived.retain(|_, count| *count != 0);
        arrivals.replace(self.arrived.iter().map(|(&goal, &count)| (GoalId(goal), count as u32)));
        self.exchange_ghosts(state, halo);
    }
}

impl State {
    /// Whether a behaviour may steer agents of any world.
    pub(crate) fn may_behave(&self) -> bool {
        self.local_groups.iter().any(|group| group.guidance.behaviour.is_some())
    }

    /// Adds what the cells depend on in which groups search for all neighbours, if any group does.
    fn tell_flocks(&self, own: Agreement) -> Agreement {
        if !self.local_groups.iter().any(Group::looks_at_all) {
            return own;
        }
        let groups = self.agents.group.values().iter().map(|group| &self.local_groups[group.index()]);
        let range =
            groups.filter(|group| group.looks_at_all()).map(|group| group.neighbour_distance).fold(0.0, f32::max);
        let extent = Extent::of(self.own().len(), |row| self.place_in_space(row));
        Agreement { range, extent, ..own }
    }
}

/// A border and its halo, for stages.
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
