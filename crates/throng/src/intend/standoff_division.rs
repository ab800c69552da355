//! Standoffs in a world of a division.
//!
//! All worlds keep the list of all standoffs. An agreement reads agents up to [`STANDOFF_REACH`](super::STANDOFF_REACH) away, so the agents around it
//! are gathered in one world:
//!
//! 1. Each world tells which of its agents go first and are not past the others, and which agents look for a partner that
//!    may have one. About a partner beyond its border it asks the world of that agent.
//! 2. Agents that may agree in this sub-step, and the members of standoffs that look for newcomers, are in *clusters*: two
//!    clusters are so far apart that no agreement of one reads what an agreement of the other changes.
//! 3. The world that owns the place of the first agent of a cluster receives copies of all agents around it. It lets them
//!    agree, in the order of all worlds, and tells what they have agreed on.
//!
//! Most sub-steps end after the first exchange: few of the agents that look for a partner may have one.

use super::agree::StandoffView;
use super::standoff::{CLOSE_IF_NARROW, NewStandoff, Newcomers, RowsByNumber};
use crate::agent::Row;
use crate::halo::{Agreement, BROKEN, Link, Told, read, write};
use crate::perceive::{Grid, Perceived};
use crate::world::State;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// Kinds of what a world tells: an agent that goes first and is not past the others; the place of an agent that may begin a
/// standoff, by its number; the place of a member of a standoff that looks for newcomers, by its number; the newcomers of
/// a standoff, by its index; a standoff that begins, by the number of the agent that looked for a partner.
const PASSING: u8 = 0;
const SEEKER: u8 = 1;
const MEMBER: u8 = 2;
const NEWCOMERS: u8 = 3;
const BEGINS: u8 = 4;

/// A copy of an agent for another world.
#[derive(Serialize, Deserialize)]
struct AgentCopy {
    row: Row,
    /// Metres to the goal.
    remaining: f32,
    /// The numbers of its neighbours, nearest first, if it may begin a standoff.
    near: Vec<u32>,
}

/// Updates all standoffs, together with the other worlds. `stuck` are the own agents that look for a partner, `remaining`
/// returns the distance to the goal that an agent has left.
pub(super) fn run_divided(
    state: &mut State,
    seen: Perceived<'_>,
    remaining: &dyn Fn(usize) -> f32,
    stuck: &[usize],
    seconds: f32,
    link: &mut Link<'_>,
) {
    let members: BTreeSet<u32> = state.standoffs.iter().flat_map(|standoff| standoff.numbers()).collect();
    let rows = state.rows_by_number(&members);
    let passing = state.members_that_pass(remaining, &rows);
    let mut own: Told = passing.into_iter().map(|number| ((PASSING, number), Vec::new())).collect();
    let looking = state.standoffs.iter().filter(|standoff| standoff.looks_for_newcomers(seconds));
    let looking = looking.flat_map(|standoff| standoff.numbers()).filter_map(|number| rows.get(&number));
    looking.filter(|&&row| state.own().contains(&row)).for_each(|&row| state.tell_place(&mut own, MEMBER, row));
    let (seeking, alone): (Vec<usize>, Vec<usize>) =
        stuck.iter().copied().partition(|&row| state.may_have_own_partner(row, seen.grid, link));
    seeking.into_iter().for_each(|row| state.tell_place(&mut own, SEEKER, row));
    let questions = questions(state, seen.grid, &alone, link);
    let any = questions.iter().any(|packet| !packet.is_empty());
    let all = link.halo.agree(Agreement { told: own, any, ..Agreement::default() });
    let mut told = all.told;
    if all.any {
        let answers = answers(state, seen.grid, questions, link);
        told.extend(link.halo.agree(Agreement { told: answers, ..Agreement::default() }).told);
    }
    let passing = told.keys().filter(|key| key.0 == PASSING).map(|key| key.1).collect();
    let looking = state.update_standoffs(&passing, &rows, seconds);
    told.retain(|key, _| key.0 != PASSING);
    if told.is_empty() {
        return;
    }
    let points = told.iter().map(|(&key, place)| (key, postcard::from_bytes(place).expect(BROKEN)));
    let clusters = Clusters::new(points, state, link);
    let agreed = agree_in_clusters(state, seen, remaining, &clusters, &looking, link);
    let agreed = link.halo.agree(Agreement { told: agreed, ..Agreement::default() }).told;
    state.apply_agreed(&agreed);
}

/// Returns questions about partners, as packets to the other worlds: copies of own agents without a possible partner in
/// this world that have one among the ghosts of another world, by what is known of ghosts.
fn questions(state: &State, grid: &Grid, stuck: &[usize], link: &Link<'_>) -> Vec<Vec<u8>> {
    let mut packets = vec![Vec::new(); link.halo.worlds()];
    for &row in stuck {
        let mut asked = BTreeSet::new();
        grid.within(state.agents.position[row], state.partner_distance(row, link), |near| {
            let other = near.row as usize;
            let may = || state.may_be_partner(other) && state.goal_of(row) != state.goal_of(other);
            asked.extend(link.border.world_of(other).filter(|_| may()));
        });
        asked.into_iter().for_each(|world| write(&mut packets[world], &state.agents.copy(row)));
    }
    packets
}

