//! Shadows: a map of how far the light of the sun reaches.
//!
//! Penumbras are as wide as the sun and the distance of what casts the shadow make them (Fernando, Percentage-Closer
//! Soft Shadows, 2005). Closed bodies cast the shadow of their far sides, so that lit sides do not shade themselves.

use crate::coarse::{Coarse, STRIDE};
use crate::front::{Front, Fronts, blurred, turn};
use crate::geometry::{Geometry, Surface};
use crate::raster::{BAND, Bands, Cover, Grid, Plane, SAMPLES, cover_depth, place_in_bands};
use crate::simd::{Floats, LANES};
use crate::view::{SUB, rounded};
use crate::{Sun, View, parallel};
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::{Vec2, Vec3, Vec4};

/// The number of points of the map along a side.
const SIDE: usize = 2048;
/// The side of a tile of the map, points, and the number of tiles along a side.
const TILE: usize = SAMPLES;
const TILES: usize = SIDE / TILE;
/// The finest distance of points, metres.
const FINEST: f32 = 0.004;
/// The distance within which casters are looked for, and the widest penumbra, metres.
const REACH: f32 = 0.35;
/// The number of points that are compared to find casters, and to soften the shadow.
const SEARCHES: usize = 6;
const SOFTENERS: usize = 10;
/// The golden angle, which spreads points evenly over a disc, radians.
const GOLDEN: f32 = 2.399_963;

/// A place in the map.
struct Spot {
    /// Where it is, in units of points.
    at: Vec2,
    /// Its height towards the sun.
    height: f32,
    /// The height above which things shade it.
    least: f32,
}

/// The map of shadows.
pub(crate) struct Shadows {
    /// The axes of the map, and the direction to the sun.
    axes: [Vec3; 3],
    /// The place of its first corner, along its axes.
    low: Vec2,
    /// The distance of its points, metres.
    point: f32,
    /// The angle of the sun.
    size: f32,
    /// How far casters are looked for, points.
    search: f32,
    /// The greatest height towards the sun of what is at each point, four points a cell, in the order of
    /// [`place_in_bands`].
    heights: Vec<Vec4>,
    /// The greatest height that a search from each tile of the map finds.
    peaks: Vec<f32>,
    /// The points of a disc that are compared to find casters, its middle as well, and to soften the shadow.
    searched: [Floats; 2],
    softened: [Floats; 2],
    /// The SIMD instructions.
    level: Level,
}

