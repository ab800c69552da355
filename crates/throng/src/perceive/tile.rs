//! SIMD nearest-neighbour search, one point per element of a vector.
//!
//! Points that are adjacent in the grid's order have the same surroundings. A *tile* is as many of them as a SIMD
//! vector holds. The points near the tile are packed once, then each point of the tile is compared with all of them.
//! The nearest are kept as keys: the bits of the squared distance with the lowest bits replaced by the place in the
//! pack. Insertion is a sequence of minima and maxima without branches. Where the remaining bits cannot distinguish two
//! points, the exact distances of the kept points decide. If even these are equal, or a point that was not kept may be
//! nearer, the search is left to the [scalar search](super::nearest). So the answer is always exact and the same for
//! every instruction set.

use super::grid::Grid;
use crate::simd::{LANES, ones};
use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch};
use glam::Vec2;
use std::ops::Range;

/// Number of bits of a key that hold a place in the pack.
const PLACE_BITS: u32 = 9;
const PLACE: u32 = (1 << PLACE_BITS) - 1;
/// Maximum number of points of a pack. Beyond that the search tries a smaller radius or a smaller tile, and at last
/// leaves the point to the scalar search.
const MOST: usize = 1 << PLACE_BITS;
/// Number of keys kept per point: the point itself, its nearest, and one more that shows whether the last of them is
/// unique. Most searches are for few neighbours.
const FEW: usize = FEW_NEIGHBOURS + 2;
const MANY: usize = MOST_NEIGHBOURS + 2;
/// Number of points that are merged into the keys together.
const BATCH: usize = 4;
/// Factor from the squared radius that the previous tile needed to the one tried first.
const MORE: f32 = 1.1;
/// Maximum number of neighbours that a tile can find for each of its points, and the maximum that it finds fast.
pub(crate) const MOST_NEIGHBOURS: usize = 32;
pub(crate) const FEW_NEIGHBOURS: usize = 10;

/// Buffers that a thread keeps from tile to tile.
#[derive(Clone, Debug)]
pub(crate) struct TileScratch {
    x: [f32; MOST + LANES],
    y: [f32; MOST + LANES],
    z: [f32; MOST + LANES],
    row: [u32; MOST + LANES],
    /// Ranges of points that may be near the tile.
    runs: Vec<(u32, u32)>,
    /// The squared radius that was large enough for the previous tile. Adjacent tiles need similar radii.
    radius_squared: f32,
}

impl Default for TileScratch {
    fn default() -> Self {
        let (zeros, row) = ([0.0; MOST + LANES], [0; MOST + LANES]);
        Self { x: zeros, y: zeros, z: zeros, row, runs: Vec::new(), radius_squared: f32::INFINITY }
    }
}

impl Grid {
    /// Finds the `k` nearest neighbours within `range` of each point in `places`, which are in the order of cells: in
    /// space if the points have [heights](Self::set_heights), else in the plane. A
    /// point is not its own neighbour. Writes `k + 1` values per point to the first part of `found`, which has at least this
    /// number of values for each: the number of neighbours and their rows, nearest first. Writes to the second part how many of these may be within `close`.
    /// Calls `left` with the place and the results of each point that needs the scalar search.
    ///
    /// # Panics
    /// If `k` is more than [`MOST_NEIGHBOURS`].
    pub(crate) fn nearest_of_many(
        &self,
        level: Level,
        places: Range<usize>,
        (k, range, close): (usize, f32, f32),
        pack: &mut TileScratch,
        found: (&mut [u32], &mut [u16]),
        left: impl FnMut(usize, &mut [u32], &mut u16),
    ) {
        assert!(k <= MOST_NEIGHBOURS, "at most {MOST_NEIGHBOURS} neighbours");
        let of = (k, range, close);
        match (self.z.is_empty(), k <= FEW_NEIGHBOURS) {
            (true, true) => dispatch!(level, simd => many::<_, false, FEW>(simd, self, places, of, pack, found, left)),
            (true, false) => {
                dispatch!(level, simd => many::<_, false, MANY>(simd, self, places, of, pack, found, left))
            }
            (false, true) => dispatch!(level, simd => many::<_, true, FEW>(simd, self, places, of, pack, found, left)),
            (false, false) => {
                dispatch!(level, simd => many::<_, true, MANY>(simd, self, places, of, pack, found, left))
            }
        }
    }
}

