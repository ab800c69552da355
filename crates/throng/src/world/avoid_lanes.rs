//! Many agents avoid at once, a lane an agent: those whose model is a plain ORCA, on the ground, away from walls. The same
//! bits as [one by one](super::avoid), where everybody else goes.

use super::World;
use crate::avoid::{Line, LocalModel, MOST, Orca, Views, choose, margin};
use crate::lanes::{LANES, Vec2s, load, ones, set};
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::{Vec2, Vec3};
use std::ops::Range;

/// What a thread keeps while it goes through agents.
#[derive(Clone, Debug, Default)]
pub(super) struct LaneScratch {
    views: Views,
    fallback: [Vec<Line>; 2],
}

/// What everybody has in common where many can avoid at once.
#[derive(Clone, Copy)]
pub(super) struct Common {
    level: Level,
    orca: Orca,
    /// Whether everybody goes by it.
    alike: bool,
    /// Whether there are no walls.
    open: bool,
    /// The radius, if all have the same.
    radius: Option<f32>,
    /// Whether all have the same priority.
    equals: bool,
    margin: f32,
    step: f32,
}

impl World {
    /// What everybody has in common, if many can avoid at once.
    pub(super) fn common(&self, seconds: f32) -> Option<Common> {
        let agents = &self.agents;
        let plain = agents.all_discs()
            && !agents.anybody_flies()
            && agents.all_avoid()
            && agents.script.uniform() == Some(None)
            && agents.spin.uniform() == Some(0.0)
            && agents.climb.uniform() == Some(0.0)
            && agents.tracking_error.uniform() == Some(0.0)
            && agents.max_turn_rate.uniform() == Some(f32::INFINITY)
            && self.standoffs.is_empty()
            && self.groups_in_use().all(|group| group.neighbours <= MOST);
        let orca = self.groups_in_use().find_map(|group| group.model.as_orca())?;
        let level = self.instructions.level()?;
        plain.then(|| Common {
            level,
            orca,
            open: self.walls.is_empty(),
            alike: self.groups_in_use().all(|group| group.model.as_orca() == Some(orca)),
            radius: agents.radius.uniform(),
            equals: agents.priority.uniform().is_some(),
            margin: margin(seconds),
            step: seconds,
        })
    }

    /// The velocities that a range of rows will have but for the guard. Calls `left` for those that go one by one.
    pub(super) fn avoid_many(
        &self,
        common: &Common,
        rows: Range<usize>,
        scratch: &mut LaneScratch,
        wishes: &mut [Vec3],
        left: impl FnMut(usize) -> Vec3,
    ) {
        dispatch!(common.level, simd => self.many(simd, common, rows, scratch, wishes, left));
    }

    #[inline(always)]
    fn many<S: Simd>(
        &self,
        simd: S,
        common: &Common,
        rows: Range<usize>,
        scratch: &mut LaneScratch,
        wishes: &mut [Vec3],
        mut left: impl FnMut(usize) -> Vec3,
    ) {
        if let Some(radius) = common.radius {
            let radii = (radius + radius) * common.margin;
            scratch.views.neighbours.iter_mut().for_each(|others| others.radii = [radii; LANES]);
        }
        let lanes = S::f32s::LEN;
        let first = rows.start;
        for start in rows.clone().step_by(lanes) {
            let part = start..(start + lanes).min(rows.end);
            let out = &mut wishes[start - first..part.end - first];
            let mut missing = self.misfits(common, part.clone());
            // lanes for a few are dearer than one by one
            if 2 * missing.count_ones() as usize > part.len() {
                part.zip(out).for_each(|(row, wish)| *wish = left(row));
                continue;
            }
            self.view_many(common, part.clone(), &mut scratch.views);
            let chosen = choose(simd, &common.orca, &scratch.views, common.step, &mut scratch.fallback);
            missing |= chosen.left;
            self.limit_many(simd, common, part.clone(), &scratch.views, chosen.velocity, out);
            for lane in ones(missing & ((1 << part.len()) - 1)) {
                out[lane] = left(start + lane);
            }
        }
    }

    /// Who of a range of rows goes by another model, wants to leave the ground or sees walls, as bits.
    fn misfits(&self, common: &Common, rows: Range<usize>) -> u64 {
        let model = |row: usize| self.groups[self.agents.group[row].index()].model.as_orca();
        let fits = |row: usize| {
            self.step.preferred[row].z <= 0.0
                && (common.alike || model(row) == Some(common.orca))
                && (common.open || self.sees_no_wall(row, &common.orca))
        };
        rows.rev().fold(0, |misfits, row| misfits << 1 | u64::from(!fits(row)))
    }

    /// What a range of rows sees.
    #[inline(always)]
    fn view_many(&self, common: &Common, rows: Range<usize>, views: &mut Views) {
        let (agents, step) = (&self.agents, &self.step);
        for (lane, row) in rows.enumerate() {
            set(&mut views.position, lane, agents.position[row]);
            set(&mut views.velocity, lane, agents.velocity[row]);
            set(&mut views.preferred, lane, step.preferred[row].truncate());
            views.max_speed[lane] = agents.max_speed[row];
            let neighbours = step.near.of(row);
            views.count[lane] = neighbours.len() as f32;
            let way = &step.ways[row];
            for (&other, others) in neighbours.iter().zip(&mut views.neighbours) {
                let other = other as usize;
                let (mut yields, mut granted) = (0.0, Vec2::ZERO);
                if !way.are_equals(&step.ways[other]) {
                    yields = self.yields(row, other);
                    granted = self.granted(row, other, yields);
                }
                others.share[lane] = 0.5 + yields;
                if !common.equals {
                    others.share[lane] = self.share(row, other, yields);
                }
                if common.radius.is_none() {
                    others.radii[lane] = (agents.radius[row] + agents.radius[other]) * common.margin;
                }
                let (position, velocity) = (agents.position[other], agents.velocity[other] + granted);
                others.motion[lane] = [position.x, position.y, velocity.x, velocity.y];
            }
        }
    }

    /// Whether no wall is near enough to matter.
    fn sees_no_wall(&self, row: usize, orca: &Orca) -> bool {
        let range = orca.wall_range(self.agents.radius[row], self.agents.max_speed[row]);
        self.walls.is_clear(self.agents.position[row].as_dvec2(), f64::from(range))
    }

    /// What bodies can do of chosen velocities.
    #[inline(always)]
    fn limit_many<S: Simd>(
        &self,
        simd: S,
        common: &Common,
        rows: Range<usize>,
        views: &Views,
        chosen: Vec2s<S>,
        out: &mut [Vec3],
    ) {
        let mut most = [0.0; LANES];
        for (most, row) in most.iter_mut().zip(rows) {
            *most = self.agents.max_acceleration[row] * common.step;
        }
        let velocity = Vec2s::load(simd, &views.velocity);
        let change = (chosen - velocity).clamp_length_max(load(simd, &most));
        let limited = (velocity + change).clamp_length_max(load(simd, &views.max_speed));
        for (lane, wish) in out.iter_mut().enumerate() {
            *wish = Vec3::new(limited.x[lane], limited.y[lane], 0.0);
        }
    }
}
