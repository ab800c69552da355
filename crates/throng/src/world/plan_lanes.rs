//! Many look at once where they are on their ways, a lane an agent: those who walk straight to a point on the ground, and
//! those who steer and have no way. The same bits as [one by one](super::plan), where everybody else looks.

use super::World;
use super::way::{MAY_CHANGE, Shown, Way};
use crate::agent::Status;
use crate::lanes::{LANES, Vec2s, load, ones, set};
use crate::navigate::Travel;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::Vec2;
use std::ops::Range;

/// Who of a vector does not go with the others, as bits, and whether the status of any other may change.
struct Looked {
    left: u64,
    may_change: bool,
}

impl World {
    /// Brings the ways of a range of rows up to date and notes them for others to see. Calls `left` for those that go
    /// one by one; tells whether the status of any other may change.
    pub(super) fn look_many(
        &self,
        level: Level,
        rows: Range<usize>,
        travels: &mut [Travel],
        shown: &mut [Shown],
        seconds: f32,
        left: impl FnMut(usize, &mut Travel) -> Way,
    ) -> bool {
        dispatch!(level, simd => self.look_at_all(simd, rows, travels, shown, seconds, left))
    }

    #[inline(always)]
    fn look_at_all<S: Simd>(
        &self,
        simd: S,
        rows: Range<usize>,
        travels: &mut [Travel],
        shown: &mut [Shown],
        seconds: f32,
        mut left: impl FnMut(usize, &mut Travel) -> Way,
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
                shown[lane] = Shown::new(self.agents.position[row], self.agents.velocity[row], way);
            }
        }
        may_change
    }

    /// Those of a vector, from a row on.
    #[inline(always)]
    fn look_at<S: Simd>(
        &self,
        simd: S,
        start: usize,
        travels: &mut [Travel],
        shown: &mut [Shown],
        seconds: f32,
    ) -> Looked {
        let agents = &self.agents;
        let rows = start..start + travels.len();
        let (mut towards, mut tolerance, mut keys) = ([[0.0; LANES]; 2], [0.0; LANES], [0; LANES]);
        let (mut left, mut goes_nowhere) = (0, 0);
        for ((lane, row), travel) in rows.clone().enumerate().zip(&*travels) {
            let leg = self.legs.of(agents.journey[row], travel.leg);
            match leg.and_then(|leg| Some((leg, leg.tolerance?))) {
                Some((leg, near))
                    if leg.altitude.is_none() && travel.is_plain() && agents.status[row] == Status::Walking =>
                {
                    set(&mut towards, lane, (leg.middle - self.world_position(row)).as_vec2());
                    tolerance[lane] = near;
                    let taken = self.step.anybody_arrived && self.step.arrivals[leg.goal.index()] > 0;
                    let way =
                        Way::walking(Some(leg.goal), Vec2::ZERO, 0.0).stopping(leg.is_last).changing(taken).plain(true);
                    keys[lane] = way.key();
                }
                None if leg.is_none() && agents.status[row] == Status::Walking => {
                    // who steers needs no way
                    set(&mut towards, lane, agents.velocity[row]);
                    keys[lane] = Way::walking(None, Vec2::ZERO, 0.0).key();
                    goes_nowhere |= 1 << lane;
                }
                _ => left |= 1 << lane,
            }
        }
        if left == (1 << rows.len()) - 1 {
            return Looked { left, may_change: false };
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
            let way = Way::with_key(key, Vec2::new(direction.x[lane], direction.y[lane]), remaining[lane]);
            all_keys |= key;
            let row = start + lane;
            shown[lane] = Shown::new(agents.position[row], agents.velocity[row], way);
        }
        Looked { left, may_change: all_keys & MAY_CHANGE != 0 }
    }
}