#[inline(always)]
fn many<S: Simd, const SPACE: bool, const KEYS: usize>(
    simd: S,
    grid: &Grid,
    places: Range<usize>,
    (k, range, close): (usize, f32, f32),
    pack: &mut TileScratch,
    (found, close_counts): (&mut [u32], &mut [u16]),
    mut left: impl FnMut(usize, &mut [u32], &mut u16),
) {
    let stride = found.len() / places.len().max(1);
    let mut start = places.start;
    let mut most = S::f32s::LEN;
    while start < places.end {
        // a tile that continued in the next row of cells would be as wide as the grid
        let end = (start + most).min(places.end).min(grid.end_of_row(start));
        let rows = start - places.start..end - places.start;
        let out = &mut found[rows.start * stride..rows.end * stride];
        let close_counts = &mut close_counts[rows];
        let missing = match PointTile::<S, SPACE, KEYS>::new(simd, grid, start, end).nearest(
            (k, range, close),
            pack,
            (out, close_counts),
        ) {
            Some(unclear) => unclear,
            None if end - start > 1 => {
                most = (end - start) / 2;
                continue;
            }
            None => 1,
        };
        for lane in ones(missing) {
            left(start + lane, &mut out[lane * stride..(lane + 1) * stride], &mut close_counts[lane]);
        }
        start = end;
        most = (2 * most).min(S::f32s::LEN);
    }
}

/// Sorts each pair of keys, in every element of the vectors.
macro_rules! exchange {
    ($all:ident: $($a:literal-$b:literal)*) => {
        $(($all[$a], $all[$b]) = ($all[$a].min($all[$b]), $all[$a].max($all[$b]));)*
    };
}

/// Adjacent points and their bounding box on the ground.
struct PointTile<'a, S: Simd, const SPACE: bool, const KEYS: usize> {
    simd: S,
    grid: &'a Grid,
    start: usize,
    count: usize,
    x: S::f32s,
    y: S::f32s,
    /// Heights; 0 in the plane.
    z: S::f32s,
    low: Vec2,
    high: Vec2,
}

impl<'a, S: Simd, const SPACE: bool, const KEYS: usize> PointTile<'a, S, SPACE, KEYS> {
    #[inline(always)]
    fn new(simd: S, grid: &'a Grid, start: usize, end: usize) -> Self {
        let count = end - start;
        let column = |all: &[f32]| {
            if count == S::f32s::LEN {
                S::f32s::from_slice(simd, &all[start..start + S::f32s::LEN])
            } else {
                S::f32s::from_fn(simd, |lane| all[start + lane.min(count - 1)])
            }
        };
        let (x, y) = (column(&grid.x), column(&grid.y));
        let z = if SPACE { column(&grid.z) } else { S::f32s::splat(simd, 0.0) };
        let low = Vec2::new(x.reduce_min(), y.reduce_min());
        let high = Vec2::new(x.reduce_max(), y.reduce_max());
        Self { simd, grid, start, count, x, y, z, low, high }
    }

