//! The birds of a flock, many at once, a lane a bird: the same bits as [one by one](super::flocking).
//!
//! Birds that lie side by side in the lattice share their surroundings. A *tile* is as many of them as a vector has lanes;
//! what lies near it is packed, and every lane looks at each of it, by ascending places, and adds up what belongs to its
//! neighbourhoods.

use super::flocking::Flocking;
use super::neighbourhood::Sight;
use crate::lanes::{LANES, Vec3s, get3, ones};
use crate::motion::{Locomotion, Vehicle};
use crate::perceive::Lattice;
use crate::steer::Who;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::Vec3;
use std::ops::Range;

/// Birds that a pack holds at most before lanes look at them.
const MOST: usize = 256;
/// How long a tile may be, over the height of cells.
const LONG: f32 = 4.0;

/// Somebody as a flock sees them: where they are, which way they face, and the index of their group.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Bird {
    pub position: Vec3,
    pub forward: Vec3,
    pub group: u32,
    pub radius: f32,
}

/// Everybody as flocks see them, by place.
#[derive(Clone, Debug, Default)]
pub(crate) struct Birds {
    pub all: Vec<Bird>,
    /// Which way they face, once more, a column a component; beyond the end, whole vectors.
    pub forward: [Vec<f32>; 3],
    /// Radius of everybody, if it is the same.
    pub radius: Option<f32>,
}

/// What a thread keeps from tile to tile.
#[derive(Clone, Debug)]
pub(crate) struct Pack {
    places: [u32; MOST],
    /// Where to find what may be near the tile.
    runs: Vec<Range<usize>>,
    /// Places of two who are close.
    close: Vec<(u32, u32)>,
}

impl Default for Pack {
    fn default() -> Self {
        Self { places: [0; MOST], runs: Vec::new(), close: Vec::new() }
    }
}

impl Pack {
    /// Notes the places of two who are close.
    pub fn note_close(&mut self, place: usize, other: usize) {
        self.close.push((place as u32, other as u32));
    }

    /// Places of two who are close, found since this was asked last.
    pub fn take_close(&mut self) -> std::vec::Drain<'_, (u32, u32)> {
        self.close.drain(..)
    }
}

/// A flock, and everybody there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flock<'a> {
    pub flocking: &'a Flocking,
    pub vehicle: &'a Vehicle,
    /// Index of its group.
    pub group: u32,
    /// How far it looks, metres.
    pub range: f32,
    /// Within what distance two are close, metres, at most `range`.
    pub close: f32,
    pub lattice: &'a Lattice,
    pub birds: &'a Birds,
}

impl Flock<'_> {
    /// Whether its birds take somebody into account.
    #[inline(always)]
    fn counts(&self, other: &Bird) -> bool {
        match self.flocking.who {
            Who::Anybody => true,
            Who::OwnGroup => other.group == self.group,
            Who::OtherGroups => other.group != self.group,
            Who::Group(index) => other.group as usize == index,
        }
    }

    /// The forces that its birds are steered by in a range of places, one a place; those of others stay. Calls `left` for
    /// those that share their place with another.
    pub fn forces(
        &self,
        level: Level,
        places: Range<usize>,
        pack: &mut Pack,
        out: &mut [Vec3],
        left: impl FnMut(usize) -> Vec3,
    ) {
        dispatch!(level, simd => forces(simd, self, places, pack, out, left));
    }
}

#[inline(always)]
fn forces<S: Simd>(
    simd: S,
    flock: &Flock<'_>,
    places: Range<usize>,
    pack: &mut Pack,
    out: &mut [Vec3],
    mut left: impl FnMut(usize) -> Vec3,
) {
    let [x, ..] = flock.lattice.coordinates();
    let longest = LONG * flock.lattice.height();
    let sights = flock.flocking.near().map(|near| near.sight(0.0));
    let mut start = places.start;
    while start < places.end {
        let most = (start + S::f32s::LEN).min(places.end).min(flock.lattice.end_of_row(start));
        // all of a row lie by their x
        let from = S::f32s::from_slice(simd, &x[start..start + S::f32s::LEN]);
        let side_by_side = (from - S::f32s::splat(simd, x[start])).simd_le(S::f32s::splat(simd, longest));
        let end = most.min(start + side_by_side.to_bitmask().trailing_ones() as usize);
        let own = &flock.birds.all[start..end];
        let belongs = |lanes: u64, bird: &Bird| lanes << 1 | u64::from(bird.group == flock.group);
        let lanes = own.iter().rev().fold(0, belongs);
        if lanes != 0 {
            let mut forces = [[0.0; LANES]; 3];
            let tile = Tile::new(simd, flock, sights, start, own);
            let unclear = tile.forces(pack, &mut forces);
            for lane in ones(lanes) {
                out[start - places.start + lane] =
                    if unclear >> lane & 1 != 0 { left(start + lane) } else { get3(&forces, lane) };
            }
        }
        start = end;
    }
}

/// Birds side by side, and the box round them.
struct Tile<'a, S: Simd> {
    simd: S,
    flock: &'a Flock<'a>,
    start: usize,
    count: usize,
    position: Vec3s<S>,
    forward: Vec3s<S>,
    always_squared: S::f32s,
    low: Vec3,
    high: Vec3,
    sights: [Sight; 3],
    reach_squared: f32,
}

