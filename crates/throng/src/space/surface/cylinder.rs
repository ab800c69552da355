//! Cylinders with flat ends.

use super::extrude::extrude;
use super::facets::{self, turned};
use super::sweep::{finite, leave_ball, touch_convex};
use super::{Bounds, Surface, SurfaceHit, SurfacePoint, Sweep};
use crate::error::Error;
use glam::Vec3;

/// A solid cylinder with flat ends, of any orientation.
#[derive(Clone, Debug, PartialEq)]
pub struct Cylinder {
    center: Vec3,
    /// Unit vector.
    axis: Vec3,
    /// Half its length.
    half: f32,
    radius: f32,
}

impl Cylinder {
    /// Returns the cylinder between the centres of its ends, metres.
    ///
    /// # Errors
    /// [`Error::Limit`] if an end is not finite, or the radius or the length not greater than 0 and finite.
    pub fn new(start: Vec3, end: Vec3, radius: f32) -> Result<Self, Error> {
        finite("an end of a cylinder", start)?;
        finite("an end of a cylinder", end)?;
        Error::unless_positive("the radius of a cylinder", radius)?;
        let length = start.distance(end);
        Error::unless_positive("the length of a cylinder", length)?;
        Ok(Self { center: start.midpoint(end), axis: (end - start) / length, half: 0.5 * length, radius })
    }

    /// Returns the position of a point along the axis from the centre, and its offset across the axis.
    fn split(&self, point: Vec3) -> (f32, Vec3) {
        let offset = point - self.center;
        let along = offset.dot(self.axis);
        (along, offset - self.axis * along)
    }
}

impl Surface for Cylinder {
    fn query(&self, point: Vec3) -> SurfacePoint {
        let (along, across) = self.split(point);
        let out = across.normalize_or(self.axis.any_orthonormal_vector());
        let end = if along < 0.0 { -self.axis } else { self.axis };
        extrude(point, (across.length() - self.radius, out), (along.abs() - self.half, end))
    }

    fn sweep(&self, sweep: &Sweep) -> Option<SurfaceHit> {
        if !self.query(sweep.origin).is_inside() {
            return touch_convex(|p| self.query(p), sweep);
        }
        let (along, across) = self.split(sweep.origin);
        let speed = sweep.direction.dot(self.axis);
        let turned = sweep.direction - self.axis * speed;
        let sideways = turned.length();
        let room = (self.radius - sweep.radius).max(0.0);
        let to_side =
            if sideways > 0.0 { leave_ball(across, turned / sideways, room) / sideways } else { f32::INFINITY };
        let end = if speed < 0.0 { -self.axis } else { self.axis };
        let to_end = (self.half - sweep.radius - along * speed.signum()).max(0.0) / speed.abs();
        let distance = to_side.min(to_end);
        let at = sweep.at(distance);
        let (along, across) = self.split(at);
        let (normal, gap) = if to_end < to_side {
            (end, self.half - along.abs())
        } else {
            (across.normalize_or(turned / sideways), self.radius - across.length())
        };
        let point = at + normal * gap;
        (distance <= sweep.reach).then_some(SurfaceHit { distance, point, normal, from_outside: false })
    }

    fn facets(&self, within: &Bounds) -> Vec<Vec<Vec3>> {
        let (half, radius) = (self.half, self.radius);
        let line = [(-half, 0.0), (-half, radius), (half, radius), (half, 0.0)];
        let facets = turned(self.center, self.axis, &line).into_iter().map(|facet| facets::within(facet, within));
        facets.filter(|facet| facet.len() > 2).collect()
    }

    fn bounds(&self) -> Bounds {
        let across = (Vec3::ONE - self.axis * self.axis).max(Vec3::ZERO).map(f32::sqrt);
        let extent = self.axis.abs() * self.half + across * self.radius;
        Bounds { low: self.center - extent, high: self.center + extent }
    }
}
