//! Extruded solids: the distance follows from the distances to the side and to the ends.

use super::SurfacePoint;
use glam::Vec3;

/// Returns the nearest point of an extruded solid to `p`, from two parts, each a signed distance and the unit vector
/// along which it grows: to the side (across the axis) and to the nearer end (along the axis). Inside, the nearer of
/// them counts; outside, both (Quilez, *Distance functions*, "extrusion").
pub(super) fn extrude(p: Vec3, side: (f32, Vec3), end: (f32, Vec3)) -> SurfacePoint {
    let (distance, normal) = if side.0 > 0.0 && end.0 > 0.0 {
        let offset = side.1 * side.0 + end.1 * end.0;
        (offset.length(), offset.normalize_or(side.1))
    } else if side.0 > end.0 {
        side
    } else {
        end
    };
    SurfacePoint { point: p - normal * distance, normal, distance }
}