/// What one of the rules adds up.
#[derive(Clone, Copy)]
struct Sum<S: Simd> {
    sum: Vec3s<S>,
    count: S::f32s,
}

impl<'a, S: Simd> Tile<'a, S> {
    #[inline(always)]
    fn new(simd: S, flock: &'a Flock<'a>, sights: [Sight; 3], start: usize, own: &[Bird]) -> Self {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let column = |all: &[f32]| S::f32s::from_slice(simd, &all[start..start + S::f32s::LEN]);
        let [x, y, z] = flock.lattice.coordinates();
        let position = Vec3s { x: column(x), y: column(y), z: column(z) };
        let [x, y, z] = &flock.birds.forward;
        let forward = Vec3s { x: column(x), y: column(y), z: column(z) };
        // lanes that are left do not make the box larger
        let lane = S::u32s::from_fn(simd, |lane| lane as u32);
        let used = lane.simd_lt(S::u32s::splat(simd, own.len() as u32));
        let inside = Vec3s::select(used, position, Vec3s::splat(simd, own[0].position));
        let low = Vec3::new(inside.x.reduce_min(), inside.y.reduce_min(), inside.z.reduce_min());
        let high = Vec3::new(inside.x.reduce_max(), inside.y.reduce_max(), inside.z.reduce_max());
        let radius = flock
            .birds
            .radius
            .map_or_else(|| S::f32s::from_fn(simd, |lane| own.get(lane).map_or(0.0, |bird| bird.radius)), splat);
        let always = splat(flock.flocking.always) * radius;
        let always_squared = always * always;
        let farthest = sights.iter().fold(0.0, |farthest: f32, sight| farthest.max(sight.range_squared));
        let farthest = farthest.max(always_squared.reduce_max()).min(flock.range * flock.range);
        let reach_squared = farthest.max(flock.close * flock.close);
        Self {
            simd,
            flock,
            start,
            count: own.len(),
            position,
            forward,
            always_squared,
            low,
            high,
            sights,
            reach_squared,
        }
    }

    /// The forces of all lanes, and which of them have somebody in exactly their place.
    #[inline(always)]
    fn forces(&self, pack: &mut Pack, out: &mut [[f32; LANES]; 3]) -> u64 {
        let simd = self.simd;
        let zero = S::f32s::splat(simd, 0.0);
        let none = Sum { sum: Vec3s { x: zero, y: zero, z: zero }, count: zero };
        let mut sums = [none; 3];
        let mut unclear = 0;
        let mut count = 0;
        let [x, y, z] = self.flock.lattice.coordinates();
        let (left, right) = (S::f32s::splat(simd, self.low.x), S::f32s::splat(simd, self.high.x));
        let (front, back) = (S::f32s::splat(simd, self.low.y), S::f32s::splat(simd, self.high.y));
        let (bottom, top) = (S::f32s::splat(simd, self.low.z), S::f32s::splat(simd, self.high.z));
        let limit = S::f32s::splat(simd, self.reach_squared);
        let lane = S::u32s::from_fn(simd, |lane| lane as u32);
        let Pack { places, runs, close } = pack;
        runs.clear();
        self.flock.lattice.runs_near(self.low, self.high, self.reach_squared.sqrt(), |run| runs.push(run));
        for run in &*runs {
            for at in run.clone().step_by(S::f32s::LEN) {
                let range = at..at + S::f32s::LEN;
                let x = S::f32s::from_slice(simd, &x[range.clone()]);
                let y = S::f32s::from_slice(simd, &y[range.clone()]);
                let z = S::f32s::from_slice(simd, &z[range]);
                let dx = (left - x).max(x - right).max(zero);
                let dy = (front - y).max(y - back).max(zero);
                let dz = (bottom - z).max(z - top).max(zero);
                let near = (dx * dx + dy * dy + dz * dz).simd_le(limit);
                let within = near & lane.simd_lt(S::u32s::splat(simd, (run.end - at) as u32));
                let all = lane + S::u32s::splat(simd, at as u32);
                all.compress(within).store_slice(&mut places[count..count + S::f32s::LEN]);
                count += within.to_bitmask().count_ones() as usize;
                if count > MOST - S::f32s::LEN {
                    unclear |= self.look(&places[..count], &mut sums, close);
                    count = 0;
                }
            }
        }
        unclear |= self.look(&places[..count], &mut sums, close);
        self.force(&sums).store(out);
        unclear
    }

