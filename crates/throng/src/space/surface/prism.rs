//! Upright solids over polygons: pillars, rooms, ground plans.

use super::extrude::extrude;
use super::sweep::touch_convex;
use super::{Bounds, Bvh, Surface, SurfaceHit, SurfacePoint, Sweep};
use crate::error::Error;
use crate::space::check_polygon;
use glam::{Vec2, Vec3, Vec3Swizzles};

/// An upright solid over a simple polygon, convex or not. Seen from inside it is a room.
///
/// ```
/// use glam::{Vec2, Vec3};
/// use throng::space::surface::{Prism, Surface};
///
/// let square = [Vec2::ZERO, Vec2::new(4.0, 0.0), Vec2::new(4.0, 4.0), Vec2::new(0.0, 4.0)];
/// let pillar = Prism::new(&square, 0.0, 3.0)?;
/// assert_eq!(pillar.query(Vec3::new(2.0, 3.0, 5.0)).distance, 2.0);
/// assert_eq!(Prism::ground(&square)?.query(Vec3::new(2.0, 3.0, 5.0)).distance, -1.0);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Prism {
    /// The sides, counter-clockwise.
    sides: Vec<PrismSide>,
    bottom: f32,
    top: f32,
    /// A hierarchy over the sides.
    bvh: Bvh,
}

/// A side from one corner to the next.
#[derive(Clone, Debug, PartialEq)]
struct PrismSide {
    start: Vec2,
    end: Vec2,
    /// Unit vector from start to end.
    along: Vec2,
    /// Unit vector out of the solid.
    out: Vec2,
    /// Sums of the outward unit vectors on both sides of the start, and of the end.
    corners: [Vec2; 2],
}

impl PrismSide {
    /// Returns the signed distance of `p` from this side of the polygon's boundary, and the direction in which it
    /// grows.
    fn query(&self, p: Vec2) -> (f32, Vec2) {
        let t = (p - self.start).dot(self.along);
        let (corner, out) = if t <= 0.0 {
            (self.start, self.corners[0])
        } else if (p - self.end).dot(self.along) >= 0.0 {
            (self.end, self.corners[1])
        } else {
            return ((p - self.start).dot(self.out), self.out);
        };
        let offset = p - corner;
        let sign = if offset.dot(out) < 0.0 { -1.0 } else { 1.0 };
        (offset.length() * sign, offset.normalize_or(self.out * sign) * sign)
    }
}

impl Prism {
    /// Returns the solid over a polygon, from one height to another, metres. Corners may be in either order; the first
    /// is not repeated. Heights may be infinite.
    ///
    /// # Errors
    /// [`Error::Limit`] if the top is not above the bottom; [`Error::Shape`] if a corner is not finite, or the polygon
    /// encloses nothing or crosses itself.
    pub fn new(corners: &[Vec2], bottom: f32, top: f32) -> Result<Self, Error> {
        let wide: Vec<_> = corners.iter().map(|corner| corner.as_dvec2()).collect();
        check_polygon("the polygon of a prism", &wide)?;
        Error::unless(top > bottom, "the top of a prism", top, "greater than its bottom")?;
        let mut ring = corners.to_vec();
        ring.dedup();
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        let n = ring.len();
        let area: f64 = (0..wide.len()).map(|i| wide[i].perp_dot(wide[(i + 1) % wide.len()])).sum();
        if area < 0.0 {
            ring.reverse();
        }
        let along = |i: usize| (ring[(i + 1) % n] - ring[i % n]).normalize_or_zero();
        let out = |i: usize| -along(i).perp();
        let side = |i: usize| PrismSide {
            start: ring[i],
            end: ring[(i + 1) % n],
            along: along(i),
            out: out(i),
            corners: [out(i + n - 1) + out(i), out(i) + out(i + 1)],
        };
        let sides: Vec<PrismSide> = (0..n).map(side).collect();
        let wall = |side: &PrismSide| Bounds::around([side.start.extend(bottom), side.end.extend(top)]);
        let bvh = Bvh::new(&sides.iter().map(wall).collect::<Vec<_>>());
        Ok(Self { sides, bottom, top, bvh })
    }

