//! 3b. Agents of streams that meet squeeze past each other where it is too dense to avoid each other.
//!
//! A local model of velocity obstacles leaves two agents that touch no velocity towards each other. Where many come from both
//! sides, each is held by several, and all stand. People turn their shoulders, touch and slide past.

use super::World;
use super::way::SAME_WAY;
use crate::agent::Group;
use crate::avoid::Others;
use crate::lanes::{Vec2s, load_pairs};
use fearless_simd::prelude::*;

/// Closing speed below which the bodies of two agents may touch, m/s: each shuffles.
const SHUFFLE: f32 = 0.6;

impl World {
    /// Whether an agent leaves it to the guard to keep it off another: the two come the other way to each other, and close
    /// slowly.
    #[inline]
    pub(super) fn squeezes_past(&self, row: usize, other: usize) -> bool {
        let (agents, shown) = (&self.agents, &self.step.shown);
        if !shown[row].way.is_opposite(&shown[other].way) {
            return false;
        }
        let offset = agents.position[other] - agents.position[row];
        let closing = (agents.velocity[row] - agents.velocity[other]).dot(offset);
        closing < SHUFFLE * offset.length() && self.both_squeeze(row, other)
    }

    /// Whether the groups of two agents squeeze past others, and the other avoids the first.
    pub(super) fn both_squeeze(&self, row: usize, other: usize) -> bool {
        let squeezes = |row: usize| self.groups[self.agents.group[row].index()].squeezes();
        squeezes(row) && squeezes(other) && self.agents.avoids(other, row)
    }
}

/// In which lanes two agents come the other way to each other, and close slowly; the first's position and velocity, and where
/// it wants to go. The same bits as [`World::squeezes_past`].
#[inline(always)]
pub(super) fn may_squeeze<S: Simd>(
    simd: S,
    [position, velocity]: [Vec2s<S>; 2],
    way: Vec2s<S>,
    others: &Others,
) -> S::mask32s {
    let splat = |value: f32| S::f32s::splat(simd, value);
    let opposite = Vec2s::load(simd, &others.way).dot(way).simd_lt(splat(-SAME_WAY));
    let [there, theirs] = load_pairs(simd, &others.motion);
    let offset: Vec2s<S> = there - position;
    let closing = (velocity - theirs).dot(offset);
    opposite & closing.simd_lt(splat(SHUFFLE) * offset.dot(offset).sqrt())
}

impl Group {
    /// Whether its agents squeeze past others: they look ahead, which keeps them apart while there is room, and the guard keeps
    /// their bodies apart.
    pub(super) fn squeezes(&self) -> bool {
        self.guard && self.walks_by_looking_ahead() && !self.model.parts_bodies() && !self.model.looks_in_space()
    }
}
