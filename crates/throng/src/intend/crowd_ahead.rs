//! The neighbours that an agent takes into account when it looks ahead, with SIMD: one neighbour in each element.

use crate::navigate::{NavFlags, SAME_WAY};
use crate::simd::{LANES, Vec2s, get, load_from, ones, set};
use crate::space::times_to_discs;
use fearless_simd::prelude::*;
use glam::Vec2;

/// Speed below which an agent stands, m/s. A standing agent is in the way, whatever its direction.
const STANDS: f32 = 0.1;
/// Gap from which on the full personal space is kept, metres. At smaller gaps two agents keep proportionally less.
const ROOMY: f32 = 1.5;
/// Exponent of the part of the shoulders that does not overlap, where streams meet. Elsewhere it is 2.
const STEPS_ASIDE: f32 = 0.55;

/// The properties of an agent that decide how it takes neighbours into account.
#[derive(Clone, Copy)]
pub(super) struct Viewpoint {
    /// The direction in which it walks.
    pub way: Vec2,
    /// Whether it makes progress. If not, all neighbours ahead count for the choice of direction.
    pub gets_on: bool,
    /// Space that it keeps from an agent that it passes, metres.
    pub personal_space: f32,
    /// Least lateral distance within which a neighbour in the same direction is ahead, metres.
    pub shoulders: f32,
}

/// A neighbour ahead that does not go the same way.
#[derive(Clone, Copy, Debug)]
pub(super) struct MetNeighbour {
    pub row: usize,
    pub offset: Vec2,
    pub velocity: Vec2,
    /// Sum of the radii.
    pub radii: f32,
    /// Space that each of the two agents keeps from the other.
    pub space: f32,
    /// Whether it comes the opposite way.
    pub is_opposite: bool,
}

/// The neighbours of an agent, sorted by where they go.
#[derive(Clone, Debug, Default)]
pub(super) struct CrowdAhead {
    len: usize,
    row: [u32; LANES],
    offset: [[f32; LANES]; 2],
    velocity: [[f32; LANES]; 2],
    /// Directions in which they walk; zero for a neighbour that does not walk.
    direction: [[f32; LANES]; 2],
    /// Sums of the radii, with the margin of the local models.
    radii: [f32; LANES],
    /// Neighbours that walk, one bit each.
    walk: u64,
    /// Neighbours from which the agent keeps no space where they stay, one bit each.
    close: u64,

    space: [f32; LANES],
    /// Sums of the radii, plus the space that the agent keeps from a neighbour that stays where it is.
    wanted: [f32; LANES],
    /// Lateral distances within which neighbours are ahead: the breadth of shoulders.
    breadth: [f32; LANES],
    /// Neighbours that count for the choice of direction.
    counts: u64,
    /// Neighbours ahead that do not go the same way, and the subset that comes the opposite way.
    meet: u64,
    opposite: u64,
}

impl CrowdAhead {
    /// Removes the neighbours of the previous agent.
    pub fn clear(&mut self) {
        (self.len, self.walk, self.close) = (0, 0, 0);
    }

    /// Whether it holds as many neighbours as an agent takes into account.
    pub fn is_full(&self) -> bool {
        self.len == LANES
    }

    /// Adds the neighbour of a row. The list must not be full. `radii` is the sum of the radii with the margin of the
    /// local models. The agent keeps no space from a neighbour that is `close` where it stays.
    #[inline(always)]
    pub fn push(&mut self, row: usize, (offset, velocity): (Vec2, Vec2), way: &NavFlags, radii: f32, close: bool) {
        let at = self.len;
        self.len += 1;
        self.row[at] = row as u32;
        set(&mut self.offset, at, offset);
        set(&mut self.velocity, at, velocity);
        set(&mut self.direction, at, way.direction);
        self.radii[at] = radii;
        self.walk |= u64::from(way.walks()) << at;
        self.close |= u64::from(close) << at;
    }

