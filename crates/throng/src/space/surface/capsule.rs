//! Capsules: everything within a radius of a segment.

use super::facets::{ROUND, turned};
use super::sweep::{finite, touch_convex};
use super::{Bounds, Surface, SurfaceHit, SurfacePoint, Sweep};
use crate::error::Error;
use glam::Vec3;

/// A cylinder with round ends, of any orientation.
#[derive(Clone, Debug, PartialEq)]
pub struct Capsule {
    start: Vec3,
    end: Vec3,
    radius: f32,
}

impl Capsule {
    /// Returns the points within `radius` of the segment between two points, metres. The points may be equal.
    ///
    /// # Errors
    /// [`Error::Limit`] if a point is not finite, or the radius not greater than 0 and finite.
    pub fn new(start: Vec3, end: Vec3, radius: f32) -> Result<Self, Error> {
        finite("an end of a capsule", start)?;
        finite("an end of a capsule", end)?;
        Error::unless_positive("the radius of a capsule", radius)?;
        Ok(Self { start, end, radius })
    }

    /// Returns how far a point inside a capsule of another radius moves until it leaves the capsule: the last exit from
    /// the ball at the start, the ball at the end, and the cylinder between them. Returns `None` if its line misses the
    /// capsule.
    fn leave(&self, radius: f32, sweep: &Sweep) -> Option<f32> {
        let root = |offset: Vec3, direction: Vec3| {
            let along = offset.dot(direction);
            let beside = (offset - direction * along).length_squared();
            (beside <= radius * radius).then(|| (radius * radius - beside).sqrt() - along)
        };
        let ball = |center: Vec3| root(sweep.origin - center, sweep.direction);
        let length = self.start.distance(self.end);
        let axis = (self.end - self.start).normalize_or_zero();
        let flat = |v: Vec3| v - axis * v.dot(axis);
        let turned = flat(sweep.direction);
        let sideways = turned.length();
        let tube = || {
            let distance = root(flat(sweep.origin - self.start), turned / sideways)? / sideways;
            let along = (sweep.at(distance) - self.start).dot(axis);
            (0.0..=length).contains(&along).then_some(distance)
        };
        let tube = if sideways > 0.0 && length > 0.0 { tube() } else { None };
        [ball(self.start), ball(self.end), tube].into_iter().flatten().reduce(f32::max).filter(|&t| t >= 0.0)
    }
}

impl Surface for Capsule {
    fn query(&self, point: Vec3) -> SurfacePoint {
        let axis = self.end - self.start;
        let t = (point - self.start).dot(axis) / axis.length_squared();
        // for a capsule of length 0, t is NaN
        let nearest = if t > 0.0 { self.start + axis * t.min(1.0) } else { self.start };
        let offset = point - nearest;
        let any = axis.try_normalize().map_or(Vec3::X, |axis| axis.any_orthonormal_vector());
        let normal = offset.normalize_or(any);
        SurfacePoint { point: nearest + normal * self.radius, normal, distance: offset.length() - self.radius }
    }

    fn sweep(&self, sweep: &Sweep) -> Option<SurfaceHit> {
        let start = self.query(sweep.origin);
        if !start.is_inside() {
            return touch_convex(|p| self.query(p), sweep);
        }
        let touches = -start.distance <= sweep.radius;
        let distance = match self.leave((self.radius - sweep.radius).max(0.0), sweep) {
            Some(distance) if !touches || start.normal.dot(sweep.direction) <= 0.0 => distance,
            // it touches at the start and does not move away
            _ => 0.0,
        };
        let SurfacePoint { point, normal, .. } = self.query(sweep.at(distance));
        (distance <= sweep.reach).then_some(SurfaceHit { distance, point, normal, from_outside: false })
    }

    fn facets(&self, _: &Bounds) -> Vec<Vec<Vec3>> {
        let half = 0.5 * self.start.distance(self.end);
        let axis = (self.end - self.start).try_normalize().unwrap_or(Vec3::Z);
        let quarter = ROUND / 4;
        let at = |k: usize| {
            let (sin, cos) = libm::sincosf((k % (quarter + 1)) as f32 * (std::f32::consts::TAU / ROUND as f32));
            match k {
                _ if k > quarter => {
                    (half + sin * self.radius, if k == 2 * quarter + 1 { 0.0 } else { cos * self.radius })
                }
                0 => (-half - self.radius, 0.0),
                _ => (-half - cos * self.radius, sin * self.radius),
            }
        };
        let mut line: Vec<(f32, f32)> = (0..2 * quarter + 2).map(at).collect();
        // a capsule of length 0 is a ball
        line.dedup_by(|a, b| (a.0 - b.0).abs().max((a.1 - b.1).abs()) <= 1e-6 * self.radius);
        turned(self.start.midpoint(self.end), axis, &line)
    }

    fn bounds(&self) -> Bounds {
        Bounds::around([self.start, self.end]).grown(self.radius)
    }
}