    /// Finds the nearest neighbours of all points of the tile, and how many are close. Returns the points that need the
    /// scalar search, one bit each, or `None` if too many points are near the tile.
    #[inline(always)]
    fn nearest(
        &self,
        (k, range, close): (usize, f32, f32),
        pack: &mut TileScratch,
        (out, close_counts): (&mut [u32], &mut [u16]),
    ) -> Option<u64> {
        let range_squared = range * range;
        let mut radius_squared = pack.radius_squared.min(range_squared);
        let (mut inner, mut count) = (None, 0);
        let mut keys = [S::u32s::splat(self.simd, u32::MAX); KEYS];
        loop {
            let Some(packed) = self.pack(count, inner, radius_squared, pack) else {
                // in such a crowd a smaller radius is enough
                pack.radius_squared = 0.25 * radius_squared;
                return None;
            };
            self.sort_in(&mut keys, pack, count..packed);
            // all points nearer than the last are packed
            let last = keys[k].reduce_max();
            if last < (radius_squared.to_bits() & !PLACE) || radius_squared == range_squared {
                pack.radius_squared = MORE * f32::from_bits(last.min(range_squared.to_bits()));
                let all_points = (1u64 << self.count) - 1;
                self.count_close(k, close.min(range), &keys, close_counts);
                let alike = self.list(k, range_squared, &keys, pack, out) & all_points;
                if alike == 0 {
                    return Some(0);
                }
                let unclear = |lane: &usize| !self.resolve(*lane, (k, range, close), &keys, pack, (out, close_counts));
                return Some(ones(alike).filter(unclear).fold(0, |bits, lane| bits | 1 << lane));
            }
            let next = if last < f32::INFINITY.to_bits() {
                f32::from_bits(last | PLACE) * 1.01
            } else {
                (radius_squared * 2.0).max(self.high.distance_squared(self.low))
            };
            (inner, count) = (Some(radius_squared), packed);
            radius_squared = next.min(range_squared);
        }
    }

    /// Packs all points that are farther from the bounding box of the tile than an inner radius and within an outer
    /// one. Starts at place `count` of the pack. Returns the new number of points, or `None` if there are too many.
    #[inline(always)]
    fn pack(&self, mut count: usize, inner: Option<f32>, radius_squared: f32, pack: &mut TileScratch) -> Option<usize> {
        let Self { simd, grid, low, high, .. } = *self;
        pack.runs.clear();
        grid.runs_near(low, high, radius_squared, &mut pack.runs);
        let lane = S::u32s::from_fn(simd, |lane| lane as u32);
        let (left, right) = (S::f32s::splat(simd, low.x), S::f32s::splat(simd, high.x));
        let (bottom, top) = (S::f32s::splat(simd, low.y), S::f32s::splat(simd, high.y));
        let (zero, none) = (S::f32s::splat(simd, 0.0), S::f32s::splat(simd, f32::NAN));
        let limit = S::f32s::splat(simd, radius_squared);
        let packed = S::f32s::splat(simd, inner.unwrap_or(-1.0));
        for &(start, end) in &pack.runs {
            let mut at = start as usize;
            while at < end as usize {
                let range = at..at + S::f32s::LEN;
                let x = S::f32s::from_slice(simd, &grid.x[range.clone()]);
                let y = S::f32s::from_slice(simd, &grid.y[range.clone()]);
                let row = S::u32s::from_slice(simd, &grid.order[range.clone()]);
                let dx = (left - x).max(x - right).max(zero);
                let dy = (bottom - y).max(y - top).max(zero);
                let distance = dx * dx + dy * dy;
                // points beyond the end of the run are at no distance
                let is_in_run = lane.simd_lt(S::u32s::splat(simd, end - at as u32));
                let distance = is_in_run.select(distance, none);
                let within = distance.simd_le(limit) & distance.simd_gt(packed);
                if count > MOST {
                    return None;
                }
                x.compress(within).store_slice(&mut pack.x[count..count + S::f32s::LEN]);
                y.compress(within).store_slice(&mut pack.y[count..count + S::f32s::LEN]);
                if SPACE {
                    let z = S::f32s::from_slice(simd, &grid.z[range]);
                    z.compress(within).store_slice(&mut pack.z[count..count + S::f32s::LEN]);
                }
                row.compress(within).store_slice(&mut pack.row[count..count + S::f32s::LEN]);
                count += within.to_bitmask().count_ones() as usize;
                at += S::f32s::LEN;
            }
        }
        if count > MOST {
            return None;
        }
        pack.x[count..count + BATCH].fill(f32::INFINITY);
        Some(count)
    }