/// Exchanges the questions. Returns the places of the agents of other worlds that may have a partner in this world.
fn answers(state: &mut State, grid: &Grid, questions: Vec<Vec<u8>>, link: &mut Link<'_>) -> Told {
    let count = state.agents.len();
    for packet in link.halo.exchange(questions) {
        read(&packet).for_each(|row| state.agents.push_copy(row));
    }
    state.prepare_meshes_of(count..state.agents.len());
    let mut told = Told::new();
    for row in count..state.agents.len() {
        if state.may_have_own_partner(row, grid, link) {
            state.tell_place(&mut told, SEEKER, row);
        }
    }
    state.agents.truncate(count);
    told
}

/// Gathers the agents around each cluster in one world, and lets the agents of the clusters of this world agree. Returns
/// what they have agreed on.
fn agree_in_clusters(
    state: &mut State,
    seen: Perceived<'_>,
    remaining: &dyn Fn(usize) -> f32,
    clusters: &Clusters,
    looking: &[usize],
    link: &mut Link<'_>,
) -> Told {
    let around = clusters.own_rows(state, seen.grid, link);
    let numbers_near = |row: usize| seen.near.of(row).iter().map(|&other| state.agents.number[other as usize]);
    let seeks = |row: usize| clusters.points.contains_key(&(SEEKER, state.agents.number[row]));
    let near = |row: usize| if seeks(row) { numbers_near(row).collect() } else { Vec::new() };
    let copy = |row: usize| AgentCopy { row: state.agents.copy(row), remaining: remaining(row), near: near(row) };
    let mut packets = vec![Vec::new(); link.halo.worlds()];
    for (&world, rows) in around.iter().filter(|&(&world, _)| world != link.halo.index()) {
        rows.iter().for_each(|&row| write(&mut packets[world], &copy(row as usize)));
    }
    let own: Vec<u32> = around.get(&link.halo.index()).into_iter().flatten().copied().collect();
    let mut lists: BTreeMap<u32, Vec<u32>> = own
        .iter()
        .filter(|&&row| seeks(row as usize))
        .map(|&row| (state.agents.number[row as usize], near(row as usize)))
        .collect();
    let (count, mut left) = (state.agents.len(), Vec::new());
    for packet in link.halo.exchange(packets) {
        for AgentCopy { row, remaining, near } in read(&packet) {
            lists.insert(row.number, near);
            state.agents.push_copy(row);
            left.push(remaining);
        }
    }
    state.prepare_meshes_of(count..state.agents.len());
    let all: Vec<u32> = own.into_iter().chain(count as u32..state.agents.len() as u32).collect();
    let remaining = &|row: usize| if row < count { remaining(row) } else { left[row - count] };
    let told = agree_here(state, &all, remaining, &lists, clusters, looking, link);
    state.agents.truncate(count);
    told
}

/// Lets the agents of the clusters of this world agree. `all` are the rows of the agents around them, `lists` the numbers of
/// the neighbours of agents that may begin a standoff, by number.
fn agree_here(
    state: &mut State,
    all: &[u32],
    remaining: &dyn Fn(usize) -> f32,
    lists: &BTreeMap<u32, Vec<u32>>,
    clusters: &Clusters,
    looking: &[usize],
    link: &Link<'_>,
) -> Told {
    let mut told = Told::new();
    let number = |row: &u32| state.agents.number[*row as usize];
    let numbers: Vec<u32> = all.iter().map(number).collect();
    let places: Vec<Vec2> = all.iter().map(|&row| state.agents.position[row as usize]).collect();
    let rows: RowsByNumber = numbers.iter().copied().zip(all.iter().map(|&row| row as usize)).collect();
    let mut grid = Grid::default();
    grid.rebuild(&places, &numbers, CELL);
    let is_here = |key| clusters.owner(key, link) == Some(link.halo.index());
    for &index in looking {
        if !state.standoffs[index].numbers().any(|number| is_here((MEMBER, number))) {
            continue;
        }
        let view = StandoffView { state, grid: &grid, rows: Some(all), remaining };
        let newcomers = view.newcomers_of(&state.standoffs[index], &rows);
        if !newcomers.is_empty() {
            state.make_room(&newcomers, &rows);
            write(told.entry((NEWCOMERS, index as u32)).or_default(), &newcomers);
        }
    }
    for (&number, &row) in &rows {
        if is_here((SEEKER, number)) {
            let near = lists.get(&number).into_iter().flatten();
            let near: Vec<u32> = near.filter_map(|number| rows.get(number)).map(|&row| row as u32).collect();
            let view = StandoffView { state, grid: &grid, rows: Some(all), remaining };
            if let Some(new) = view.new_standoff(row, &near) {
                state.tally.standoffs += 1;
                state.take_turns(&new, &rows);
                write(told.entry((BEGINS, number)).or_default(), &new);
            }
        }
    }
    told
}

/// Height of the cells of the agents around standoffs, metres.
const CELL: f32 = 4.0;

