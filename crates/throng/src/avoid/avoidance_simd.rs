//! Avoidance with SIMD, one agent in each element: agents on the ground with a plain ORCA model. The bits are the same
//! as those of the [scalar path](super::avoidance), which handles all other agents and their neighbours.

use super::avoidance::{Avoiding, Visibility};
use super::squeeze::may_squeeze;
use super::{
    HalfPlane, LocalModel, MOST, MOST_WALLS, MOST_WITH_WALLS, Orca, SimdAgents, SimdInputs, Workspace, choose, margin,
};
use crate::agent::Group;
use crate::intend::{YIELD_AT_REST, YIELD_TO_FIRST};
use crate::navigate::{GOAL, Turn, WALKS};
use crate::simd::{LANES, Vec2s, load, load_pairs, ones, set};
use crate::world::State;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::{Vec2, Vec3};
use std::ops::Range;

/// Scratch memory of a thread.
#[derive(Clone, Debug, Default)]
pub(crate) struct LaneScratch {
    views: SimdInputs,
    fallback: [Vec<HalfPlane>; 2],
    sight: Visibility,
    workspace: Workspace,
    /// Pairs of which one queues behind the other.
    pub queues: usize,
}

/// What all agents share where avoidance uses SIMD.
#[derive(Clone, Copy)]
pub(crate) struct AvoidanceShared {
    level: Level,
    orca: Orca,
    /// Whether all groups use this ORCA model.
    alike: bool,
    /// Whether there are no walls.
    open: bool,
    /// The radius, if it is the same for all agents.
    radius: Option<f32>,
    /// Whether all agents have the same priority.
    equals: bool,
    /// Whether the agents of some groups squeeze past others, and whether those of all groups do.
    squeeze: bool,
    all_squeeze: bool,
    margin: f32,
    step: f32,
}

/// Agents that are not plain discs: the scalar path handles them and all agents that see them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Irregular {
    /// By row; empty if there are none.
    rows: Vec<bool>,
}

impl Irregular {
    fn holds(&self, row: u32) -> bool {
        self.rows.get(row as usize) == Some(&true)
    }

    /// Returns what all agents share, if avoidance can use SIMD, and finds the agents that cannot.
    pub fn common(&mut self, state: &State, seconds: f32) -> Option<AvoidanceShared> {
        let orca = state.groups_in_use().find_map(|group| group.model.as_orca())?;
        let level = state.instructions.level().filter(|_| !state.in_space_now())?;
        let all_avoid = self.find(state);
        let agents = &state.agents;
        all_avoid.then(|| AvoidanceShared {
            level,
            orca,
            open: state.walls.is_empty(),
            alike: state.groups_in_use().all(|group| group.model.as_orca() == Some(orca)),
            radius: agents.radius.uniform(),
            equals: agents.priority.uniform().is_some(),
            squeeze: state.groups_in_use().any(Group::squeezes),
            all_squeeze: state.groups_in_use().all(Group::squeezes),
            margin: margin(seconds),
            step: seconds,
        })
    }

    /// Finds the irregular agents. Returns whether all others avoid each other.
    fn find(&mut self, state: &State) -> bool {
        let State { agents, local_groups: groups, standoffs, .. } = state;
        let is_regular = |row: usize| {
            agents.core[row] == Vec2::ZERO
                && agents.script[row].is_none()
                && agents.spin[row] == 0.0
                && agents.tracking_error[row] == 0.0
                && agents.max_turn_rate[row] == f32::INFINITY
                && agents.travel[row].turn == Turn::Free
                && groups[agents.group[row].index()].neighbours <= MOST
        };
        self.rows.clear();
        let are_alike = agents.core.uniform().is_some()
            && agents.script.uniform().is_some()
            && agents.spin.uniform().is_some()
            && agents.tracking_error.uniform().is_some()
            && agents.max_turn_rate.uniform().is_some()
            && standoffs.is_empty()
            && state.groups_in_use().all(|group| group.neighbours <= MOST);
        if are_alike && (agents.is_empty() || is_regular(0)) {
            return agents.all_avoid();
        }
        self.rows.extend((0..agents.len()).map(|row| !is_regular(row)));
        let regular = (0..agents.len()).filter(|&row| !self.rows[row]);
        let common = |(layers, avoids), row: usize| (layers & agents.layers[row], avoids & agents.avoids[row]);
        let (layers, avoids) = regular.fold((u32::MAX, u32::MAX), common);
        layers & avoids != 0
    }
}