    /// Merges packed points into the ascending lists of least keys, [`BATCH`] at a time. Beyond the last point of the
    /// pack are points at infinity.
    #[inline(always)]
    fn sort_in(&self, keys: &mut [S::u32s; KEYS], pack: &TileScratch, places: Range<usize>) {
        // a local copy stays in registers
        let mut least = *keys;
        for first in places.step_by(BATCH) {
            // no closure: compilers do not always inline closures into functions with more target features
            let mut batch = [self.key(pack, first); BATCH];
            for (at, key) in batch.iter_mut().enumerate().skip(1) {
                *key = self.key(pack, first + at);
            }
            if KEYS != FEW {
                // a long list takes one key after the other
                for mut key in batch {
                    if key.simd_lt(least[KEYS - 1]).any_true() {
                        for kept in &mut least {
                            (*kept, key) = (kept.min(key), kept.max(key));
                        }
                    }
                }
                continue;
            }
            exchange!(batch: 0-1 2-3 0-2 1-3 1-2);
            if batch[0].simd_lt(least[KEYS - 1]).any_true() {
                // the least keys of both lists first rise, then fall
                for (at, &key) in batch.iter().rev().enumerate() {
                    least[KEYS - BATCH + at] = least[KEYS - BATCH + at].min(key);
                }
                // then they are merged with the others by Batcher's odd-even merge
                exchange!(least: 8-10 9-11 8-9 10-11);
                exchange!(least: 0-8 1-9 2-10 3-11 4-8 5-9 6-10 7-11 2-4 3-5 6-8 7-9 1-2 3-4 5-6 7-8 9-10);
            }
        }
        *keys = least;
    }

    /// Returns the keys of a packed point for every point of the tile.
    #[inline(always)]
    fn key(&self, pack: &TileScratch, place: usize) -> S::u32s {
        let (dx, dy) =
            (S::f32s::splat(self.simd, pack.x[place]) - self.x, S::f32s::splat(self.simd, pack.y[place]) - self.y);
        let mut distance = dx * dx + dy * dy;
        if SPACE {
            let dz = S::f32s::splat(self.simd, pack.z[place]) - self.z;
            distance += dz * dz;
        }
        let distance: S::u32s = distance.bitcast();
        distance & !PLACE | place as u32
    }

    /// Counts for each point the neighbours that may be close.
    #[inline(always)]
    fn count_close(&self, k: usize, close: f32, keys: &[S::u32s; KEYS], counts: &mut [u16]) {
        let limit = S::u32s::splat(self.simd, (close * close).to_bits() | PLACE);
        let (zero, one) = (S::u32s::splat(self.simd, 0), S::u32s::splat(self.simd, 1));
        let mut sum = zero;
        for key in &keys[1..=k] {
            sum += key.simd_le(limit).select(one, zero);
        }
        counts.iter_mut().zip(sum.as_slice()).for_each(|(count, &sum)| *count = sum as u16);
    }

