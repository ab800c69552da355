//! The half-plane of ORCA.

use glam::Vec2;
use throng::avoid::{AvoidanceNeighbour, HalfPlane};

/// Returns the half-plane that a neighbour permits: the velocities on a line or to its left.
///
/// With `relative = velocity - other.velocity` and `w = relative - other.offset / horizon`, the nearest boundary of the
/// truncated cone is the disc round `offset / horizon` with the radius `radii / horizon`, or a leg. `u` is the smallest
/// change of `relative` to it. The line goes through `velocity + 0.5 * u`, and its direction is the outward normal, turned
/// to the right by a right angle.
pub fn half_plane(velocity: Vec2, other: &AvoidanceNeighbour, horizon: f32) -> HalfPlane {
    let _ = (velocity, other, horizon);
    todo!("return the line through velocity + u / 2")
}
