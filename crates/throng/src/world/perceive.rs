//! 1. Perception: the number of sub-steps of a step, and the nearest neighbours of all agents.

use super::World;
use crate::SubSteps;
use crate::agent::{Columns, Group};
use crate::parallel::{self, RowLists, WORD};
use crate::perceive::{Grid, MOST_NEIGHBOURS, Near};
use crate::simd::ones;
use glam::Vec2;

/// Greatest distance that an agent moves in a sub-step, as a part of the smallest clearance radius: while no two agents
/// are near each other, and in a crowd.
const FREE_MOVE: f32 = 0.25;
const CROWD_MOVE: f32 = 0.125;

impl World {
    /// Returns the number of sub-steps of the next step.
    pub(super) fn sub_steps(&mut self) -> u32 {
        let parts = match self.settings.sub_steps {
            SubSteps::Fixed(parts) => return parts,
            SubSteps::Auto => {
                let agents = &self.agents;
                let smallest = agents.bodies().map(|body| body.clearance_radius()).fold(f32::INFINITY, f32::min);
                let fastest = agents.max_speed.values().iter().copied().fold(0.0, f32::max);
                let part = if self.is_crowded() { CROWD_MOVE } else { FREE_MOVE };
                // an empty or motionless world: 0 / inf or 0 / x
                (self.settings.step as f32 * fastest / (part * smallest) - 1e-3).ceil()
            }
        };
        (parts as u32).clamp(1, 10_000)
    }

    /// Whether any two bodies are within a body's width of each other.
    fn is_crowded(&mut self) -> bool {
        if self.step.rest.unchanged() {
            return self.step.close_pair.is_some();
        }
        let agents = &self.agents;
        let widest = agents.bodies().map(|body| body.bounding_radius()).fold(0.0, f32::max) * 2.0;
        let any_flies = agents.any_flies();
        let close = |row: usize, other: usize, distance_squared: f32| {
            let above = if any_flies { agents.above(row, other) } else { 0.0 };
            row != other && distance_squared + above * above <= 4.0 * widest * widest
        };
        // the pair that was close before is most likely still close
        if let Some((row, other)) = self.step.close_pair
            && row.max(other) < agents.len()
        {
            let d = agents.position[other] - agents.position[row];
            if close(row, other, d.x * d.x + d.y * d.y) {
                return true;
            }
        }
        self.step.grid.rebuild(&agents.position, &agents.number, widest.max(0.1) * 2.0);
        let grid = &self.step.grid;
        self.step.close_pair = (0..agents.len()).find_map(|row| {
            let mut partner = None;
            grid.within(agents.position[row], widest * 2.0, |near| {
                let other = near.row as usize;
                if close(row, other, near.distance_squared) {
                    partner = Some((row, other));
                }
            });
            partner
        });
        self.step.close_pair.is_some()
    }

    /// Sorts all agents into the cells of the grid. Returns the greatest neighbour distance.
    pub(super) fn rebuild_grid(&mut self) -> f32 {
        self.note_groups();
        let range = self.groups_in_use().map(|group| group.neighbour_distance).fold(0.0, f32::max);
        self.step.grid.rebuild(&self.agents.position, &self.agents.number, range);
        range
    }