    /// Writes the rows of the neighbours. Returns the points with two neighbours that the keys cannot distinguish, one
    /// bit each.
    #[inline(always)]
    fn list(&self, k: usize, range_squared: f32, keys: &[S::u32s; KEYS], pack: &TileScratch, out: &mut [u32]) -> u64 {
        let simd = self.simd;
        let limit = S::u32s::splat(simd, range_squared.to_bits() & !PLACE);
        let mut alike = S::u32s::splat(simd, 0).simd_lt(0);
        let mut counts = S::u32s::splat(simd, 0);
        let one = S::u32s::splat(simd, 1);
        for at in 0..=k {
            let (key, next) = (keys[at] & !PLACE, keys[at + 1] & !PLACE);
            // the keys ascend: equal to the next key below the limit, or to the limit
            alike |= key.simd_eq(next.min(limit));
            counts += key.simd_lt(limit).select(one, S::u32s::splat(simd, 0));
        }
        let mut places = [[0; LANES]; KEYS];
        for (all, &key) in places.iter_mut().zip(keys) {
            (key & PLACE).store_slice(&mut all[..S::u32s::LEN]);
        }
        let stride = out.len() / self.count;
        for (lane, list) in out.chunks_exact_mut(stride).enumerate() {
            // the first key is that of the point itself
            list[0] = counts[lane].saturating_sub(1);
            for (row, places) in list[1..=k].iter_mut().zip(&places[1..]) {
                *row = pack.row[places[lane] as usize];
            }
        }
        alike.to_bitmask()
    }