impl Avoiding<'_> {
    /// Computes the chosen velocities of the agents in a range of the grid's order. Calls `left` for rows that the SIMD
    /// kernel cannot handle.
    pub fn avoid_many(
        &self,
        common: &AvoidanceShared,
        places: Range<usize>,
        scratch: &mut LaneScratch,
        chosen_velocities: &mut [Vec2],
        left: impl FnMut(usize) -> Vec3,
    ) {
        dispatch!(common.level, simd => self.many(simd, common, places, scratch, chosen_velocities, left));
    }

    #[inline(always)]
    fn many<S: Simd>(
        &self,
        simd: S,
        common: &AvoidanceShared,
        places: Range<usize>,
        scratch: &mut LaneScratch,
        chosen_velocities: &mut [Vec2],
        mut left: impl FnMut(usize) -> Vec3,
    ) {
        if let Some(radius) = common.radius {
            let radii = (radius + radius) * common.margin;
            scratch.views.neighbours.iter_mut().for_each(|others| others.radii = [radii; LANES]);
        }
        let lanes = S::f32s::LEN;
        let rows = self.grid.order()[places.clone()].chunks(lanes);
        for ((start, rows), out) in places.step_by(lanes).zip(rows).zip(chosen_velocities.chunks_mut(lanes)) {
            let mut missing = self.misfits(common, rows);
            // for few agents the scalar path is cheaper
            if 2 * missing.count_ones() as usize > rows.len() {
                rows.iter()
                    .zip(out)
                    .for_each(|(&row, chosen_velocity)| *chosen_velocity = left(row as usize).truncate());
                continue;
            }
            let (own, beside, queues) = self.view_many(simd, common, (start, rows, missing), &mut scratch.views);
            missing |= beside;
            scratch.queues += queues;
            scratch.views.clear_walls();
            if !common.open {
                missing |= self.see_walls_of_many(common, rows, missing, scratch);
            }
            let LaneScratch { views, fallback, .. } = scratch;
            let chosen = if views.has_walls() {
                choose::<S, MOST_WITH_WALLS>(simd, &common.orca, &own, views, common.step, fallback)
            } else {
                choose::<S, MOST>(simd, &common.orca, &own, views, common.step, fallback)
            };
            missing |= chosen.left;
            let most = self.state.agents.max_acceleration.simd_of(simd, rows) * S::f32s::splat(simd, common.step);
            let change = (chosen.velocity - own.velocity).clamp_length_max(most);
            (own.velocity + change).clamp_length_max(own.max_speed).put_side_by_side(out);
            for lane in ones(missing & ((1 << rows.len()) - 1)) {
                out[lane] = left(rows[lane] as usize).truncate();
            }
        }
    }

    /// Returns the rows with another local model and the irregular ones, one bit for each row.
    fn misfits(&self, common: &AvoidanceShared, rows: &[u32]) -> u64 {
        if common.alike && self.irregular.rows.is_empty() {
            return 0;
        }
        let model = |row: u32| self.state.local_groups[self.state.agents.group[row as usize].index()].model.as_orca();
        let fits = |row: u32| (common.alike || model(row) == Some(common.orca)) && !self.irregular.holds(row);
        rows.iter().rev().fold(0, |misfits, &row| misfits << 1 | u64::from(!fits(row)))
    }

    /// Adds the half-planes of walls for rows that are not `missing`, and removes neighbours that walls hide. Returns
    /// the rows with too many half-planes, one bit for each row.
    fn see_walls_of_many(
        &self,
        common: &AvoidanceShared,
        rows: &[u32],
        missing: u64,
        scratch: &mut LaneScratch,
    ) -> u64 {
        let LaneScratch { views, sight, workspace, .. } = scratch;
        let mut too_many = 0;
        for lane in ones(!missing & ((1 << rows.len()) - 1)) {
            let row = rows[lane] as usize;
            let range = common.orca.wall_range(self.state.agents.radius[row], self.state.agents.max_speed[row]);
            if self.state.walls.are_far(self.state.agents.position[row].as_dvec2(), range.into()) {
                continue;
            }
            self.state.see_walls(row, sight);
            if sight.is_open() {
                continue;
            }
            let lines = common.orca.permit_walls(&self.view_of(row, common.step, sight), workspace);
            if lines.len() > MOST_WALLS {
                too_many |= 1 << lane;
                continue;
            }
            views.permit(lane, lines);
            for (&other, there) in self.around.neighbours(row).iter().zip(&mut views.there) {
                if sight.hides(self.state.agents.offset(row, other as usize)) {
                    *there &= !(1 << lane);
                }
            }
        }
        too_many
    }

    /// Gathers the neighbour data of consecutive agents in the grid's order, starting at `start`, except those that are
    /// `missing`. Returns their own data, which of them see irregular agents, one bit for each row, and the number of
    /// pairs in queues.
    #[inline(always)]
    fn view_many<S: Simd>(
        &self,
        simd: S,
        common: &AvoidanceShared,
        (start, rows, missing): (usize, &[u32], u64),
        views: &mut SimdInputs,
    ) -> (SimdAgents<S>, u64, usize) {
        let (agents, around) = (&self.state.agents, self.around);
        let (any_irregular, mut beside) = (!self.irregular.rows.is_empty(), 0);
        let (mut own_motion, mut preferred) = ([[0.0; 4]; LANES], [[0.0; LANES]; 2]);
        let (mut own_keys, mut keys) = ([0; LANES], [[0; LANES]; MOST]);
        let (mut count, mut most) = ([0.0; LANES], 0);
        let mut own_way = [[0.0; LANES]; 2];
        let mut queues = 0;
        for (lane, &row) in rows.iter().enumerate() {
            let own = &around.shown[row as usize];
            (own_motion[lane], own_keys[lane]) = (own.motion, own.way.key());
            set(&mut preferred, lane, self.relaxed_velocity(row as usize, common.step));
            let neighbours = if missing >> lane & 1 == 0 { around.near.at(start + lane) } else { &[] };
            most = most.max(neighbours.len());
            count[lane] = neighbours.len() as f32;
            if any_irregular && neighbours.iter().any(|&other| self.irregular.holds(other)) {
                beside |= 1 << lane;
            }
            if common.squeeze {
                set(&mut own_way, lane, own.way.direction);
            }
            for ((&other, others), keys) in neighbours.iter().zip(&mut views.neighbours).zip(&mut keys) {
                let shown = &around.shown[other as usize];
                others.motion[lane] = shown.motion;
                if common.squeeze {
                    set(&mut others.way, lane, shown.way.direction);
                }
                keys[lane] = shown.way.key();
            }
        }
        let splat = |value: f32| S::f32s::splat(simd, value);
        let lanes = |keys: &[u32; LANES]| S::u32s::from_slice(simd, &keys[..S::f32s::LEN]);
        let (own, zero) = (lanes(&own_keys), S::u32s::splat(simd, 0));
        let (walks, goal) = (S::u32s::splat(simd, WALKS), S::u32s::splat(simd, GOAL));
        let count = load(simd, &count);
        let [position, velocity] = load_pairs(simd, &own_motion);
        views.most = most;
        for (index, (others, keys)) in views.neighbours[..most].iter_mut().zip(&keys).enumerate() {
            let theirs = lanes(keys);
            let there = count.simd_gt(S::f32s::splat(simd, index as f32));
            views.there[index] = there.to_bitmask();
            if common.squeeze {
                let may = may_squeeze(simd, [position, velocity], Vec2s::load(simd, &own_way), others);
                for lane in ones((may & there).to_bitmask()) {
                    let (row, other) = (rows[lane] as usize, around.near.at(start + lane)[index] as usize);
                    if common.all_squeeze || self.state.both_squeeze(row, other) {
                        views.there[index] &= !(1 << lane);
                    }
                }
            }
            if common.radius.is_none() {
                for lane in ones(there.to_bitmask()) {
                    let (row, other) = (rows[lane] as usize, around.near.at(start + lane)[index] as usize);
                    others.radii[lane] = (agents.radius[row] + agents.radius[other]) * common.margin;
                }
            }
            others.share = [0.5; LANES];
            // if both walk to different goals, neither has the right of way
            let equals = !(own & theirs & walks).simd_eq(zero) & !((own ^ theirs) & goal).simd_eq(zero);
            let unlike = (!equals & there).to_bitmask();
            if common.equals && unlike == 0 {
                continue;
            }
            let (mut left, mut sizes) = ([[0.0; LANES]; 2], [1.0; LANES]);
            for lane in ones(unlike) {
                let (row, other) = (rows[lane] as usize, around.near.at(start + lane)[index] as usize);
                set(&mut left, lane, Vec2::new(around.shown[row].way.remaining, around.shown[other].way.remaining));
                sizes[lane] = agents.radius[row] + agents.radius[other];
            }
            let left: Vec2s<S> = Vec2s::load(simd, &left);
            // as `World::yields`
            let [i_walk, they_walk] = [own, theirs].map(|keys| !(keys & walks).simd_eq(zero));
            let same = ((own ^ theirs) & goal).simd_eq(zero);
            let lead = (left.x - left.y) / load(simd, &sizes);
            let first = splat(YIELD_TO_FIRST) * lead.max(splat(-1.0)).min(splat(1.0));
            let rests = i_walk.select(splat(-YIELD_AT_REST), splat(YIELD_AT_REST));
            let one_walks = (i_walk ^ they_walk) & !same;
            let yields = (i_walk & they_walk & same).select(first, one_walks.select(rests, splat(0.0)));
            others.share[..S::f32s::LEN].copy_from_slice((splat(0.5) + yields).as_slice());
            let scalar = if common.equals { yields.simd_gt(splat(0.0)) & there } else { there };
            for lane in ones(scalar.to_bitmask()) {
                let (row, other) = (rows[lane] as usize, around.near.at(start + lane)[index] as usize);
                let yields = yields.as_slice()[lane];
                let granted = self.granted(row, other, yields);
                queues += usize::from(yields > 0.0 && yields < YIELD_AT_REST);
                if !common.equals {
                    others.share[lane] = self.state.share(row, other, yields);
                }
                others.motion[lane][2] += granted.x;
                others.motion[lane][3] += granted.y;
            }
        }
        let max_speed = agents.max_speed.simd_of(simd, rows);
        (SimdAgents { position, velocity, preferred: Vec2s::load(simd, &preferred), max_speed }, beside, queues)
    }
}
