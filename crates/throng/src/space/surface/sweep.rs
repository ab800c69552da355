//! Contacts of balls that move along a straight line.

use super::{SurfaceHit, SurfacePoint};
use crate::error::Error;
use glam::Vec3;

/// A ball that moves along a straight line; with radius 0, a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    /// Start of the centre, metres.
    pub origin: Vec3,
    /// Unit vector along which it moves.
    pub direction: Vec3,
    /// Its radius, metres. Limit: >= 0.
    pub radius: f32,
    /// Length of the motion, metres. Limit: >= 0; may be infinite.
    pub reach: f32,
}

impl Sweep {
    /// Returns the position of the centre after `distance` metres.
    pub fn at(&self, distance: f32) -> Vec3 {
        self.origin + self.direction * distance
    }

    /// Returns the same sweep with another reach.
    pub fn until(self, reach: f32) -> Self {
        Self { reach, ..self }
    }
}

/// Maximum number of steps of Newton's method. It usually needs a few. Where the ball grazes a round surface each step
/// halves the remaining distance.
const STEPS: usize = 64;

/// Returns the first contact of a ball with a convex set, given by its signed distance, or by its distance if it has no
/// inside.
///
/// Along a line that distance is a convex function, so Newton's method from the start never overshoots and converges in
/// a few steps. A ball that touches at the start and moves away never touches again.
pub(super) fn touch_convex(query: impl Fn(Vec3) -> SurfacePoint, sweep: &Sweep) -> Option<SurfaceHit> {
    let mut distance = 0.0;
    for _ in 0..STEPS {
        let at = sweep.at(distance);
        let near = query(at);
        let gap = near.distance - sweep.radius;
        let closing = -near.normal.dot(sweep.direction);
        let touches = gap <= rounding(at).max(rounding(sweep.origin));
        // rounding may have moved the ball across a sheet, which then has its other side in front
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

/// Returns an upper bound of the rounding error of a computed point.
pub(crate) fn rounding(at: Vec3) -> f32 {
    1e-6 * (1.0 + at.abs().max_element())
}

/// Returns how far a point at `offset` from the centre of a ball of this radius moves along a unit vector until it
/// leaves the ball. For a point outside that moves away the result is 0. For a line that misses the ball it is the
/// distance to the point of the line nearest to the centre.
pub(super) fn leave_ball(offset: Vec3, direction: Vec3, radius: f32) -> f32 {
    let along = offset.dot(direction);
    let beside = (offset - direction * along).length_squared();
    ((radius * radius - beside).max(0.0).sqrt() - along).max(0.0)
}

/// Checks that a point of a surface is finite.
pub(super) fn finite(what: &'static str, point: Vec3) -> Result<(), Error> {
    point.to_array().into_iter().try_for_each(|x| Error::unless_finite(what, x.into()))
}
