//! Half-spaces.

use super::facets;
use super::sweep::finite;
use super::{Bounds, Surface, SurfaceHit, SurfacePoint, Sweep};
use crate::error::Error;
use glam::Vec3;

/// The half-space behind a plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    through: Vec3,
    normal: Vec3,
}

impl Plane {
    /// Returns the half-space behind the plane through a point, metres. `normal` points out of it and may have any
    /// length.
    ///
    /// # Errors
    /// [`Error::Limit`] if the point is not finite, or the normal is not finite or has length zero.
    pub fn new(through: Vec3, normal: Vec3) -> Result<Self, Error> {
        finite("a point of a plane", through)?;
        let length = normal.length();
        Error::unless_positive("the length of the normal of a plane", length)?;
        Ok(Self { through, normal: normal / length })
    }
}

impl Surface for Plane {
    fn query(&self, point: Vec3) -> SurfacePoint {
        let distance = (point - self.through).dot(self.normal);
        SurfacePoint { point: point - self.normal * distance, normal: self.normal, distance }
    }

    fn sweep(&self, sweep: &Sweep) -> Option<SurfaceHit> {
        let start = self.query(sweep.origin);
        let from_outside = !start.is_inside();
        let speed = sweep.direction.dot(self.normal);
        let (gap, closing) = if from_outside { (start.distance, -speed) } else { (-start.distance, speed) };
        if closing <= 0.0 {
            return None;
        }
        let distance = (gap - sweep.radius).max(0.0) / closing;
        let point = self.query(sweep.at(distance)).point;
        (distance <= sweep.reach).then_some(SurfaceHit { distance, point, normal: self.normal, from_outside })
    }

    fn facets(&self, within: &Bounds) -> Vec<Vec<Vec3>> {
        let (right, up) = self.normal.any_orthonormal_pair();
        // a square larger than the box, around the point nearest to the box's centre
        let middle = self.query(within.center()).point;
        let reach = within.center().distance(within.high) + self.query(within.center()).distance.abs();
        let corner = |(x, y): (f32, f32)| middle + (right * x + up * y) * reach;
        let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(corner);
        let facet = facets::within(square.to_vec(), within);
        if facet.len() > 2 { vec![facet] } else { Vec::new() }
    }

    fn bounds(&self) -> Bounds {
        let mut bounds = Bounds::EVERYWHERE;
        // a plane orthogonal to an axis bounds the half-space on one side
        for axis in 0..3 {
            if self.normal[axis] == 1.0 {
                bounds.high[axis] = self.through[axis];
            } else if self.normal[axis] == -1.0 {
                bounds.low[axis] = self.through[axis];
            }
        }
        bounds
    }
}
