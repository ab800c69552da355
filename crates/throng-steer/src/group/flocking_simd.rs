//! SIMD steering of flocks, one bird per SIMD lane; the results are bit-identical to the [scalar
//! path](super::flocking).
//!
//! Birds that are adjacent in the lattice share their surroundings. A *tile* is a run of adjacent birds, at most as
//! many as the SIMD width. The neighbours of the tile are packed; every lane processes each packed neighbour, in
//! ascending order of places, and adds the neighbours that belong to its neighbourhoods.

use super::flocking::Flocking;
use super::neighbourhood::SquaredBounds;
use fearless_simd::dispatch;
use fearless_simd::prelude::*;
use glam::Vec3;
use std::ops::Range;
use throng::motion::{Locomotion, Vehicle};
use throng::perceive::CellLattice;
use throng::simd::{LANES, Vec3s, get3, ones};
use throng::steer::{Bird, Birds, FlockBatch, GroupFilter};

/// Greatest number of neighbours in a pack; a full pack is processed and emptied.
const MOST: usize = 256;
/// Greatest length of a tile, as a multiple of the height of cells.
const LONG: f32 = 4.0;

/// Buffers that are reused from tile to tile.
#[derive(Debug)]
struct FlockTileScratch<'a> {
    places: [u32; MOST],
    /// Ranges of places that may be near the tile.
    runs: &'a mut Vec<Range<usize>>,
    /// Places of pairs of close agents.
    close: &'a mut Vec<(u32, u32)>,
}

/// Sets the forces of a batch to those of a flock. A bird at exactly the position of another agent gets the force of
/// [`Behaviour::steer`](throng::steer::Behaviour::steer).
pub(super) fn steer(flocking: &Flocking, batch: &mut FlockBatch<'_>) {
    let FlockBatch { level, vehicle, group, range, close, lattice, birds, .. } = *batch;
    let flock = Flock { flocking, vehicle, group, range, close, lattice, birds };
    let mut scratch = FlockTileScratch { places: [0; MOST], runs: &mut *batch.runs, close: &mut *batch.close_pairs };
    let (places, out) = (batch.places.clone(), &mut *batch.forces);
    dispatch!(level, simd => forces(simd, &flock, places, &mut scratch, out, &mut *batch.one));
    batch.is_done = true;
}

/// The rules of a flock, and all agents of the world.
#[derive(Clone, Copy, Debug)]
struct Flock<'a> {
    flocking: &'a Flocking,
    vehicle: &'a Vehicle,
    group: u32,
    range: f32,
    close: f32,
    lattice: &'a CellLattice,
    birds: &'a Birds,
}

impl Flock<'_> {
    /// Whether the birds of the flock take an agent into account.
    #[inline(always)]
    fn counts(&self, other: &Bird) -> bool {
        match self.flocking.groups {
            GroupFilter::All => true,
            GroupFilter::OwnGroup => other.group == self.group,
            GroupFilter::OtherGroups => other.group != self.group,
            GroupFilter::Group(index) => other.group as usize == index,
        }
    }
}

/// Computes the forces of the flock's birds in a range of places, one per place; the forces of other agents stay
/// unchanged. Calls `left` for each bird that shares its position with another agent.
#[inline(always)]
fn forces<S: Simd>(
    simd: S,
    flock: &Flock<'_>,
    places: Range<usize>,
    pack: &mut FlockTileScratch<'_>,
    out: &mut [Vec3],
    mut left: impl FnMut(usize) -> Vec3,
) {
    let [x, ..] = flock.lattice.coordinates();
    let longest = LONG * flock.lattice.height();
    let sights = flock.flocking.near().map(|near| near.sight(0.0));
    let mut start = places.start;
    while start < places.end {
        let most = (start + S::f32s::LEN).min(places.end).min(flock.lattice.end_of_row(start));
        // the places of a row are in the order of x
        let from = S::f32s::from_slice(simd, &x[start..start + S::f32s::LEN]);
        let side_by_side = (from - S::f32s::splat(simd, x[start])).simd_le(S::f32s::splat(simd, longest));
        let end = most.min(start + side_by_side.to_bitmask().trailing_ones() as usize);
        let own = &flock.birds.all[start..end];
        let belongs = |lanes: u64, bird: &Bird| lanes << 1 | u64::from(bird.group == flock.group);
        let lanes = own.iter().rev().fold(0, belongs);
        if lanes != 0 {
            let mut forces = [[0.0; LANES]; 3];
            let tile = BirdTile::new(simd, flock, sights, start, own);
            let unclear = tile.forces(pack, &mut forces);
            for lane in ones(lanes) {
                out[start - places.start + lane] =
                    if unclear >> lane & 1 != 0 { left(start + lane) } else { get3(&forces, lane) };
            }
        }
        start = end;
    }
}