    /// Lets all lanes look at packed places; tells which of them have somebody in exactly their place.
    #[inline(always)]
    fn look(&self, places: &[u32], sums: &mut [Sum<S>; 3], close: &mut Vec<(u32, u32)>) -> u64 {
        let Self { simd, flock, forward, sights, .. } = self;
        let simd = *simd;
        let splat = |value: f32| S::f32s::splat(simd, value);
        let one = splat(1.0);
        let close_squared = splat(flock.close * flock.close);
        let [apart, along, together] = *sights;
        // sums are kept in registers: nothing is called from here on
        let [mut separation, mut alignment, mut cohesion] = *sums;
        // nobody could foretell who is: first those are sorted out, without a branch
        let (mut all_near, mut count) = ([0; MOST], 0);
        for &place in places {
            all_near[count] = place;
            count += usize::from(self.near(place).0.any_true());
        }
        let all_near = &all_near[..count];
        let (mut any_close, mut count) = ([0; MOST], 0);
        for &place in all_near {
            let bird = &flock.birds.all[place as usize];
            let (near, offset, distance_squared) = self.near(place);
            any_close[count] = place;
            count += usize::from((near & distance_squared.simd_le(close_squared)).any_true());
            if !flock.counts(bird) {
                continue;
            }
            let ahead = forward.dot(offset);
            let ahead = ahead * ahead.abs();
            let always = near & distance_squared.simd_lt(self.always_squared);
            let in_sight = distance_squared.simd_le(splat(apart.range_squared))
                & ahead.simd_ge(splat(apart.cosine) * distance_squared);
            let belongs = always | (near & in_sight);
            separation.add(belongs, offset * (splat(-1.0) / distance_squared), one);
            let in_sight = distance_squared.simd_le(splat(along.range_squared))
                & ahead.simd_ge(splat(along.cosine) * distance_squared);
            alignment.add(always | (near & in_sight), Vec3s::splat(simd, bird.forward), one);
            let in_sight = distance_squared.simd_le(splat(together.range_squared))
                & ahead.simd_ge(splat(together.cosine) * distance_squared);
            cohesion.add(always | (near & in_sight), offset, one);
        }
        *sums = [separation, alignment, cohesion];
        if count > 0 { self.note_close(&any_close[..count], close) } else { 0 }
    }

    /// Which lanes somebody is near to, its offsets, and the squares of their lengths.
    #[inline(always)]
    fn near(&self, place: u32) -> (S::mask32s, Vec3s<S>, S::f32s) {
        let simd = self.simd;
        let offset = Vec3s::splat(simd, self.flock.birds.all[place as usize].position) - self.position;
        let distance_squared = offset.dot(offset);
        let own = S::u32s::from_fn(simd, |lane| (self.start + lane) as u32);
        let another = !own.simd_eq(S::u32s::splat(simd, place));
        let near = distance_squared.simd_le(S::f32s::splat(simd, self.reach_squared)) & another;
        (near, offset, distance_squared)
    }

    /// Notes which lanes are close to these places; tells which of them are exactly there.
    #[cold]
    #[inline(never)]
    fn note_close(&self, places: &[u32], close: &mut Vec<(u32, u32)>) -> u64 {
        let flock = self.flock;
        let mut unclear = 0;
        for &place in places {
            for lane in (0..self.count).filter(|lane| self.start + lane != place as usize) {
                let offset = flock.birds.all[place as usize].position - flock.birds.all[self.start + lane].position;
                if offset.length_squared() <= flock.close * flock.close {
                    close.push(((self.start + lane) as u32, place));
                    unclear |= u64::from(offset == Vec3::ZERO) << lane;
                }
            }
        }
        unclear
    }

    /// What the three rules come to together.
    #[inline(always)]
    fn force(&self, sums: &[Sum<S>; 3]) -> Vec3s<S> {
        let [separation, alignment, cohesion] = *sums;
        let flocking = self.flock.flocking;
        let one = S::f32s::splat(self.simd, 1.0);
        let turn = alignment.sum * (one / alignment.count) - self.forward;
        let zero = S::f32s::splat(self.simd, 0.0);
        let turns = alignment.count.simd_gt(zero);
        let nothing = Vec3s { x: zero, y: zero, z: zero };
        let turn = Vec3s::select(turns, turn, nothing);
        let middle = cohesion.sum * (one / cohesion.count);
        let middle = Vec3s::select(cohesion.count.simd_gt(zero), middle, nothing);
        self.urge(separation.sum, flocking.separation.weight)
            + self.urge(turn, flocking.alignment.weight)
            + self.urge(middle, flocking.cohesion.weight)
    }

    /// As `View::urge` with all of the force, weighted.
    #[inline(always)]
    fn urge(&self, direction: Vec3s<S>, weight: f32) -> Vec3s<S> {
        let splat = |value: f32| S::f32s::splat(self.simd, value);
        let zero = splat(0.0);
        let direction = match self.flock.vehicle.locomotion {
            Locomotion::Ground => Vec3s { z: zero, ..direction },
            Locomotion::Level | Locomotion::Banking => direction,
        };
        let length = direction.length();
        let force = direction * (splat(self.flock.vehicle.max_force) / length);
        Vec3s::select(length.simd_gt(zero), force, Vec3s { x: zero, y: zero, z: zero }) * splat(weight)
    }
}

impl<S: Simd> Sum<S> {
    /// Adds to those that belong.
    #[inline(always)]
    fn add(&mut self, belongs: S::mask32s, v: Vec3s<S>, one: S::f32s) {
        self.sum = Vec3s::select(belongs, self.sum + v, self.sum);
        self.count = belongs.select(self.count + one, self.count);
    }
}
