//! Shadows: a map of how far the light of the sun reaches.
//!
//! Penumbras are as wide as the sun and the distance of what casts the shadow make them (Fernando, Percentage-Closer
//! Soft Shadows, 2005). Closed bodies cast the shadow of their far sides, so that lit sides do not shade themselves.

use crate::coarse::{Coarse, STRIDE};
use crate::front::{Front, Fronts, blurred, turn};
use crate::geometry::{Geometry, Surface};
use crate::raster::{BAND, Bands, Cover, Grid, Plane, SAMPLES, cover_depth, place_in_bands};
use crate::view::SUB;
use crate::{Sun, View, parallel};
use glam::{Vec2, Vec3, Vec4};

/// The number of points of the map along a side.
const SIDE: usize = 2048;
/// The side of a tile of the map, points, and the number of tiles along a side.
const TILE: usize = BAND;
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
    /// The points of a disc that are compared.
    disc: [Vec2; SEARCHES + SOFTENERS],
}

impl Shadows {
    /// Creates the map of all surfaces that are not clear and not on the ground; `None` without any.
    pub fn new(geometry: &Geometry<'_>, sun: &Sun) -> Option<Self> {
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
            disc: disc(),
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
            let corners = corners.map(|corner| places[corner as usize]);
            let [(a, p), (b, q), (c, r)] = corners;
            let turn = (b - a).perp_dot(c - a);
            if !turn.is_finite() || (turn > 0.0 && !surface.thin) {
                return None;
            }
            let step = ((c - a).perp() * (q - p) - (b - a).perp() * (r - p)) / -turn;
            let near = Plane { at: p - step.dot(a), step };
            if !near.at.is_finite() || !step.is_finite() {
                return None;
            }
            let pixel = |place: Vec2| (place * SUB as f32).round().as_ivec2();
            let cover = Cover::new([pixel(a), pixel(b), pixel(c)], near, [p.min(q).min(r), p.max(q).max(r)], 0)?;
            (!cover.between(SUB)).then_some(cover)
        };
        surface.triangles.iter().filter_map(triangle).collect()
    }

    /// Returns the height of what is at a point; nothing beyond the map.
    fn height(&self, at: Vec2) -> f32 {
        // From -1 to 0, numbers become 0: the edge of the map is empty.
        let (x, y) = (at.x as i32 as u32 as usize, at.y as i32 as u32 as usize);
        if x >= SIDE || y >= SIDE {
            return f32::NEG_INFINITY;
        }
        self.heights[place_in_bands(SIDE / SAMPLES, [x / SAMPLES, y])][x % SAMPLES]
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
        let (mut sum, mut found) = (0.0, 0.0);
        for point in self.disc[..SEARCHES].iter().chain([&Vec2::ZERO]) {
            let caster = self.height(at + spread.rotate(*point) * self.search);
            if caster > least {
                sum += caster - height;
                found += 1.0;
            }
        }
        if found == 0.0 {
            return 1.0;
        }
        let soft = (sum / found * self.size / self.point).clamp(0.8, self.search);
        let lit = self.disc[SEARCHES..].iter().filter(|point| self.height(at + spread.rotate(**point) * soft) <= least);
        lit.count() as f32 / SOFTENERS as f32
    }

    /// Returns the greatest height of what is near a point.
    fn peak(&self, at: Vec2) -> f32 {
        let tile = at.clamp(Vec2::ZERO, Vec2::splat(SIDE as f32 - 1.0)).as_usizevec2() / TILE;
        self.peaks[tile.y * TILES + tile.x]
    }

    /// Returns the greatest height within the search of each tile of the map and of what is beyond its edge.
    fn peaks(&self) -> Vec<f32> {
        let cells = TILE * TILE / SAMPLES;
        let own = parallel::map(TILES * TILES, |tile| {
            let cells = &self.heights[tile * cells..][..cells];
            cells.iter().fold(Vec4::NEG_INFINITY, |peak, cell| peak.max(*cell)).max_element()
        });
        let near = (self.search / TILE as f32).ceil() as usize;
        let span = |at: usize| at.saturating_sub(near)..(at + near + 1).min(TILES);
        let most = |(row, column): (usize, usize)| {
            let tiles = span(row).flat_map(|row| span(column).map(move |column| row * TILES + column));
            tiles.fold(f32::NEG_INFINITY, |peak, tile| peak.max(own[tile]))
        };
        (0..TILES * TILES).map(|tile| most((tile / TILES, tile % TILES))).collect()
    }
}

/// Returns two sets of points that are spread evenly over a disc of radius 1 (Vogel, 1979).
fn disc() -> [Vec2; SEARCHES + SOFTENERS] {
    let point = |k: usize, count: usize| {
        let (sine, cosine) = libm::sincosf(k as f32 * GOLDEN);
        Vec2::new(cosine, sine) * libm::sqrtf((k as f32 + 0.5) / count as f32)
    };
    std::array::from_fn(|k| if k < SEARCHES { point(k, SEARCHES) } else { point(k - SEARCHES, SOFTENERS) })
}
