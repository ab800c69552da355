//! Balls that move along a straight line until they touch something.

use super::{SurfaceHit, SurfacePoint};
use crate::error::Error;
use glam::Vec3;

/// A ball that moves along a straight line; without radius, a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    /// Where its centre starts, metres.
    pub origin: Vec3,
    /// Unit vector along which it moves.
    pub direction: Vec3,
    /// Its radius, metres. Limit: >= 0.
    pub radius: f32,
    /// How far it goes, metres. Limit: >= 0; may be infinite.
    pub reach: f32,
}

impl Sweep {
    /// Where its centre is after so many metres.
    pub fn at(&self, distance: f32) -> Vec3 {
        self.origin + self.direction * distance
    }

    /// The same as far as `reach` only.
    pub fn until(self, reach: f32) -> Self {
        Self { reach, ..self }
    }
}

/// Newton's method needs a handful of steps; where the ball grazes something round it halves the rest with each.
const STEPS: usize = 64;

/// Where a ball first touches a convex set, given by its signed distance, or by its distance if it has no inside.
///
/// Along a line that distance is a convex function: Newton's method from the start never goes too far, and ends in a
/// few steps. A ball that touches at the start and moves away never touches again.
pub(super) fn touch_convex(query: impl Fn(Vec3) -> SurfacePoint, sweep: &Sweep) -> Option<SurfaceHit> {
    let mut distance = 0.0;
    for _ in 0..STEPS {
        let at = sweep.at(distance);
        let near = query(at);
        let gap = near.distance - sweep.radius;
        let closing = -near.normal.dot(sweep.direction);
        let touches = gap <= rounding(at).max(rounding(sweep.origin));
        // rounding may have carried it across a sheet, which then shows its other side
        let crossed = touches && distance > 0.0;
        if closing <= 0.0 && !crossed {
            return None;
        }
        if touches {
            let normal = if closing < 0.0 { -near.normal } else { near.normal };
            return Some(SurfaceHit { distance, point: near.point, normal, from_outside: true });
        }
        distance += gap / closing;
        if distance.is_nan() || distance > sweep.reach {
            return None;
        }
    }
    None
}

/// How far a computed point may be from where it should be.
pub(crate) fn rounding(at: Vec3) -> f32 {
    1e-6 * (1.0 + at.abs().max_element())
}

/// How far a point at `offset` from the centre of a ball of this radius goes along a unit vector until it leaves the
/// ball. Outside it, 0 if it moves away; if it does not go through the ball, as far as where it moves away.
pub(super) fn leave_ball(offset: Vec3, direction: Vec3, radius: f32) -> f32 {
    let along = offset.dot(direction);
    let beside = (offset - direction * along).length_squared();
    ((radius * radius - beside).max(0.0).sqrt() - along).max(0.0)
}

/// Checks that a point of a surface is finite.
pub(super) fn finite(what: &'static str, point: Vec3) -> Result<(), Error> {
    point.to_array().into_iter().try_for_each(|x| Error::unless_finite(what, x.into()))
}
