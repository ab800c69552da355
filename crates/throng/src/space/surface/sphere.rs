//! Balls.

use super::facets::{ROUND, turned};
use super::sweep::{finite, leave_ball, touch_convex};
use super::{Bounds, Surface, SurfaceHit, SurfacePoint, Sweep};
use crate::error::Error;
use glam::Vec3;

/// A ball.
#[derive(Clone, Debug, PartialEq)]
pub struct Sphere {
    center: Vec3,
    radius: f32,
}

impl Sphere {
    /// Returns a ball around `center`, metres.
    ///
    /// # Errors
    /// [`Error::Limit`] if the centre is not finite or the radius not greater than 0 and finite.
    pub fn new(center: Vec3, radius: f32) -> Result<Self, Error> {
        finite("the centre of a sphere", center)?;
        Error::unless_positive("the radius of a sphere", radius)?;
        Ok(Self { center, radius })
    }
}

impl Surface for Sphere {
    fn query(&self, point: Vec3) -> SurfacePoint {
        let offset = point - self.center;
        let normal = offset.normalize_or(Vec3::X);
        SurfacePoint { point: self.center + normal * self.radius, normal, distance: offset.length() - self.radius }
    }

    fn sweep(&self, sweep: &Sweep) -> Option<SurfaceHit> {
        if !self.query(sweep.origin).is_inside() {
            return touch_convex(|p| self.query(p), sweep);
        }
        let room = (self.radius - sweep.radius).max(0.0);
        let distance = leave_ball(sweep.origin - self.center, sweep.direction, room);
        let SurfacePoint { point, normal, .. } = self.query(sweep.at(distance));
        (distance <= sweep.reach).then_some(SurfaceHit { distance, point, normal, from_outside: false })
    }

    fn facets(&self, _: &Bounds) -> Vec<Vec<Vec3>> {
        let at = |k: usize| {
            let (sin, cos) = libm::sincosf(k as f32 * (std::f32::consts::TAU / ROUND as f32));
            (-cos * self.radius, if k == 0 || 2 * k == ROUND { 0.0 } else { sin * self.radius })
        };
        turned(self.center, Vec3::Z, &(0..=ROUND / 2).map(at).collect::<Vec<_>>())
    }

    fn bounds(&self) -> Bounds {
        Bounds { low: self.center, high: self.center }.grown(self.radius)
    }
}
