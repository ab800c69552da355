//! Stage 1, perception: the nearest neighbours of all agents.

use super::{CellLattice, FEW_NEIGHBOURS, Grid, LongBodies, MOST_NEIGHBOURS, Near, Neighbours, SubStep, TileScratch};
use crate::agent::{Columns, Cycles, Group};
use crate::motion::Vehicle;
use crate::parallel::{self, RowLists};
use crate::sleep::SleepBlocks;
use crate::world::State;

/// The SIMD search looks for all agents: it is slower than the scalar search if fewer than one in this number need it.
const FEW_NEED: usize = 16;

/// 1. Perception: finds the nearest neighbours of all agents.
#[derive(Clone, Debug, Default)]
pub(crate) struct Perceive {
    pub(super) grid: Grid,
    long: LongBodies,
    near: Neighbours,
    /// For agents that search for all neighbours within a distance.
    pub(super) lattice: CellLattice,
    close: f32,
    scratch: Vec<(TileScratch, Vec<Near>)>,
    pub(super) cycles: Cycles,
    pub(super) is_sorted: bool,
}

/// The result of perception.
#[derive(Clone, Copy)]
pub(crate) struct Perceived<'a> {
    /// The agents in the cells of the ground.
    pub grid: &'a Grid,
    /// The nearest neighbours of each agent.
    pub near: &'a Neighbours,
    /// All agents in the cells of space. It is up to date if any group searches for all neighbours within a distance.
    pub lattice: &'a CellLattice,
    /// Distance below which the separation of two agents must be measured, metres.
    pub close: f32,
    /// Whether all bodies are discs.
    pub discs_only: bool,
    /// The cycles along which the rows were moved in this sub-step, if they were.
    pub sorted: Option<&'a Cycles>,
}

/// The state, with the neighbours of each agent.
#[derive(Clone, Copy)]
pub(crate) struct Nearby<'a> {
    pub state: &'a State,
    pub near: &'a Neighbours,
}

impl<'a> Nearby<'a> {
    /// Returns the rows of the neighbours of an agent, nearest first.
    pub fn neighbours(&self, row: usize) -> &'a [u32] {
        self.near.of(row)
    }
}

