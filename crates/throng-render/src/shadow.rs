//! Shadows: a map of how far the light of the sun reaches.
//!
//! Penumbras are as wide as the sun and the distance of what casts the shadow make them (Fernando, Percentage-Closer
//! Soft Shadows, 2005). Closed bodies cast the shadow of their far sides, so that lit sides do not shade themselves.

use crate::geometry::{Geometry, Surface};
use crate::raster::{Bands, Cover, Grid, Plane, cover_depth};
use crate::view::SUB;
use crate::{Sun, parallel};
use glam::{Vec2, Vec3, Vec4};

/// The number of points of the map along a side.
const SIDE: usize = 2048;
/// The finest distance of points, metres.
const FINEST: f32 = 0.004;
/// The distance within which casters are looked for, and the widest penumbra, metres.
const REACH: f32 = 0.35;
/// The number of points that are compared to find casters, and to soften the shadow.
const SEARCHES: usize = 6;
const SOFTENERS: usize = 10;
/// The golden angle, which spreads points evenly over a disc, radians.
const GOLDEN: f32 = 2.399_963;

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
    /// The greatest height towards the sun of what is at each point, four points a cell.
    heights: Vec<Vec4>,
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
        let mut shadows = Self {
            axes,
            low,
            point,
            size: sun.size.clamp(0.0, 0.2),
            heights: vec![Vec4::NEG_INFINITY; Grid::map(SIDE).cells()],
            disc: disc(),
        };
        let covers = parallel::map(casters.len(), |index| shadows.covers(casters[index]));
        let grid = Grid::map(SIDE);
        let bands = Bands::new(&grid, covers.iter().flatten());
        cover_depth(&grid, &bands, &mut shadows.heights);
        Some(shadows)
    }

    /// Returns a place in units of points, and its height towards the sun.
    fn at(&self, place: Vec3) -> (Vec2, f32) {
        let [along, across, towards] = self.axes;
        ((Vec2::new(place.dot(along), place.dot(across)) - self.low) / self.point, place.dot(towards))
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
            Cover::new([pixel(a), pixel(b), pixel(c)], near, [p.min(q).min(r), p.max(q).max(r)], 0)
        };
        surface.triangles.iter().filter_map(triangle).collect()
    }

    /// Returns the height of what is at a point; nothing beyond the map.
    fn height(&self, at: Vec2) -> f32 {
        if at.x < 0.0 || at.y < 0.0 || at.x >= SIDE as f32 || at.y >= SIDE as f32 {
            return f32::NEG_INFINITY;
        }
        let (x, y) = (at.x as usize, at.y as usize);
        self.heights[y * (SIDE / 4) + x / 4][x % 4]
    }

    /// Returns how much of the sun is seen from a place with a normal, 0 to 1. `turn`, 0 to 1, differs between
    /// neighbouring pixels, so that what is compared differs too.
    pub fn light(&self, place: Vec3, normal: Vec3, turn: f32) -> f32 {
        let (at, height) = self.at(place + normal * (0.8 * self.point));
        let side = SIDE as f32;
        let reach = REACH / self.point;
        if at.x < -reach || at.y < -reach || at.x > side + reach || at.y > side + reach {
            return 1.0;
        }
        let (sine, cosine) = libm::sincosf(turn * std::f32::consts::TAU);
        let spread = Vec2::new(cosine, sine);
        // A caster is above the slope of the surface.
        let bias = 1.2 * self.point;
        let (mut sum, mut found) = (0.0, 0.0);
        let search = (self.size * 6.0 / self.point).clamp(2.0, reach);
        for point in &self.disc[..SEARCHES] {
            let caster = self.height(at + spread.rotate(*point) * search);
            if caster > height + bias {
                sum += caster - height;
                found += 1.0;
            }
        }
        if self.height(at) > height + bias {
            sum += self.height(at) - height;
            found += 1.0;
        }
        if found == 0.0 {
            return 1.0;
        }
        let soft = (sum / found * self.size / self.point).clamp(0.8, reach);
        let lit = self.disc[SEARCHES..].iter().filter(|point| {
            let caster = self.height(at + spread.rotate(**point) * soft);
            caster <= height + bias
        });
        lit.count() as f32 / SOFTENERS as f32
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
