//! Agents of streams that meet squeeze past each other where it is too dense to avoid each other.
//!
//! A velocity-obstacle model permits two agents that touch no velocity towards each other. Where many agents come from
//! both sides, several neighbours block each agent, and all stand. People turn their shoulders, touch and slide past.

use super::SimdNeighbour;
use crate::agent::Group;
use crate::navigate::{SAME_WAY, Surroundings};
use crate::simd::{Vec2s, load_pairs};
use crate::world::State;
use fearless_simd::prelude::*;

/// Closing speed below which the bodies of two agents may touch, m/s: both shuffle.
const SHUFFLE: f32 = 0.6;

impl Surroundings<'_> {
    /// Whether an agent leaves the separation from another agent to the guard: the two go opposite ways and close
    /// slowly.
    #[inline]
    pub fn squeezes_past(&self, row: usize, other: usize) -> bool {
        let (agents, shown) = (&self.state.agents, self.shown);
        if !shown[row].way.is_opposite(&shown[other].way) {
            return false;
        }
        let offset = agents.position[other] - agents.position[row];
        let closing = (agents.velocity[row] - agents.velocity[other]).dot(offset);
        closing < SHUFFLE * offset.length() && self.state.both_squeeze(row, other)
    }
}

impl State {
    /// Whether the groups of both agents squeeze past others, and the other agent avoids the first.
    pub(crate) fn both_squeeze(&self, row: usize, other: usize) -> bool {
        let squeezes = |row: usize| self.local_groups[self.agents.group[row].index()].squeezes();
        squeezes(row) && squeezes(other) && self.agents.avoids(other, row)
    }
}

/// Returns the elements in which two agents go opposite ways and close slowly, given the position, velocity and path
/// direction of the first. The bits are the same as those of [`Surroundings::squeezes_past`].
#[inline(always)]
pub(super) fn may_squeeze<S: Simd>(
    simd: S,
    [position, velocity]: [Vec2s<S>; 2],
    way: Vec2s<S>,
    others: &SimdNeighbour,
) -> S::mask32s {
    let splat = |value: f32| S::f32s::splat(simd, value);
    let opposite = Vec2s::load(simd, &others.way).dot(way).simd_lt(splat(-SAME_WAY));
    let [there, theirs] = load_pairs(simd, &others.motion);
    let offset: Vec2s<S> = there - position;
    let closing = (velocity - theirs).dot(offset);
    opposite & closing.simd_lt(splat(SHUFFLE) * offset.dot(offset).sqrt())
}

impl Group {
    /// Whether its agents squeeze past others: looking ahead keeps them apart while there is space, and the guard keeps
    /// their bodies apart.
    pub(super) fn squeezes(&self) -> bool {
        self.guard && self.walks_by_looking_ahead() && !self.model.parts_bodies() && !self.model.looks_in_space()
    }
}