impl Perceive {
    /// Finds the neighbours of all agents that do not sleep.
    pub fn run(&mut self, state: &mut State, sleep: &mut SleepBlocks, of: SubStep) -> Perceived<'_> {
        if sleep.all_asleep() {
            self.is_sorted = false;
        } else {
            self.find(state, sleep, of.seconds);
        }
        self.result()
    }

    /// Returns the result of the last sub-step.
    pub fn result(&self) -> Perceived<'_> {
        Perceived {
            grid: &self.grid,
            near: &self.near,
            lattice: &self.lattice,
            close: self.close,
            discs_only: self.long.is_empty(),
            sorted: self.is_sorted.then_some(&self.cycles),
        }
    }

    /// Sorts all agents into the cells of the grid. Returns the greatest neighbour distance.
    pub(super) fn rebuild_grid(&mut self, state: &State) -> f32 {
        let range = state.groups_in_use().map(|group| group.neighbour_distance).fold(0.0, f32::max);
        self.grid.rebuild(&state.agents.position, &state.agents.number, range);
        range
    }

    /// Sorts all agents into the lattice, if a group searches for all neighbours within a distance.
    fn rebuild_lattice(&mut self, state: &State) {
        let looking = state.groups_in_use().filter(|group| group.looks_at_all());
        let own = looking.map(|group| group.neighbour_distance).fold(0.0, f32::max);
        // sums over neighbours run in the order of cells, which in a division are those of all agents
        let (all, reach) = state.others.flocks.map_or((None, own), |(all, reach)| (Some(all), reach));
        if own > 0.0 {
            self.lattice.rebuild_within(all, |row| state.place_in_space(row), &state.agents.number, reach);
        }
    }

    fn find(&mut self, state: &mut State, sleep: &mut SleepBlocks, seconds: f32) {
        self.close = state.close_enough_to_measure(seconds);
        self.rebuild_lattice(state);
        let guarded = state.others.any_guarded || state.groups_in_use().any(|group| group.guard);
        if state.none_counts_the_nearest() && !guarded && !state.any_needs_model() {
            self.near.clear(state.agents.len());
            return self.sort_rows_if_scattered(state, sleep);
        }
        let range = self.rebuild_grid(state);
        self.sort_rows_if_scattered(state, sleep);
        let most = state.groups_in_use().map(|group| group.nearest()).max().unwrap_or(1);
        if most == 0 {
            self.grid.set_heights(None::<fn(usize) -> f32>);
            return self.near.empty(self.grid.places());
        }
        let alike = state.groups_in_use().all(|group| group.nearest() == most && group.neighbour_distance == range);
        let (agents, groups, close, level) =
            (&state.agents, &state.local_groups, self.close, state.instructions.level());
        self.long.rebuild(agents, range);
        self.near.resize(self.grid.places(), most);
        self.near.forget(state.own().end..state.agents.len());
        let any_flies = agents.any_flies();
        // beside a large flock that is searched otherwise, too few agents need this search
        let group = agents.group.values();
        let needing = group.iter().filter(|group| groups[group.index()].nearest() > 0).count();
        let in_space = any_flies && FEW_NEED * needing >= group.len() && self.long.is_empty();
        self.grid.set_heights(in_space.then_some(|row: usize| agents.altitude[row]));
        let Self { grid, long, near, scratch, .. } = self;
        let (grid, long, sleep) = (&*grid, &*long, &*sleep);
        // an agent that does not look up ignores agents that it passes clear of
        let looks_up = |row: usize| {
            groups[agents.group[row].index()].model.looks_in_space() || agents.vehicle[row].is_some_and(Vehicle::flies)
        };
        let plain = |found: &mut Vec<Near>, place: usize, list: &mut [u32], close_count: &mut u16| {
            let row = grid.order()[place] as usize;
            let group = &groups[agents.group[row].index()];
            let flat = !looks_up(row);
            let accept = |near: &mut Near| {
                let other = near.row as usize;
                if other == row || !agents.avoids(row, other) || any_flies && flat && agents.passes_clear(row, other) {
                    return false;
                }
                if any_flies {
                    near.distance_squared += agents.above(row, other) * agents.above(row, other);
                }
                true
            };
            let at = agents.position[row];
            grid.nearest(at, group.nearest(), group.neighbour_distance, accept, found);
            if !long.is_empty() {
                long.add(agents, grid, row, (group.nearest(), group.neighbour_distance), accept, found);
            }
            list[0] = found.len() as u32;
            let are_close = found.iter().filter(|near| near.distance_squared <= close * close);
            *close_count = are_close.count() as u16;
            for (entry, near) in list[1..].iter_mut().zip(&*found) {
                *entry = near.row;
            }
        };
        // groups with a shorter neighbour distance or fewer neighbours
        let shorten = |place: usize, list: &mut [u32], close_count: &mut u16| {
            let row = grid.order()[place] as usize;
            let group = &groups[agents.group[row].index()];
            let (at, range) = (agents.position[row], group.neighbour_distance);
            let counts = |&&other: &&u32| {
                let other = other as usize;
                let above = if in_space { agents.above(row, other) } else { 0.0 };
                agents.position[other].distance_squared(at) + above * above <= range * range
            };
            let seen = &list[1..=group.nearest().min(list[0] as usize)];
            list[0] = seen.iter().take_while(counts).count() as u32;
            *close_count = list[0].min(u32::from(*close_count)) as u16;
        };
        // a group of agents with more neighbours does not slow the others
        let any_few = state.groups_in_use().any(|group| group.nearest() <= FEW_NEIGHBOURS);
        let k = most.min(if any_few { FEW_NEIGHBOURS } else { MOST_NEIGHBOURS });
        // the SIMD search finds the nearest centres: not enough for an agent that ignores agents or is near a long body
        let avoids_all = AvoidsAll::of(agents);
        let passes_any = |row: usize, list: &[u32]| {
            let passes = |&other: &u32| agents.passes_clear(row, other as usize);
            !looks_up(row) && list[1..=list[0] as usize].iter().any(passes)
        };
        let is_other = |place: usize, list: &[u32]| {
            let row = grid.order()[place] as usize;
            let group = &groups[agents.group[row].index()];
            group.nearest() > k
                || !avoids_all.holds(agents, row)
                || any_flies && passes_any(row, list)
                || long.may_reach(agents, row, &list[1..=list[0] as usize], (group.nearest(), group.neighbour_distance))
        };
        let alone = most <= k && agents.all_avoid() && long.is_empty() && !any_flies;
        let any_fast = state.groups_in_use().any(|group| group.nearest() <= k);
        let many = level.filter(|_| any_fast && (in_space || !any_flies));
        let lists = RowLists { all: &mut near.lists, stride: most + 1 };
        let all = (lists, &mut near.close[..]);
        parallel::ranges_with(all, scratch, |(pack, found), places, all| {
            sleep.each_place(grid.order(), places, all, |places, (RowLists { all: lists, .. }, counts)| {
                let Some(level) = many else {
                    let all = lists.chunks_mut(most + 1).zip(counts);
                    return places.zip(all).for_each(|(place, (list, count))| plain(found, place, list, count));
                };
                let left = |place: usize, list: &mut [u32], count: &mut u16| plain(found, place, list, count);
                grid.nearest_of_many(level, places.clone(), (k, range, close), pack, (lists, counts), left);
                if !alike {
                    let all = lists.chunks_mut(most + 1).zip(&mut *counts);
                    places.clone().zip(all).for_each(|(place, (list, count))| shorten(place, list, count));
                }
                if !alone {
                    let all = lists.chunks_mut(most + 1).zip(counts);
                    let others = places.zip(all).filter(|(place, (list, _))| is_other(*place, list));
                    others.for_each(|(place, (list, count))| plain(found, place, list, count));
                }
            });
        });
    }
}