impl Shadows {
    /// Creates the map of all surfaces that are not clear and not on the ground; `None` without any.
    pub fn new(geometry: &Geometry<'_>, sun: &Sun, level: Level) -> Option<Self> {
        let towards = sun.direction();
        let (along, across) = towards.any_orthonormal_pair();
        let axes = [along, across, towards];
        let casters: Vec<&Surface<'_>> =
            geometry.surfaces[geometry.areas..].iter().filter(|surface| !surface.material.is_clear()).collect();
        let boxes = parallel::map(casters.len(), |index| {
            let flat = casters[index].places.iter().map(|place| Vec2::new(place.dot(along), place.dot(across)));
            let flat = flat.filter(|place| place.is_finite());
            flat.fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), place| (low.min(place), high.max(place)))
        });
        let low = boxes.iter().fold(Vec2::INFINITY, |low, one| low.min(one.0));
        let high = boxes.iter().fold(Vec2::NEG_INFINITY, |high, one| high.max(one.1));
        let wide = (high - low).max_element();
        if !wide.is_finite() {
            return None;
        }
        let point = (wide / (SIDE - 8) as f32).max(FINEST);
        let low = low - Vec2::splat(3.0 * point);
        let size = sun.size.clamp(0.0, 0.2);
        let mut shadows = Self {
            axes,
            low,
            point,
            size,
            search: (size * 6.0 / point).min(REACH / point).max(2.0),
            peaks: Vec::new(),
            heights: vec![Vec4::NEG_INFINITY; Grid::map(SIDE).cells()],
            searched: disc(SEARCHES),
            softened: disc(SOFTENERS),
            level,
        };
        let covers = parallel::map(casters.len(), |index| shadows.covers(casters[index]));
        let grid = Grid::map(SIDE);
        let bands = Bands::new(&grid, covers.iter().flatten());
        cover_depth(&grid, &bands, &mut shadows.heights);
        shadows.peaks = shadows.peaks();
        Some(shadows)
    }

    /// Returns a place in units of points, and its height towards the sun.
    fn at(&self, place: Vec3) -> (Vec2, f32) {
        let [along, across, towards] = self.axes;
        ((Vec2::new(place.dot(along), place.dot(across)) - self.low) * (1.0 / self.point), place.dot(towards))
    }

    /// Returns the triangles of a surface: the far sides of a closed body.
    fn covers(&self, surface: &Surface<'_>) -> Vec<Cover> {
        let places: Vec<(Vec2, f32)> = surface.places.iter().map(|&place| self.at(place)).collect();
        let triangle = |corners: &[u32; 3]| {
            let &[a, b, c] = corners;
            let [(a, p), (b, q), (c, r)] = [places[a as usize], places[b as usize], places[c as usize]];
            let turn = (b - a).perp_dot(c - a);
            if !turn.is_finite() || (turn > 0.0 && !surface.thin) {
                return None;
            }
            let step = ((c - a).perp() * (q - p) - (b - a).perp() * (r - p)) / -turn;
            let near = Plane { at: p - step.dot(a), step };
            if !near.at.is_finite() || !step.is_finite() {
                return None;
            }
            let pixel = |place: Vec2| rounded(place * SUB as f32);
            let cover = Cover::new([pixel(a), pixel(b), pixel(c)], near, [p.min(q).min(r), p.max(q).max(r)], 0)?;
            (!cover.between(SUB)).then_some(cover)
        };
        surface.triangles.iter().filter_map(triangle).collect()
    }

    /// Returns the share of the sun that each pixel sees, 0 to 1.
    ///
    /// It is found for every other pixel of every other row, and for the rest where those about a pixel differ, or see
    /// another surface.
    pub fn lights(&self, fronts: &Fronts, coarse: &Coarse, view: &View) -> Vec<f32> {
        let width = fronts.width;
        let light = |[column, row]: [usize; 2], known: &dyn Fn(&Front) -> Option<f32>| {
            let front = fronts.all[row * width + column];
            if front.near <= 0.0 {
                return 1.0;
            }
            // What faces away from the sun is in its own shadow. So is the ground where it begins.
            if front.normal.dot(self.axes[2]) <= 0.0 {
                return 0.0;
            }
            let ray = view.ray(Vec2::new(column as f32 + 0.5, row as f32 + 0.5));
            let Some(spot) = self.spot(ray * (1.0 / front.near), front.normal) else { return 1.0 };
            known(&front).unwrap_or_else(|| self.light(&spot, turn(column, row).direction))
        };
        let mut some = vec![1.0; coarse.fronts.all.len()];
        parallel::chunks(&mut some, coarse.fronts.width, |row, lights| {
            for (column, out) in lights.iter_mut().enumerate() {
                *out = light([column * STRIDE, row * STRIDE], &|_| None);
            }
        });
        let mut all = vec![1.0; fronts.all.len()];
        parallel::chunks(&mut all, width, |row, lights| {
            for (column, out) in lights.iter_mut().enumerate() {
                *out = light([column, row], &|front| coarse.agreed(&some, [column, row], front));
            }
        });
        blurred(&all, fronts)
    }

    /// Returns where a place with a normal is in the map; `None` if nothing can shade it.
    fn spot(&self, place: Vec3, normal: Vec3) -> Option<Spot> {
        let (at, height) = self.at(place + normal * (0.8 * self.point));
        // A caster is above the slope of the surface.
        let least = height + 1.2 * self.point;
        (self.peak(at) > least).then_some(Spot { at, height, least })
    }

    /// Returns the share of the sun that a place sees. `spread`, a direction, differs between neighbouring pixels, so
    /// that what is compared differs too.
    fn light(&self, &Spot { at, height, least }: &Spot, spread: Vec2) -> f32 {
        let casters: [f32; SEARCHES + 1] = self.heights(&self.searched, at, spread * self.search);
        let (mut sum, mut found) = (0.0, 0.0);
        for caster in casters {
            if caster > least {
                sum += caster - height;
                found += 1.0;
            }
        }
        if found == 0.0 {
            return 1.0;
        }
        let soft = (sum / found * self.size / self.point).clamp(0.8, self.search);
        let heights: [f32; SOFTENERS] = self.heights(&self.softened, at, spread * soft);
        heights.iter().filter(|height| **height <= least).count() as f32 / SOFTENERS as f32
    }

    /// Returns the heights of what is at the points of a disc about a point; nothing beyond the map. The disc is turned
    /// and scaled by `spread`.
    fn heights<const N: usize>(&self, disc: &[Floats; 2], at: Vec2, spread: Vec2) -> [f32; N] {
        let places = dispatch!(self.level, simd => places(simd, disc, at, spread));
        std::array::from_fn(|k| {
            let place = places[k] as usize;
            self.heights.get(place / SAMPLES).map_or(f32::NEG_INFINITY, |cell| cell[place % SAMPLES])
        })
    }

    /// Returns the greatest height of what is near a point.
    fn peak(&self, at: Vec2) -> f32 {
        let tile = at.clamp(Vec2::ZERO, Vec2::splat(SIDE as f32 - 1.0)).as_usizevec2() / TILE;
        self.peaks[tile.y * TILES + tile.x]
    }

    /// Returns the greatest height within the search of each tile of the map and of what is beyond its edge.
    fn peaks(&self) -> Vec<f32> {
        let mut peaks = vec![f32::NEG_INFINITY; TILES * TILES];
        let reach = (self.search / TILE as f32).ceil() as usize;
        parallel::chunks(&mut peaks, TILES, |row, peaks| {
            for (column, peak) in peaks.iter_mut().enumerate() {
                let cells = &self.heights[place_in_bands(SIDE / SAMPLES, [column, row * TILE])..][..TILE];
                *peak = cells.iter().fold(Vec4::NEG_INFINITY, |peak, cell| peak.max(*cell)).max_element();
            }
            widen(peaks, reach, 1);
        });
        widen(&mut peaks, reach, TILES);
        peaks
    }
}