/// Adjacent birds and their bounding box.
struct BirdTile<'a, S: Simd> {
    simd: S,
    flock: &'a Flock<'a>,
    start: usize,
    count: usize,
    position: Vec3s<S>,
    forward: Vec3s<S>,
    always_squared: S::f32s,
    low: Vec3,
    high: Vec3,
    sights: [SquaredBounds; 3],
    reach_squared: f32,
}

/// The sum of one of the rules.
#[derive(Clone, Copy)]
struct RuleSum<S: Simd> {
    sum: Vec3s<S>,
    count: S::f32s,
}

impl<'a, S: Simd> BirdTile<'a, S> {
    #[inline(always)]
    fn new(simd: S, flock: &'a Flock<'a>, sights: [SquaredBounds; 3], start: usize, own: &[Bird]) -> Self {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let column = |all: &[f32]| S::f32s::from_slice(simd, &all[start..start + S::f32s::LEN]);
        let [x, y, z] = flock.lattice.coordinates();
        let position = Vec3s { x: column(x), y: column(y), z: column(z) };
        let [x, y, z] = &flock.birds.forward;
        let forward = Vec3s { x: column(x), y: column(y), z: column(z) };
        // unused lanes do not enlarge the box
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

    /// Computes the forces of all lanes. Returns a mask of the lanes with another agent at exactly their position.
    #[inline(always)]
    fn forces(&self, pack: &mut FlockTileScratch<'_>, out: &mut [[f32; LANES]; 3]) -> u64 {
        let simd = self.simd;
        let zero = S::f32s::splat(simd, 0.0);
        let none = RuleSum { sum: Vec3s { x: zero, y: zero, z: zero }, count: zero };
        let mut sums = [none; 3];
        let mut unclear = 0;
        let mut count = 0;
        let [x, y, z] = self.flock.lattice.coordinates();
        let (left, right) = (S::f32s::splat(simd, self.low.x), S::f32s::splat(simd, self.high.x));
        let (front, back) = (S::f32s::splat(simd, self.low.y), S::f32s::splat(simd, self.high.y));
        let (bottom, top) = (S::f32s::splat(simd, self.low.z), S::f32s::splat(simd, self.high.z));
        let limit = S::f32s::splat(simd, self.reach_squared);
        let lane = S::u32s::from_fn(simd, |lane| lane as u32);
        let FlockTileScratch { places, runs, close } = pack;
        runs.clear();
        self.flock.lattice.runs_near(self.low, self.high, self.reach_squared.sqrt(), |run| runs.push(run));
        for run in runs.iter() {
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

    /// Processes the packed places in all lanes. Returns a mask of the lanes with another agent at exactly their
    /// position.
    #[inline(always)]
    fn look(&self, places: &[u32], sums: &mut [RuleSum<S>; 3], close: &mut Vec<(u32, u32)>) -> u64 {
        let Self { simd, flock, forward, sights, .. } = self;
        let simd = *simd;
        let splat = |value: f32| S::f32s::splat(simd, value);
        let one = splat(1.0);
        let close_squared = splat(flock.close * flock.close);
        let [apart, along, together] = *sights;
        // the sums stay in registers: no function is called from here on
        let [mut separation, mut alignment, mut cohesion] = *sums;
        // a branch on nearness would be unpredictable: the near places are first selected without a branch
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

    /// Returns the lanes that the agent at a place is near to, the offsets of the agent, and the squares of their
    /// lengths.
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

    /// Records the pairs of lanes and places that are close. Returns a mask of the lanes at exactly the position of a
    /// place.
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

    /// Returns the total force of the three rules.
    #[inline(always)]
    fn force(&self, sums: &[RuleSum<S>; 3]) -> Vec3s<S> {
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

    /// Computes `SteeringInput::urge` with the whole force, times a weight.
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

impl<S: Simd> RuleSum<S> {
    /// Adds a vector in the lanes of the mask `belongs`.
    #[inline(always)]
    fn add(&mut self, belongs: S::mask32s, v: Vec3s<S>, one: S::f32s) {
        self.sum = Vec3s::select(belongs, self.sum + v, self.sum);
        self.count = belongs.select(self.count + one, self.count);
    }
}