    /// Lists the neighbours of one point by their exact distances. Returns false if the kept points do not determine them.
    #[inline(never)]
    fn resolve(
        &self,
        lane: usize,
        (k, range, close): (usize, f32, f32),
        keys: &[S::u32s; KEYS],
        pack: &TileScratch,
        (out, close_counts): (&mut [u32], &mut [u16]),
    ) -> bool {
        let (own, at) = (self.grid.order[self.start + lane], Vec2::new(self.x[lane], self.y[lane]));
        let mut near = [(f32::INFINITY, u32::MAX); KEYS];
        let mut count = 0;
        for key in keys.iter().map(|keys| keys[lane]).filter(|key| key & !PLACE < f32::INFINITY.to_bits() & !PLACE) {
            let place = (key & PLACE) as usize;
            if pack.row[place] != own {
                let above = if SPACE { pack.z[place] - self.z[lane] } else { 0.0 };
                let distance_squared = at.distance_squared(Vec2::new(pack.x[place], pack.y[place])) + above * above;
                near[count] = (distance_squared, pack.row[place]);
                count += 1;
            }
        }
        let near = &mut near[..count];
        near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let within = near.iter().take_while(|near| near.0 <= range * range).count();
        let (listed, limit) = (within.min(k), if within < k { range * range } else { near[k - 1].0 });
        // any point that was not kept has a key of at least the last one
        let is_complete = limit.to_bits() & !PLACE < keys[KEYS - 1][lane] & !PLACE;
        let are_equal = near.windows(2).take(listed).any(|pair| pair[0].0 == pair[1].0);
        if !is_complete || are_equal {
            return false;
        }
        let stride = out.len() / self.count;
        let list = &mut out[lane * stride..][..=k];
        list[0] = listed as u32;
        list[1..].iter_mut().zip(&near[..listed]).for_each(|(row, near)| *row = near.1);
        close_counts[lane] = near[..listed].iter().take_while(|near| near.0 <= close * close).count() as u16;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::perceive::{Near, SimdLevel};
    use proptest::prelude::*;

    fn levels() -> impl Iterator<Item = Level> {
        SimdLevel::ALL.into_iter().filter_map(SimdLevel::level)
    }

    /// Returns the rows of the nearest neighbours of all points, by the scalar search.
    fn plain(grid: &Grid, points: &[Vec2], k: usize, range: f32) -> Vec<Vec<u32>> {
        let mut found = Vec::new();
        let nearest = |(row, &from): (usize, &Vec2)| {
            grid.nearest(from, k, range, |near| near.row as usize != row, &mut found);
            found.iter().map(|near: &Near| near.row).collect()
        };
        points.iter().enumerate().map(nearest).collect()
    }

    /// Returns the same by tiles, and the number of points that needed the scalar search.
    fn tiles(level: Level, grid: &Grid, points: &[Vec2], k: usize, range: f32) -> (Vec<Vec<u32>>, usize) {
        let mut lists = vec![Vec::new(); points.len()];
        let (mut out, mut pack, mut left) =
            (vec![0; points.len() * (k + 1)], TileScratch::default(), vec![false; points.len()]);
        let mut close = vec![0; points.len()];
        grid.nearest_of_many(
            level,
            0..points.len(),
            (k, range, 0.0),
            &mut pack,
            (&mut out, &mut close),
            |place, _, _| left[place] = true,
        );
        let mut found = Vec::new();
        for (place, list) in out.chunks_exact(k + 1).enumerate() {
            let row = grid.order()[place];
            lists[row as usize] = if left[place] {
                grid.nearest(points[row as usize], k, range, |near| near.row != row, &mut found);
                found.iter().map(|near: &Near| near.row).collect()
            } else {
                list[1..=list[0] as usize].to_vec()
            };
        }
        (lists, left.iter().filter(|&&left| left).count())
    }

    #[test]
    fn more_than_a_pack_holds_are_found_too() {
        let mut bits = 1u32;
        let mut coordinate = || {
            bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (bits >> 8) as f32 / (1 << 24) as f32
        };
        // as many as fit, and a few more, all of them near each other
        let full = (MOST - 4..=MOST + LANES + 2).map(|count| (count, 2.0));
        for (count, side) in full.chain([(2000, 1.0), (2000, 5.0), (2000, 12.0), (2000, 20.0)]) {
            let points: Vec<Vec2> = (0..count).map(|_| Vec2::new(coordinate(), coordinate()) * side).collect();
            let numbers: Vec<u32> = (0..count as u32).collect();
            let mut grid = Grid::default();
            grid.rebuild(&points, &numbers, 5.0);
            let expected = plain(&grid, &points, 10, 5.0);
            for level in levels() {
                assert_eq!(tiles(level, &grid, &points, 10, 5.0).0, expected, "{level:?}, {count} in {side} m");
            }
        }
    }

    #[test]
    fn neighbours_at_almost_the_same_distance_are_told_apart() {
        let on_ring = |k: u32| 103.5 * Vec2::from_angle(std::f32::consts::TAU * k as f32 / 1000.0);
        let points: Vec<Vec2> = (0..1000).map(on_ring).collect();
        let numbers: Vec<u32> = (0..1000).collect();
        let mut grid = Grid::default();
        grid.rebuild(&points, &numbers, 8.0);
        let expected = plain(&grid, &points, 10, 8.0);
        for level in levels() {
            let (found, left) = tiles(level, &grid, &points, 10, 8.0);
            assert_eq!(found, expected, "{level:?}");
            assert!(left <= 100, "{left} points need the scalar search");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn tiles_find_what_the_plain_search_finds(
            points in prop::collection::vec((-20.0f32..20.0, -20.0f32..20.0), 1..600),
            spot in 0usize..600, coarse in prop_oneof![Just(0.0f32), Just(0.25)], scale in 0.01f32..10.0,
            cell in 0.1f32..20.0, k in prop_oneof![1usize..=FEW_NEIGHBOURS, 1usize..=MOST_NEIGHBOURS], range in 0.1f32..30.0,
        ) {
            let place = |(i, &(x, y)): (usize, &(f32, f32))| {
                let p = Vec2::new(x, y) * if i < spot { scale } else { 1.0 };
                if coarse > 0.0 { (p / coarse).round() * coarse } else { p }
            };
            let points: Vec<Vec2> = points.iter().enumerate().map(place).collect();
            let numbers: Vec<u32> = (0..points.len() as u32).rev().collect();
            let mut grid = Grid::default();
            grid.rebuild(&points, &numbers, cell);
            let expected = plain(&grid, &points, k, range);
            let mut left = None;
            for level in levels() {
                let (found, count) = tiles(level, &grid, &points, k, range);
                prop_assert_eq!(&found, &expected, "{:?}", level);
                left = Some(count);
            }
            if coarse == 0.0 {
                prop_assert!(left.unwrap_or(0) <= 4 + points.len() / 4, "{left:?} points need the scalar search");
            }
        }
    }
}