    /// Sorts the neighbours by where they go.
    #[inline(always)]
    pub fn sort<S: Simd>(&mut self, simd: S, eye: &Viewpoint) {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let (zero, one) = (splat(0.0), splat(1.0));
        let way = Vec2s::<S>::splat(simd, eye.way);
        (self.counts, self.meet, self.opposite) = (0, 0, 0);
        for from in (0..self.len).step_by(S::f32s::LEN) {
            let mask = |bits: u64| S::mask32s::from_bitmask(simd, bits >> from);
            let there = mask((1 << self.len) - 1);
            let offset = Vec2s::<S>::load_from(simd, &self.offset, from);
            let velocity = Vec2s::<S>::load_from(simd, &self.velocity, from);
            let radii = load_from(simd, &self.radii, from);
            // the smaller the gap, the less space is kept
            let gap = (offset.dot(offset).sqrt() - radii).max(zero);
            let space = splat(eye.personal_space) * (gap / splat(ROOMY)).min(one);
            let same = Vec2s::load_from(simd, &self.direction, from).dot(way);
            let stands = velocity.dot(velocity).simd_lt(splat(STANDS * STANDS)) | !mask(self.walk);
            let along = same.simd_gt(splat(SAME_WAY)) | stands;
            let ahead = offset.dot(way).simd_gt(zero);
            let counts = if eye.gets_on { along } else { along | ahead };
            let meet = there & ahead & !along;
            space.store_slice(&mut self.space[from..from + S::f32s::LEN]);
            let wanted = mask(self.close).select(radii, radii + space);
            wanted.store_slice(&mut self.wanted[from..from + S::f32s::LEN]);
            let breadth = along.select(radii.max(splat(eye.shoulders)), radii);
            breadth.store_slice(&mut self.breadth[from..from + S::f32s::LEN]);
            self.counts |= (there & counts).to_bitmask() << from;
            self.meet |= meet.to_bitmask() << from;
            self.opposite |= (meet & same.simd_lt(splat(-SAME_WAY))).to_bitmask() << from;
        }
    }

    /// Returns the neighbours ahead that do not go the same way.
    pub fn met(&self) -> impl Iterator<Item = MetNeighbour> {
        ones(self.meet).map(|index| MetNeighbour {
            row: self.row[index] as usize,
            offset: get(&self.offset, index),
            velocity: get(&self.velocity, index),
            radii: self.radii[index],
            space: self.space[index],
            is_opposite: self.opposite >> index & 1 != 0,
        })
    }

    /// Excludes hidden neighbours from the choice of direction. Returns whether any was excluded.
    pub fn forget(&mut self, mut hidden: impl FnMut(Vec2) -> bool) -> bool {
        let before = self.counts;
        for index in ones(before).filter(|&index| hidden(get(&self.offset, index))) {
            self.counts &= !(1 << index);
        }
        self.counts != before
    }

    /// Returns the seconds until an agent with this velocity meets a neighbour that counts, at most `most`.
    #[inline(always)]
    pub fn time<S: Simd>(&self, simd: S, velocity: Vec2, most: f32) -> f32 {
        let most = S::f32s::splat(simd, most);
        let velocity = Vec2s::<S>::splat(simd, velocity);
        let mut least = most;
        for from in (0..self.len).step_by(S::f32s::LEN) {
            let relative = velocity - Vec2s::load_from(simd, &self.velocity, from);
            let offset = Vec2s::load_from(simd, &self.offset, from);
            let time = times_to_discs(simd, offset, relative, load_from(simd, &self.wanted, from));
            least = least.min(S::mask32s::from_bitmask(simd, self.counts >> from).select(time, most));
        }
        least.reduce_min_precise()
    }