impl State {
    /// Records which groups have agents.
    pub(crate) fn note_groups(&mut self) {
        let Self { agents, local_groups: groups, groups_with_agents, .. } = self;
        groups_with_agents.clear();
        groups_with_agents.resize(groups.len(), false);
        agents.group.values().iter().for_each(|group| groups_with_agents[group.index()] = true);
    }

    /// Returns the groups that have agents.
    pub(crate) fn groups_in_use(&self) -> impl Iterator<Item = &Group> {
        self.local_groups.iter().zip(&self.groups_with_agents).filter(|&(_, &in_use)| in_use).map(|(group, _)| group)
    }
}

/// The layers by which an agent's avoidance of all others is known without asking for each.
pub(crate) struct AvoidsAll {
    /// Layers that every agent is on.
    common: u32,
    /// Whether every agent is on a layer.
    any: bool,
}

impl AvoidsAll {
    pub fn of(agents: &Columns) -> Self {
        let layers = agents.layers.values();
        Self { common: layers.iter().fold(u32::MAX, |common, each| common & each), any: !layers.contains(&0) }
    }

    /// Whether an agent avoids all others.
    pub fn holds(&self, agents: &Columns, row: usize) -> bool {
        let avoids = agents.avoids[row];
        avoids & self.common != 0 || self.any && avoids == u32::MAX
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::avoid::{LocalModel, Orca, Orca3d};
    use crate::{Agent, Body, Group, Settings, World};
    use glam::{DVec2, Vec2};
    use proptest::prelude::*;
    use std::sync::Arc;

    type One = ((f64, f64), f32, (f32, f32), bool, f32);

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        #[test]
        fn the_nearest_are_those_of_a_search_through_all(
            all in prop::collection::vec(
                (
                    (-6.0..6.0, -6.0..6.0),
                    -3.0f32..3.0,
                    (0.25f32..4.0, 0.25f32..0.625),
                    any::<bool>(),
                    prop_oneof![Just(0.0f32), 0.0f32..4.0],
                ),
                1..40,
            ),
            k in prop_oneof![1usize..8, 1usize..40], range in 1.0f32..6.0, (looks_up, only_discs) in any::<(bool, bool)>(),
        ) {
            let mut world = World::new(Settings::default()).unwrap();
            let model: Arc<dyn LocalModel> =
                if looks_up { Arc::new(Orca3d::default()) } else { Arc::new(Orca::default()) };
            let group = Group { neighbours: k, neighbour_distance: range, model, ..Group::default() };
            let group = world.add_group(group).unwrap();
            for ((x, y), heading, (length, width), disc, altitude) in all as Vec<One> {
                let body = if disc || only_discs { Body::disc(width) } else { Body::capsule(length, width) };
                let position = DVec2::new(x, y);
                let agent = Agent { position: position.extend(f64::from(altitude)), heading: Some(heading), group, ..Agent::default() };
                world.add_agent(agent.with_body(body)).unwrap();
            }
            let (mut state, mut perceive) = (world.state, Perceive::default());
            state.note_groups();
            let of = SubStep::new(&state, 0, 1);
            let near = perceive.run(&mut state, &mut SleepBlocks::default(), of).near;
            let agents = &state.agents;
            for row in 0..agents.len() {
                let above = |other: usize| {
                    let spheres = agents.core[row] == Vec2::ZERO && agents.core[other] == Vec2::ZERO;
                    if spheres { agents.altitude[other] - agents.altitude[row] } else { 0.0 }
                };
                let sees = |other: usize| {
                    looks_up || above(other).abs() < (agents.radius[row] + agents.radius[other]) * 1.05
                };
                let others = (0..agents.len()).filter(|&other| other != row && sees(other));
                let distance = |other: usize| {
                    agents.offset(row, other).length_squared() + above(other) * above(other)
                };
                let mut nearest: Vec<(f32, u32)> =
                    others.map(|other| (distance(other), agents.number[other])).collect();
                nearest.retain(|near| near.0 <= range * range);
                nearest.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                nearest.truncate(k);
                let found: Vec<(f32, u32)> = near
                    .of(row)
                    .iter()
                    .map(|&other| (distance(other as usize), agents.number[other as usize]))
                    .collect();
                prop_assert_eq!(found, nearest);
            }
        }
    }
}