/// Replaces each value by the greatest of those up to `reach` values away along a row; for values in rows of `stride`,
/// along a column.
fn widen(values: &mut [f32], reach: usize, stride: usize) {
    // The greatest of the values from each one on, of ever more values.
    let greatest = |values: &mut [f32], apart: usize| {
        for k in 0..values.len().saturating_sub(apart) {
            values[k] = values[k].max(values[k + apart]);
        }
    };
    let mut padded = vec![f32::NEG_INFINITY; values.len() + 2 * reach * stride];
    padded[reach * stride..][..values.len()].copy_from_slice(values);
    let (mut count, whole) = (1, 2 * reach + 1);
    while count < whole {
        let more = count.min(whole - count);
        greatest(&mut padded, more * stride);
        count += more;
    }
    values.copy_from_slice(&padded[..values.len()]);
}

/// Returns the places of points in the order of [`place_in_bands`], four to a cell; `u32::MAX` beyond the map.
#[inline(always)]
fn places<S: Simd>(simd: S, disc: &[Floats; 2], at: Vec2, spread: Vec2) -> [u32; LANES] {
    let splat = |value: f32| S::f32s::splat(simd, value);
    let whole = |value: u32| S::u32s::splat(simd, value);
    let mut places = [0; LANES];
    for first in (0..LANES).step_by(S::f32s::LEN) {
        let part = first..first + S::f32s::LEN;
        let [x, y] = [0, 1].map(|axis| S::f32s::from_slice(simd, &disc[axis][part.clone()]));
        let turned = [x * splat(spread.x) - y * splat(spread.y), x * splat(spread.y) + y * splat(spread.x)];
        // From -1 to 0, numbers become 0: the edge of the map is empty.
        let x: S::u32s = (splat(at.x) + turned[0]).to_int::<S::i32s>().bitcast();
        let y: S::u32s = (splat(at.y) + turned[1]).to_int::<S::i32s>().bitcast();
        let inside = x.simd_lt(whole(SIDE as u32)) & y.simd_lt(whole(SIDE as u32));
        let cell = ((y >> BAND.ilog2()) * whole((SIDE / SAMPLES) as u32) + (x >> SAMPLES.ilog2())) * whole(BAND as u32)
            + (y & whole(BAND as u32 - 1));
        let place = cell * whole(SAMPLES as u32) + (x & whole(SAMPLES as u32 - 1));
        inside.select(place, whole(u32::MAX)).store_slice(&mut places[part]);
    }
    places
}

/// Returns points that are spread evenly over a disc of radius 1 (Vogel, 1979). The rest is in its middle.
fn disc(count: usize) -> [Floats; 2] {
    let mut disc = [[0.0; LANES]; 2];
    let [x, y] = &mut disc;
    for (k, (x, y)) in x.iter_mut().zip(y).enumerate().take(count) {
        let (sine, cosine) = libm::sincosf(k as f32 * GOLDEN);
        let far = libm::sqrtf((k as f32 + 0.5) / count as f32);
        (*x, *y) = (cosine * far, sine * far);
    }
    disc
}