    /// Returns the speed that the gaps ahead permit an agent that walks in `direction`, at most `most`.
    ///
    /// The time gap counts in proportion to the lateral overlap of the shoulders of the two agents: almost fully until
    /// they hardly overlap. Where streams meet it counts only if they overlap almost fully, because agents there step
    /// aside all the time.
    #[inline(always)]
    pub fn gap_speed<S: Simd>(
        &self,
        simd: S,
        direction: Vec2,
        (time_gap, most): (f32, f32),
        streams_meet: bool,
    ) -> f32 {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let (zero, one) = (splat(0.0), splat(1.0));
        let direction = Vec2s::<S>::splat(simd, direction);
        let mut least = splat(most);
        for from in (0..self.len).step_by(S::f32s::LEN) {
            let offset = Vec2s::load_from(simd, &self.offset, from);
            let breadth = load_from(simd, &self.breadth, from);
            let along = offset.dot(direction);
            let aside = offset.perp_dot(direction).abs();
            let same_way = Vec2s::load_from(simd, &self.direction, from).dot(direction).simd_ge(splat(SAME_WAY));
            let ahead = same_way
                & along.simd_gt(zero)
                & aside.simd_lt(breadth)
                & S::mask32s::from_bitmask(simd, self.counts >> from);
            let radii = load_from(simd, &self.radii, from);
            let gap = (along - (radii * radii - aside * aside).max(zero).sqrt()).max(zero);
            let hinders = ahead & gap.simd_lt(splat(most * time_gap));
            if !hinders.any_true() {
                continue;
            }
            let apart = aside / breadth;
            if streams_meet {
                let mut slowest = least.reduce_min_precise();
                let mut left = hinders.to_bitmask();
                while left != 0 {
                    // the nearest first: a neighbour permits at least its gap over the time gap
                    let nearest = ones(left).min_by(|&a, &b| gap[a].total_cmp(&gap[b])).expect("one is left");
                    left &= !(1 << nearest);
                    if gap[nearest] / time_gap >= slowest {
                        break;
                    }
                    let apart = libm::powf(apart[nearest], STEPS_ASIDE);
                    slowest = slowest.min(gap[nearest] / (time_gap * (1.0 - apart)));
                }
                least = splat(slowest);
            } else {
                let speed = gap / (splat(time_gap) * (one - apart * apart));
                least = hinders.select(speed.min(least), least);
            }
        }
        least.reduce_min_precise()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::GoalId;
    use crate::perceive::SimdLevel;
    use crate::space::time_to_disc;
    use fearless_simd::dispatch;
    use proptest::prelude::*;

    /// A neighbour: offset, velocity, the angle of the direction in which it walks, sum of the radii, whether it is
    /// close.
    type One = (Vec2, Vec2, Option<f32>, f32, bool);

    fn one() -> impl Strategy<Value = One> {
        let vector = |most: f32| (-most..most, -most..most).prop_map(Vec2::from);
        (vector(4.0), vector(1.5), prop::option::of(-3.2f32..3.2), 0.2f32..1.0, any::<bool>())
    }

    fn way(walks: Option<f32>) -> NavFlags {
        walks.map_or(NavFlags::at_rest(None, 0.0), |angle| {
            NavFlags::walking(Some(GoalId(0)), Vec2::from_angle(angle), 9.0)
        })
    }

    /// Returns the seconds until the agent meets a neighbour that counts, and the speed that its gap permits, as
    /// docs/look-ahead.md defines them.
    fn expected(
        eye: &Viewpoint,
        direction: Vec2,
        streams_meet: bool,
        &(offset, velocity, walks, radii, close): &One,
    ) -> (f32, f32) {
        let theirs = way(walks).direction;
        let along = walks.is_none() || theirs.dot(eye.way) > SAME_WAY || velocity.length() < STANDS;
        if !along && (eye.gets_on || offset.dot(eye.way) <= 0.0) {
            return (f32::INFINITY, f32::INFINITY);
        }
        let gap = (offset.length() - radii).max(0.0);
        let space = if close { 0.0 } else { eye.personal_space * (gap / ROOMY).min(1.0) };
        let time = time_to_disc(offset, direction * 1.3 - velocity, radii + space);
        let breadth = if along { radii.max(eye.shoulders) } else { radii };
        let (ahead, aside) = (offset.dot(direction), offset.perp_dot(direction).abs());
        if theirs.dot(direction) < SAME_WAY || ahead <= 0.0 || aside >= breadth {
            return (time, f32::INFINITY);
        }
        let contact = (radii * radii - aside * aside).max(0.0).sqrt();
        let overlap = 1.0 - (aside / breadth).powf(if streams_meet { STEPS_ASIDE } else { 2.0 });
        (time, (ahead - contact).max(0.0) / (1.15 * overlap))
    }

    proptest! {
        #[test]
        fn the_crowd_leaves_what_each_neighbour_leaves(
            all in prop::collection::vec(one(), 1..=LANES),
            (angle, gets_on, streams_meet) in (-2.0f32..2.0, any::<bool>(), any::<bool>()),
        ) {
            let eye = Viewpoint { way: Vec2::X, gets_on, personal_space: 0.4, shoulders: 0.415 };
            let direction = Vec2::from_angle(angle);
            let least = all.iter().map(|one| expected(&eye, direction, streams_meet, one));
            let least = least.fold((4.0f32, 1.3f32), |a, b| (a.0.min(b.0), a.1.min(b.1)));
            for level in SimdLevel::ALL.into_iter().filter_map(SimdLevel::level) {
                let mut crowd = CrowdAhead::default();
                for (row, &(offset, velocity, walks, radii, close)) in all.iter().enumerate() {
                    crowd.push(row, (offset, velocity), &way(walks), radii, close);
                }
                let found = dispatch!(level, simd => {
                    crowd.sort(simd, &eye);
                    (crowd.time(simd, direction * 1.3, 4.0), crowd.gap_speed(simd, direction, (1.15, 1.3), streams_meet))
                });
                let near = |a: f32, b: f32| a == b || (a - b).abs() <= 1e-4 * (1.0 + b.abs());
                prop_assert!(near(found.0, least.0) && near(found.1, least.1), "{level:?}: {found:?} {least:?}");
            }
        }
    }
}
