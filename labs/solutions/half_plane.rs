//! The half-plane of ORCA, solved.

use glam::Vec2;
use throng::avoid::{AvoidanceNeighbour, HalfPlane};

/// Returns the half-plane that a neighbour permits: the velocities on a line or to its left.
///
/// With `relative = velocity - other.velocity` and `w = relative - other.offset / horizon`, the nearest boundary of the
/// truncated cone is the disc round `offset / horizon` with the radius `radii / horizon`, or a leg. `u` is the smallest
/// change of `relative` to it. The line goes through `velocity + 0.5 * u`, and its direction is the outward normal, turned
/// to the right by a right angle.
pub fn half_plane(velocity: Vec2, other: &AvoidanceNeighbour, horizon: f32) -> HalfPlane {
    let relative = velocity - other.velocity;
    let from_disc = relative - other.offset / horizon;
    let behind = from_disc.dot(other.offset);
    // the disc is nearer than the legs between the tangents to it from the origin
    if behind < 0.0 && behind * behind > other.radii * other.radii * from_disc.length_squared() {
        let normal = from_disc.normalize();
        let u = normal * (other.radii / horizon - from_disc.length());
        return HalfPlane { point: velocity + 0.5 * u, direction: Vec2::new(normal.y, -normal.x) };
    }
    let leg = (other.offset.length_squared() - other.radii * other.radii).sqrt();
    let left = other.offset.perp_dot(from_disc) > 0.0;
    let turn = Vec2::new(leg, if left { other.radii } else { -other.radii }) / other.offset.length_squared();
    let along = turn.rotate(other.offset);
    let direction = if left { along } else { -along };
    let u = direction * relative.dot(direction) - relative;
    HalfPlane { point: velocity + 0.5 * u, direction }
}