/// The agents that standoffs of a sub-step may begin or grow with, in clusters that do not depend on each other.
struct Clusters {
    /// The place of each agent and that of the first agent of its cluster, by kind and number.
    points: BTreeMap<(u8, u32), [Vec2; 2]>,
    /// Distance from the agents within which other agents matter, metres.
    reach: f32,
}

impl Clusters {
    /// Returns the clusters of agents, given by their keys, in order, and their places.
    fn new(agents: impl Iterator<Item = ((u8, u32), Vec2)>, state: &State, link: &Link<'_>) -> Self {
        let (keys, places): (Vec<(u8, u32)>, Vec<Vec2>) = agents.unzip();
        let reach = link.border.standoff_reach;
        let mut cluster: Vec<usize> = (0..places.len()).collect();
        let mut grid = Grid::default();
        grid.rebuild(&places, &(0..places.len() as u32).collect::<Vec<_>>(), reach);
        for (index, &place) in places.iter().enumerate() {
            grid.within(place, 2.0 * reach, |near| join(&mut cluster, index, near.row as usize));
        }
        for standoff in &state.standoffs {
            let members = standoff.numbers().filter_map(|number| keys.binary_search(&(MEMBER, number)).ok());
            let members: Vec<usize> = members.collect();
            members.windows(2).for_each(|pair| join(&mut cluster, pair[0], pair[1]));
        }
        let point = |index: usize| (keys[index], [index, root(&cluster, index)].map(|index| places[index]));
        Self { points: (0..keys.len()).map(point).collect(), reach }
    }

    /// Returns the world in which the agents around a point agree.
    fn owner(&self, key: (u8, u32), link: &Link<'_>) -> Option<usize> {
        self.points.get(&key).map(|&[_, first]| link.halo.owner(first))
    }

    /// Returns the own rows around the points, by the world in which they agree.
    fn own_rows(&self, state: &State, grid: &Grid, link: &Link<'_>) -> BTreeMap<usize, BTreeSet<u32>> {
        let (own, mut rows) = (state.own(), BTreeMap::<usize, BTreeSet<u32>>::new());
        for &[place, first] in self.points.values() {
            let to = link.halo.owner(first);
            grid.within(place, self.reach, |near| {
                if own.contains(&(near.row as usize)) {
                    rows.entry(to).or_default().insert(near.row);
                }
            });
        }
        rows
    }
}

/// Returns the least index of the set of an index. Each index has another index of its set, not above it.
fn root(sets: &[usize], mut index: usize) -> usize {
    while sets[index] != index {
        index = sets[index];
    }
    index
}

/// Joins the sets of two indices.
fn join(sets: &mut [usize], one: usize, other: usize) {
    let (one, other) = (root(sets, one), root(sets, other));
    sets[one.max(other)] = one.min(other);
}

impl State {
    /// Tells the place of an agent.
    fn tell_place(&self, told: &mut Told, kind: u8, row: usize) {
        let agents = &self.agents;
        let place = told.entry((kind, agents.number[row])).or_default();
        place.clear();
        write(place, &agents.position[row]);
    }

    /// Returns the greatest distance of a partner of an agent, metres.
    fn partner_distance(&self, row: usize, link: &Link<'_>) -> f32 {
        1.001 * CLOSE_IF_NARROW * (self.agents.radius[row] + link.border.bound)
    }

    /// Whether an agent may have a partner among the agents of this world.
    fn may_have_own_partner(&self, row: usize, grid: &Grid, link: &Link<'_>) -> bool {
        let (own, mut any) = (self.own(), false);
        grid.within(self.agents.position[row], self.partner_distance(row, link), |near| {
            let other = near.row as usize;
            any = any
                || own.contains(&other)
                    && other != row
                    && self.may_be_partner(other)
                    && self.opposed(row, other)
                    && self.block_each_other(row, other);
        });
        any
    }

    /// Returns the rows of the agents with these numbers, own ones and ghosts.
    fn rows_by_number(&self, numbers: &BTreeSet<u32>) -> RowsByNumber {
        if numbers.is_empty() {
            return RowsByNumber::new();
        }
        let rows = self.agents.number.iter().zip(0..);
        rows.filter(|(number, _)| numbers.contains(number)).map(|(&number, row)| (number, row)).collect()
    }

    /// Applies what agents have agreed on, in the order of all worlds.
    fn apply_agreed(&mut self, agreed: &Told) {
        let (mut joined, mut begun) = (Vec::new(), Vec::new());
        for (&(kind, index), bytes) in agreed {
            match kind {
                NEWCOMERS => joined.extend(read::<Newcomers>(bytes).map(|newcomers| (index as usize, newcomers))),
                _ => begun.extend(read::<NewStandoff>(bytes)),
            }
        }
        let numbers =
            joined.iter().flat_map(|(_, all)| all.numbers()).chain(begun.iter().flat_map(NewStandoff::numbers));
        let rows = self.rows_by_number(&numbers.collect());
        for (index, newcomers) in joined {
            self.join_standoff(index, newcomers, &rows);
        }
        for new in begun {
            self.begin_standoff(new, &rows);
        }
    }
}