    /// Returns the solid over a polygon, infinite upwards and downwards: a ground plan.
    ///
    /// # Errors
    /// Those of [`Prism::new`].
    pub fn ground(corners: &[Vec2]) -> Result<Self, Error> {
        Self::new(corners, f32::NEG_INFINITY, f32::INFINITY)
    }

    /// Returns the signed distance from the polygon, and the direction in which it grows.
    fn across(&self, p: Vec2) -> (f32, Vec2) {
        // at a height between bottom and top, where the distances of the boxes are those in the plan
        let z = 0.0f32.clamp(self.bottom, self.top);
        let look = |side: u32| {
            let found = self.sides[side as usize].query(p);
            (found.0.abs(), found)
        };
        self.bvh.nearest(p.extend(z), look).map_or((f32::INFINITY, Vec2::X), |found| found.1)
    }

    /// Returns the nearest point to `p` of a side, seen as a sheet.
    fn wall(&self, side: &PrismSide, p: Vec3) -> SurfacePoint {
        let (beside, normal) = side.query(p.xy());
        let beyond = p.z - p.z.clamp(self.bottom, self.top);
        if beyond == 0.0 {
            let normal = (normal * if beside < 0.0 { -1.0 } else { 1.0 }).extend(0.0);
            return SurfacePoint { point: p - normal * beside.abs(), normal, distance: beside.abs() };
        }
        let offset = (normal * beside).extend(beyond);
        SurfacePoint { point: p - offset, normal: offset.normalize(), distance: offset.length() }
    }

    /// Returns the contact of a ball with the bottom or the top. Only the one that it moves towards can be in its way.
    fn touch_end(&self, sweep: &Sweep, from_outside: bool) -> Option<SurfaceHit> {
        let up = sweep.direction.z > 0.0;
        // from outside it moves down to the top or up to the bottom; from inside the reverse
        let (end, normal) = if up == from_outside { (self.bottom, -Vec3::Z) } else { (self.top, Vec3::Z) };
        let gap = (end - sweep.origin.z) * sweep.direction.z.signum() - sweep.radius;
        let beyond = (sweep.origin.z - end) * normal.z;
        if sweep.direction.z == 0.0 || from_outside && beyond < 0.0 {
            return None;
        }
        let distance = gap.max(0.0) / sweep.direction.z.abs();
        let at = sweep.at(distance);
        let touches = distance.is_finite() && distance <= sweep.reach && self.across(at.xy()).0 <= 0.0;
        touches.then_some(SurfaceHit { distance, point: at.with_z(end), normal, from_outside })
    }
}

impl Surface for Prism {
    fn query(&self, point: Vec3) -> SurfacePoint {
        let (beside, out) = self.across(point.xy());
        let (below, above) = (self.bottom - point.z, point.z - self.top);
        let end = if below > above { (below, -Vec3::Z) } else { (above, Vec3::Z) };
        extrude(point, (beside, out.extend(0.0)), end)
    }

    fn sweep(&self, sweep: &Sweep) -> Option<SurfaceHit> {
        let from_outside = !self.query(sweep.origin).is_inside();
        let end = self.touch_end(sweep, from_outside);
        let sweep = end.map_or(*sweep, |end| sweep.until(end.distance));
        let wall = self.bvh.first_touched(&sweep, |side, sweep| {
            let side = &self.sides[side as usize];
            touch_convex(|p| self.wall(side, p), sweep)
        });
        let nearer = wall
            .map(|hit| hit.of_solid(from_outside))
            .filter(|wall| end.is_none_or(|end| wall.distance < end.distance));
        nearer.or(end)
    }

    fn facets(&self, within: &Bounds) -> Vec<Vec<Vec3>> {
        let (bottom, top) = (self.bottom.max(within.low.z), self.top.min(within.high.z));
        let ring = |z: f32| self.sides.iter().map(move |side| side.start.extend(z));
        let side = |side: &PrismSide| {
            let [low, high] = [bottom, top].map(|z| [side.start.extend(z), side.end.extend(z)]);
            vec![low[0], low[1], high[1], high[0]]
        };
        let ends = [ring(top).collect(), ring(bottom).rev().collect()];
        ends.into_iter().chain(self.sides.iter().map(side)).collect()
    }

    fn bounds(&self) -> Bounds {
        self.bvh.bounds()
    }
}
