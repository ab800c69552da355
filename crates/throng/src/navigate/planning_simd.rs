//! Position on the path with SIMD, one agent in each element: agents that walk straight to a point on the ground, and
//! steered agents without a path. The bits are the same as those of the [scalar path](super::planning), which handles all
//! other agents.

use super::RouteProgress;
use super::neighbour_data::{MAY_CHANGE, NavFlags, NeighbourData};
use super::planning::Planning;
use crate::agent::Status;
use crate::simd::{LANES, Vec2s, load, ones, set};
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::Vec2;
use std::ops::Range;

/// The rows of a SIMD vector that the kernel cannot handle, one bit each, and whether the status of any other row may
/// change.
struct ExcludedLanes {
    left: u64,
    may_change: bool,
}

impl Planning<'_> {
    /// Updates the paths of a range of rows and publishes them for their neighbours. Calls `left` for rows that the
    /// SIMD kernel cannot handle. Returns whether the status of any other row may change.
    pub fn look_many(
        &self,
        level: Level,
        rows: Range<usize>,
        travels: &mut [RouteProgress],
        shown: &mut [NeighbourData],
        seconds: f32,
        left: impl FnMut(usize, &mut RouteProgress) -> NavFlags,
    ) -> bool {
        dispatch!(level, simd => self.look_simd(simd, rows, travels, shown, seconds, left))
    }

    #[inline(always)]
    fn look_simd<S: Simd>(
        &self,
        simd: S,
        rows: Range<usize>,
        travels: &mut [RouteProgress],
        shown: &mut [NeighbourData],
        seconds: f32,
        mut left: impl FnMut(usize, &mut RouteProgress) -> NavFlags,
    ) -> bool {
        let mut may_change = false;
        let lanes = S::f32s::LEN;
        let parts = travels.chunks_mut(lanes).zip(shown.chunks_mut(lanes));
        for (start, (travels, shown)) in rows.step_by(lanes).zip(parts) {
            let looked = self.look_at(simd, start, travels, shown, seconds);
            may_change |= looked.may_change;
            for lane in ones(looked.left) {
                let row = start + lane;
                let way = left(row, &mut travels[lane]);
                shown[lane] = NeighbourData::new(self.state.agents.position[row], self.state.agents.velocity[row], way);
            }
        }
        may_change
    }

    /// Updates the paths of a SIMD vector of rows, starting at `start`.
    #[inline(always)]
    fn look_at<S: Simd>(
        &self,
        simd: S,
        start: usize,
        travels: &mut [RouteProgress],
        shown: &mut [NeighbourData],
        seconds: f32,
    ) -> ExcludedLanes {
        let agents = &self.state.agents;
        let rows = start..start + travels.len();
        let (mut towards, mut tolerance, mut keys) = ([[0.0; LANES]; 2], [0.0; LANES], [0; LANES]);
        let (mut left, mut goes_nowhere) = (0, 0);
        for ((lane, row), travel) in rows.clone().enumerate().zip(&*travels) {
            let leg = self.state.legs.of(agents.journey[row], travel.leg);
            match leg.and_then(|leg| Some((leg, leg.tolerance?))) {
                Some((leg, near))
                    if leg.altitude.is_none() && travel.is_plain() && agents.status[row] == Status::Walking =>
                {
                    set(&mut towards, lane, (leg.middle - self.state.world_position(row)).as_vec2());
                    tolerance[lane] = near;
                    let taken = self.arrivals.any() && self.arrivals.at(leg.goal) > 0;
                    let way = NavFlags::walking(Some(leg.goal), Vec2::ZERO, 0.0)
                        .stopping(leg.is_last)
                        .changing(taken)
                        .plain(true);
                    keys[lane] = way.key();
                }
                None if leg.is_none() && agents.status[row] == Status::Walking => {
                    // a steered agent needs no path
                    set(&mut towards, lane, agents.velocity[row]);
                    keys[lane] = NavFlags::walking(None, Vec2::ZERO, 0.0).key();
                    goes_nowhere |= 1 << lane;
                }
                _ => left |= 1 << lane,
            }
        }
        if left == (1 << rows.len()) - 1 {
            return ExcludedLanes { left, may_change: false };
        }
        let splat = |value: f32| S::f32s::splat(simd, value);
        let towards: Vec2s<S> = Vec2s::load(simd, &towards);
        let nowhere = S::mask32s::from_bitmask(simd, goes_nowhere);
        let remaining = nowhere.select(splat(0.0), towards.dot(towards).sqrt());
        let direction = towards.normalize_or_zero(simd);
        let gets = agents.max_speed.lanes(simd, rows.clone()) * splat(seconds) * splat(1.01);
        let far = (remaining * splat(0.9999)).simd_gt(load(simd, &tolerance) + gets).to_bitmask() | goes_nowhere;
        let mut all_keys = 0;
        for lane in ones(!left & ((1 << rows.len()) - 1)) {
            let key = keys[lane] | if far >> lane & 1 == 0 { MAY_CHANGE } else { 0 };
            let way = NavFlags::with_key(key, Vec2::new(direction.x[lane], direction.y[lane]), remaining[lane]);
            all_keys |= key;
            let row = start + lane;
            shown[lane] = NeighbourData::new(agents.position[row], agents.velocity[row], way);
        }
        ExcludedLanes { left, may_change: all_keys & MAY_CHANGE != 0 }
    }
}
