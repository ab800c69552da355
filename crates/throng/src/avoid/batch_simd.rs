//! The gathering of a batch into arrays, and the limits of chosen velocities, with SIMD. The bits are the same as those
//! of the [scalar path](super::avoidance), which handles all other agents and their neighbours.

use super::batch::AvoidanceShared;
use super::squeeze::may_squeeze;
use super::{AvoidanceBatch, AvoidanceInput, MOST_SIMD_NEIGHBOURS, SimdInput, Workspace};
use crate::intend::{YIELD_AT_REST, YIELD_TO_FIRST};
use crate::navigate::{GOAL, WALKS};
use crate::simd::{LANES, Vec2s, load, load_pairs, ones, set};
use fearless_simd::prelude::*;
use glam::Vec2;

impl AvoidanceBatch<'_> {
    /// Gathers `agents`, one bit for each row, and their neighbours, except agents that see irregular agents.
    #[inline(always)]
    pub(super) fn gather<S: Simd>(&mut self, simd: S, gathered: u64) {
        let Self { avoiding, start, rows, scratch, .. } = self;
        let (input, start, shared) = (&mut scratch.input, *start, avoiding.shared);
        let (agents, around) = (&avoiding.state.agents, avoiding.around);
        let AvoidanceShared { squeeze, all_squeeze, equals, radius, margin, .. } = *shared;
        let (any_irregular, mut beside) = (shared.any_irregular(), 0);
        let (mut own_motion, mut own_keys) = ([[0.0; 4]; LANES], [0; LANES]);
        let mut keys = [[0; LANES]; MOST_SIMD_NEIGHBOURS];
        let (mut count, mut most) = ([0.0; LANES], 0);
        let mut own_way = [[0.0; LANES]; 2];
        for (lane, &row) in rows.iter().enumerate() {
            let own = &around.shown[row as usize];
            (own_motion[lane], own_keys[lane]) = (own.motion, own.way.key());
            set(&mut input.preferred, lane, avoiding.relaxed_velocity(row as usize, shared.step));
            let neighbours = if gathered >> lane & 1 == 1 { around.near.at(start + lane) } else { &[] };
            most = most.max(neighbours.len());
            count[lane] = neighbours.len() as f32;
            if any_irregular && neighbours.iter().any(|&other| shared.is_irregular(other)) {
                beside |= 1 << lane;
            }
            if squeeze {
                set(&mut own_way, lane, own.way.direction);
            }
            for ((&other, others), keys) in neighbours.iter().zip(&mut input.neighbours).zip(&mut keys) {
                let shown = &around.shown[other as usize];
                others.motion[lane] = shown.motion;
                if squeeze {
                    set(&mut others.way, lane, shown.way.direction);
                }
                keys[lane] = shown.way.key();
            }
        }
        let splat = |value: f32| S::f32s::splat(simd, value);
        let of = |keys: &[u32; LANES]| S::u32s::from_slice(simd, &keys[..S::f32s::LEN]);
        let (own, zero) = (of(&own_keys), S::u32s::splat(simd, 0));
        let (walks, goal) = (S::u32s::splat(simd, WALKS), S::u32s::splat(simd, GOAL));
        let count = load(simd, &count);
        let [position, velocity] = load_pairs(simd, &own_motion);
        position.store(&mut input.position);
        velocity.store(&mut input.velocity);
        agents.max_speed.simd_of(simd, rows).store_slice(&mut input.max_speed[..S::f32s::LEN]);
        let SimdInput { neighbours, there: all_there, .. } = input;
        for (index, (others, keys)) in neighbours[..most].iter_mut().zip(&keys).enumerate() {
            let theirs = of(keys);
            let there = count.simd_gt(S::f32s::splat(simd, index as f32));
            let pair = |lane: usize| (rows[lane] as usize, around.near.at(start + lane)[index] as usize);
            all_there[index] = there.to_bitmask();
            if squeeze {
                let may = may_squeeze(simd, [position, velocity], Vec2s::load(simd, &own_way), others);
                for lane in ones((may & there).to_bitmask()) {
                    let (row, other) = pair(lane);
                    if all_squeeze || avoiding.state.both_squeeze(row, other) {
                        all_there[index] &= !(1 << lane);
                    }
                }
            }
            if radius.is_none() {
                for lane in ones(there.to_bitmask()) {
                    let (row, other) = pair(lane);
                    others.radii[lane] = (agents.radius[row] + agents.radius[other]) * margin;
                }
            }
            others.share = [0.5; LANES];
            // if both walk to different goals, neither has the right of way
            let unlike = (own & theirs & walks).simd_eq(zero) | ((own ^ theirs) & goal).simd_eq(zero);
            let unlike = unlike.to_bitmask() & there.to_bitmask();
            if equals && unlike == 0 {
                continue;
            }
            let (mut left, mut sizes) = ([[0.0; LANES]; 2], [1.0; LANES]);
            for lane in ones(unlike) {
                let (row, other) = pair(lane);
                set(&mut left, lane, Vec2::new(around.shown[row].way.remaining, around.shown[other].way.remaining));
                sizes[lane] = agents.radius[row] + agents.radius[other];
            }
            let left: Vec2s<S> = Vec2s::load(simd, &left);
            // as `Surroundings::yields`
            let [i_walk, they_walk] = [own, theirs].map(|keys| !(keys & walks).simd_eq(zero));
            let same = ((own ^ theirs) & goal).simd_eq(zero);
            let lead = (left.x - left.y) / load(simd, &sizes);
            let first = splat(YIELD_TO_FIRST) * lead.max(splat(-1.0)).min(splat(1.0));
            let rests = i_walk.select(splat(-YIELD_AT_REST), splat(YIELD_AT_REST));
            let one_walks = (i_walk ^ they_walk) & !same;
            let yields = (i_walk & they_walk & same).select(first, one_walks.select(rests, splat(0.0)));
            others.share[..S::f32s::LEN].copy_from_slice((splat(0.5) + yields).as_slice());
            let scalar = if equals { yields.simd_gt(splat(0.0)) & there } else { there };
            for lane in ones(scalar.to_bitmask()) {
                let (row, other) = pair(lane);
                let yields = yields.as_slice()[lane];
                let granted = avoiding.granted(row, other, yields);
                scratch.queues += usize::from(yields > 0.0 && yields < YIELD_AT_REST);
                if !equals {
                    others.share[lane] = avoiding.state.share(row, other, yields);
                }
                others.motion[lane][2] += granted.x;
                others.motion[lane][3] += granted.y;
            }
        }
        (input.agents, input.most, input.step) = (gathered & !beside, most, shared.step);
    }

    /// Removes neighbours that walls hide, and agents that see walls for which `walls` returns false.
    pub(super) fn see_walls(
        &mut self,
        mut walls: impl FnMut(&mut SimdInput, usize, &AvoidanceInput<'_>, &mut Workspace) -> bool,
    ) {
        let Self { avoiding, rows, scratch, .. } = self;
        let (state, input) = (avoiding.state, &mut scratch.input);
        input.walls.clear();
        if avoiding.shared.open {
            return;
        }
        for lane in ones(input.agents) {
            let row = rows[lane] as usize;
            let range = state.model(row).wall_range(state.agents.radius[row], state.agents.max_speed[row]);
            if state.walls.are_far(state.agents.position[row].as_dvec2(), range.into()) {
                continue;
            }
            let sight = &mut scratch.sight;
            state.see_walls(row, sight);
            if sight.is_open() {
                continue;
            }
            let view = avoiding.view_of(row, avoiding.shared.step, sight);
            if !walls(input, lane, &view, &mut scratch.workspace) {
                input.agents &= !(1 << lane);
                continue;
            }
            for (&other, there) in avoiding.around.neighbours(row).iter().zip(&mut input.there) {
                if sight.hides(state.agents.offset(row, other as usize)) {
                    *there &= !(1 << lane);
                }
            }
        }
    }

    /// Limits the velocities chosen with SIMD to what the bodies can do.
    #[inline(always)]
    pub(super) fn limit<S: Simd>(&mut self, simd: S) {
        let (rows, input) = (self.rows, &self.scratch.input);
        let velocity = Vec2s::load(simd, &input.velocity);
        let most = self.avoiding.state.agents.max_acceleration.simd_of(simd, rows) * S::f32s::splat(simd, input.step);
        let change = (Vec2s::load(simd, &input.chosen) - velocity).clamp_length_max(most);
        let limited: Vec2s<S> = (velocity + change).clamp_length_max(load(simd, &input.max_speed));
        if input.agents.count_ones() as usize == rows.len() {
            limited.put_side_by_side(self.chosen);
        } else {
            for lane in ones(input.agents) {
                self.chosen[lane] = Vec2::new(limited.x[lane], limited.y[lane]);
            }
        }
        self.left &= !input.agents;
    }
}