    /// 1. Perception: finds the nearest neighbours of all agents.
    pub(super) fn perceive(&mut self, seconds: f32) {
        if self.step.rest.all_asleep() {
            return;
        }
        self.note_groups();
        self.rebuild_lattice(seconds);
        let guarded = self.groups_in_use().any(|group| group.guard);
        if self.none_counts_the_nearest() && !guarded {
            self.step.near.clear(self.agents.len());
            return self.sort_rows_if_scattered();
        }
        let range = self.rebuild_grid();
        self.sort_rows_if_scattered();
        let most = self.groups_in_use().map(|group| group.nearest()).max().unwrap_or(1);
        let close = self.close_enough_to_measure(seconds);
        let alike = self.groups_in_use().all(|group| group.nearest() == most && group.neighbour_distance == range);
        let Self { agents, local_groups: groups, step, .. } = self;
        step.long.rebuild(agents, range);
        step.near.resize(step.grid.order(), most);
        let (grid, long, rest, scratch, level) =
            (&step.grid, &step.long, &step.rest, &mut step.perceiving, self.instructions.level());
        let any_flies = agents.any_flies();
        let plain = |found: &mut Vec<Near>, place: usize, list: &mut [u32], close_count: &mut u16| {
            let row = grid.order()[place] as usize;
            let group = &groups[agents.group[row].index()];
            let flat = !group.model.looks_in_space() && !group.steers_in_space();
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
            let counts = |&&other: &&u32| agents.position[other as usize].distance_squared(at) <= range * range;
            let seen = &list[1..=group.nearest().min(list[0] as usize)];
            list[0] = seen.iter().take_while(counts).count() as u32;
            *close_count = list[0].min(u32::from(*close_count)) as u16;
        };
        // the SIMD search finds the nearest centres: not enough for an agent that ignores others or is near a long body
        let avoids_all = AvoidsAll::of(agents);
        let is_other = |place: usize, list: &[u32]| {
            let row = grid.order()[place] as usize;
            let group = &groups[agents.group[row].index()];
            group.nearest() > MOST_NEIGHBOURS
                || !avoids_all.holds(agents, row)
                || long.may_reach(agents, row, &list[1..=list[0] as usize], (group.nearest(), group.neighbour_distance))
        };
        let alone = most <= MOST_NEIGHBOURS && agents.all_avoid() && long.is_empty();
        let any_fast = groups.iter().zip(&step.groups).any(|(group, &used)| used && group.nearest() <= MOST_NEIGHBOURS);
        let many = level.filter(|_| any_fast && !any_flies);
        let lists = RowLists { all: &mut step.near.lists, stride: most + 1 };
        let all = (lists, &mut step.near.close[..]);
        parallel::ranges_with(all, scratch, |(pack, found), places, all| {
            rest.each_place(grid.order(), places, all, |places, (RowLists { all: lists, .. }, counts)| {
                let Some(level) = many else {
                    let all = lists.chunks_mut(most + 1).zip(counts);
                    return places.zip(all).for_each(|(place, (list, count))| plain(found, place, list, count));
                };
                let left = |place: usize, list: &mut [u32], count: &mut u16| plain(found, place, list, count);
                let k = most.min(MOST_NEIGHBOURS);
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

    /// Records which groups have agents.
    pub(super) fn note_groups(&mut self) {
        let Self { agents, local_groups: groups, step, .. } = self;
        step.groups.clear();
        step.groups.resize(groups.len(), false);
        agents.group.values().iter().for_each(|group| step.groups[group.index()] = true);
    }

    /// Returns the groups that have agents.
    pub(super) fn groups_in_use(&self) -> impl Iterator<Item = &Group> {
        self.local_groups.iter().zip(&self.step.groups).filter(|&(_, &in_use)| in_use).map(|(group, _)| group)
    }

    /// Returns the rows of the neighbours of an agent, nearest first.
    pub(super) fn neighbours(&self, row: usize) -> &[u32] {
        self.step.near.of(row)
    }
}

/// The layers by which an agent's avoidance of all others is known without asking for each.
pub(super) struct AvoidsAll {
    /// Layers that every agent is on.
    common: u32,
    /// Whether every agent is on a layer.
    any: bool,
}

impl AvoidsAll {
    pub(super) fn of(agents: &Columns) -> Self {
        let layers = agents.layers.values();
        Self { common: layers.iter().fold(u32::MAX, |common, each| common & each), any: !layers.contains(&0) }
    }

    /// Whether an agent avoids all others.
    pub(super) fn holds(&self, agents: &Columns, row: usize) -> bool {
        let avoids = agents.avoids[row];
        avoids & self.common != 0 || self.any && avoids == u32::MAX
    }
}

/// The nearest neighbours of all agents.
#[derive(Clone, Debug, Default)]
pub(super) struct Neighbours {
    /// For each row the number of its neighbours, then space for as many as any agent may have; in the order of the
    /// grid.
    lists: Vec<u32>,
    /// How many of the neighbours may come close enough to be measured, in the order of the grid.
    close: Vec<u16>,
    most: usize,
    /// Index of the list of each row.
    places: Vec<u32>,
}

impl Neighbours {
    fn resize(&mut self, order: &[u32], most: usize) {
        self.most = most;
        self.lists.resize(order.len() * (most + 1), 0);
        self.close.resize(order.len(), 0);
        self.places.resize(order.len(), 0);
        for (place, &row) in (0..).zip(order) {
            self.places[row as usize] = place;
        }
    }

    /// Empties the lists of all rows.
    fn clear(&mut self, rows: usize) {
        self.most = 0;
        self.lists.clear();
        self.lists.resize(1, 0);
        self.close.clear();
        self.places.clear();
        self.places.resize(rows, 0);
    }

    /// Returns rows with neighbours that may come close enough to be measured, each with these neighbours, nearest
    /// first. Covers the 64 indices from `first` on in the order of the grid, or fewer at the end.
    pub(super) fn close_from<'a>(&'a self, order: &'a [u32], first: usize) -> impl Iterator<Item = (u32, &'a [u32])> {
        let counts = self.close[first.min(self.close.len())..].iter().take(WORD);
        let bits = counts.rev().fold(0, |bits, &close| bits << 1 | u64::from(close != 0));
        // their number is known without reading the list
        let list = |place: usize| &self.lists[place * (self.most + 1) + 1..][..self.close[place].into()];
        ones(bits).map(move |at| (order[first + at], list(first + at)))
    }

    /// Returns the rows of the neighbours of a row, nearest first.
    #[inline]
    pub(super) fn of(&self, row: usize) -> &[u32] {
        self.at(self.places[row] as usize)
    }

    /// Returns the rows of the neighbours of the agent at an index in the order of the grid, nearest first.
    #[inline]
    pub(super) fn at(&self, place: usize) -> &[u32] {
        let list = &self.lists[place * (self.most + 1)..];
        &list[1..=list[0] as usize]
    }

    /// Returns the index of each row in the order of the grid.
    pub(super) fn places(&self) -> &[u32] {
        &self.places
    }
}

/// Bodies that are not discs: they may be near although their centres are far.
#[derive(Clone, Debug, Default)]
pub(super) struct LongBodies {
    rows: Vec<usize>,
    points: Vec<Vec2>,
    numbers: Vec<u32>,
    grid: Grid,
    /// Greatest distance of a point of a core from its centre.
    reach: f32,
}

impl LongBodies {
    /// Whether all bodies are discs.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    fn rebuild(&mut self, agents: &Columns, cell: f32) {
        self.rows.clear();
        if !agents.all_discs() {
            self.rows.extend((0..agents.len()).filter(|&row| !agents.is_disc(row)));
        }
        let Self { rows, points, numbers, .. } = self;
        self.reach = rows.iter().map(|&row| agents.core[row].length()).fold(0.0, f32::max);
        points.clear();
        points.extend(rows.iter().map(|&row| agents.position[row]));
        numbers.clear();
        numbers.extend(rows.iter().map(|&row| agents.number[row]));
        self.grid.rebuild(points, numbers, cell);
    }

    /// Whether a long body may belong to the `k` nearest bodies of a row within `range`, given the bodies with the nearest
    /// centres.
    fn may_reach(&self, agents: &Columns, row: usize, nearest: &[u32], (k, range): (usize, f32)) -> bool {
        if self.is_empty() {
            return false;
        }
        if !agents.is_disc(row) || nearest.iter().any(|&other| !agents.is_disc(other as usize)) {
            return true;
        }
        let at = agents.position[row];
        let farthest = match nearest.last() {
            Some(&last) if nearest.len() >= k => at.distance(agents.position[last as usize]) * 1.0001,
            _ => range,
        };
        let mut any = false;
        self.grid.within(at, farthest + self.reach, |_| any = true);
        any
    }

    /// Merges long bodies into `found`, which holds the nearest discs to `row` by their centres. `found` then holds the
    /// `k` nearest bodies within `range` by the distance of cores.
    fn add(
        &self,
        agents: &Columns,
        grid: &Grid,
        row: usize,
        (k, range): (usize, f32),
        accept: impl Fn(&mut Near) -> bool,
        found: &mut Vec<Near>,
    ) {
        let at = agents.position[row];
        if agents.is_disc(row) {
            found.retain(|near| agents.is_disc(near.row as usize));
            self.grid.within(at, range + self.reach, |near| {
                found.push(Near { row: self.rows[near.row as usize] as u32, ..near });
            });
        } else {
            found.clear();
            grid.within(at, range + self.reach + agents.core[row].length(), |near| found.push(near));
        }
        found.retain_mut(accept);
        // cores are at least this far apart: a body beyond the limit by this measure needs no exact test
        let reach = |row: usize| agents.core[row].length();
        let least = |near: &Near| {
            let cores = reach(row) + reach(near.row as usize);
            (at.distance(agents.position[near.row as usize]) - cores) * 0.9999
        };
        found.sort_unstable_by(|a, b| least(a).total_cmp(&least(b)).then(a.number.cmp(&b.number)));
        let mut kept = 0;
        for next in 0..found.len() {
            let mut near = found[next];
            let worst = if kept < k { range } else { found[k - 1].distance_squared.sqrt() };
            if least(&near) > worst {
                break;
            }
            near.distance_squared = agents.offset_in_space(row, near.row as usize).length_squared();
            if near.distance_squared > range * range {
                continue;
            }
            let place = found[..kept]
                .partition_point(|other| (other.distance_squared, other.number) < (near.distance_squared, near.number));
            if place < k {
                // kept neighbours are in front, sorted by distance
                kept = (kept + 1).min(k);
                found[place..=next].rotate_right(1);
                found[place] = near;
            }
        }
        found.truncate(kept);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::avoid::{LocalModel, Orca, Orca3d};
    use crate::{Agent, Body, Group, Settings};
    use glam::DVec2;
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
            k in 1usize..8, range in 1.0f32..6.0, looks_up: bool,
        ) {
            let mut world = World::new(Settings::default()).unwrap();
            let model: Arc<dyn LocalModel> =
                if looks_up { Arc::new(Orca3d::default()) } else { Arc::new(Orca::default()) };
            let group = Group { neighbours: k, neighbour_distance: range, model, ..Group::default() };
            let group = world.add_group(group).unwrap();
            for ((x, y), heading, (length, width), disc, altitude) in all as Vec<One> {
                let body = if disc { Body::disc(width) } else { Body::capsule(length, width) };
                let position = DVec2::new(x, y);
                let agent = Agent { position: position.extend(f64::from(altitude)), heading: Some(heading), group, ..Agent::default() };
                world.add_agent(agent.with_body(body)).unwrap();
            }
            world.perceive(0.1);
            let agents = &world.agents;
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
                let found: Vec<(f32, u32)> = world
                    .neighbours(row)
                    .iter()
                    .map(|&other| (distance(other as usize), agents.number[other as usize]))
                    .collect();
                prop_assert_eq!(found, nearest);
            }
        }
    }
}
