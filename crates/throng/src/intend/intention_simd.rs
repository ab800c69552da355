//! Preferred velocities with SIMD, one agent in each element: agents that walk straight to a distant point on the
//! ground and make progress. The bits are the same as those of the [scalar path](super::intention), which handles all
//! other agents.

use super::intention::Intending;
use crate::navigate::RouteProgress;
use crate::simd::{LANES, Vec2s, load, ones, set};
use crate::world::State;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::{Vec2, Vec3};
use std::ops::Range;

impl Intending<'_> {
    /// Computes the preferred velocities of a range of rows. Calls `left` for rows that the SIMD kernel cannot handle.
    pub fn intend_many(
        &self,
        level: Level,
        rows: Range<usize>,
        travels: &mut [RouteProgress],
        preferred: &mut [Vec2],
        seconds: f32,
        left: impl FnMut(usize, &mut RouteProgress) -> Vec3,
    ) {
        dispatch!(level, simd => self.intend_all(simd, rows, travels, preferred, seconds, left));
    }

    #[inline(always)]
    fn intend_all<S: Simd>(
        &self,
        simd: S,
        rows: Range<usize>,
        travels: &mut [RouteProgress],
        preferred: &mut [Vec2],
        seconds: f32,
        mut left: impl FnMut(usize, &mut RouteProgress) -> Vec3,
    ) {
        let lanes = S::f32s::LEN;
        let parts = travels.chunks_mut(lanes).zip(preferred.chunks_mut(lanes));
        for (start, (travels, preferred)) in rows.step_by(lanes).zip(parts) {
            for lane in ones(self.intend_some(simd, start, travels, preferred, seconds)) {
                preferred[lane] = left(start + lane, &mut travels[lane]).truncate();
            }
        }
    }

    /// Computes the preferred velocities of a SIMD vector of rows, starting at `start`. Returns the rows that it cannot
    /// handle, one bit for each row.
    #[inline(always)]
    fn intend_some<S: Simd>(
        &self,
        simd: S,
        start: usize,
        travels: &mut [RouteProgress],
        preferred: &mut [Vec2],
        seconds: f32,
    ) -> u64 {
        let agents = &self.state.agents;
        let rows = start..start + travels.len();
        let all_rows = (1 << rows.len()) - 1;
        let mut fits = 0;
        let (mut direction, mut remaining) = ([[0.0; LANES]; 2], [0.0; LANES]);
        let (mut mark, mut stalled) = ([0.0; LANES], [0.0; LANES]);
        let (mut gap_speed, mut stops, mut resolve) = ([f32::INFINITY; LANES], 0, 0);
        let mut turn = [[0.0; LANES]; 2];
        for ((lane, row), travel) in rows.clone().enumerate().zip(&*travels) {
            let way = self.around.way(row);
            let interaction = &self.interaction[agents.group[row].index()];
            let mut fit = way.is_plain() && way.direction != Vec2::ZERO && !interaction.governed;
            fit &= travel.is_plain() && agents.script[row].is_none() && agents.vehicle[row].is_none();
            (mark[lane], stalled[lane]) = (travel.mark, travel.stalled);
            resolve |= u64::from(interaction.resolve) << lane;
            fits |= u64::from(fit) << lane;
            set(&mut direction, lane, way.direction);
            stops |= u64::from(way.stops()) << lane;
            remaining[lane] = way.remaining;
            let ahead = self.ahead.of(row);
            gap_speed[lane] = ahead.speed;
            set(&mut turn, lane, ahead.turn);
        }
        if fits == 0 {
            return all_rows;
        }
        let splat = |value: f32| S::f32s::splat(simd, value);
        let zero = splat(0.0);
        let mask = |bits: u64| S::mask32s::from_bitmask(simd, bits);
        let direction: Vec2s<S> = Vec2s::load(simd, &direction);
        let remaining = load(simd, &remaining);
        let radius = agents.radius.lanes(simd, rows.clone());
        let preferred_speed = agents.preferred_speed.lanes(simd, rows.clone());
        // as `RouteProgress::stall`
        let (mark, stalled) = (load(simd, &mark), load(simd, &stalled));
        let waits = remaining.simd_gt(mark - radius);
        let walked = splat(seconds) * preferred_speed / radius;
        let stalled = waits.select(stalled + walked, zero);
        let mark = waits.select(mark, remaining);
        let max_acceleration = agents.max_acceleration.lanes(simd, rows.clone());
        let stopping = (max_acceleration * remaining).sqrt().min(remaining / splat(seconds));
        let arriving = mask(stops).select(stopping, splat(f32::INFINITY));
        let speed = preferred_speed.min(arriving).min(load(simd, &gap_speed));
        let [cos, sin] = [&turn[0], &turn[1]].map(|all| load(simd, all));
        let turned: Vec2s<S> =
            Vec2s { x: cos * direction.x + sin * direction.y, y: cos * direction.y - sin * direction.x };
        (turned * speed).put_side_by_side(preferred);
        let fits = fits & all_rows;
        for lane in ones(fits & resolve) {
            (travels[lane].mark, travels[lane].stalled) = (mark[lane], stalled[lane]);
        }
        !fits & all_rows
    }
}

impl State {
    /// Returns the SIMD level for preferred velocities, if they can use SIMD.
    pub(crate) fn lanes_to_intend(&self) -> Option<Level> {
        self.instructions.level().filter(|_| !self.in_space_now())
    }
}
