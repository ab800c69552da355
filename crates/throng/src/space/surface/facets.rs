//! Surfaces as flat polygons, for drawing.

use super::Bounds;
use glam::Vec3;

/// Number of facets around the axis of a round surface.
pub(super) const ROUND: usize = 24;

/// Returns the facets of a surface of revolution. `line` is the profile from one pole to the other: points given by the
/// position along the axis and the distance from it. Facets are counter-clockwise seen from outside.
pub(super) fn turned(center: Vec3, axis: Vec3, line: &[(f32, f32)]) -> Vec<Vec<Vec3>> {
    let (right, up) = axis.any_orthonormal_pair();
    let at = |(along, out): (f32, f32), k: usize| {
        let (sin, cos) = libm::sincosf((k % ROUND) as f32 * (std::f32::consts::TAU / ROUND as f32));
        center + axis * along + (right * cos + up * sin) * out
    };
    let ring = |ends: [(f32, f32); 2], k: usize| {
        let mut facet = vec![at(ends[0], k), at(ends[0], k + 1), at(ends[1], k + 1), at(ends[1], k)];
        // at a pole the facet is a triangle
        facet.dedup();
        facet
    };
    line.windows(2).flat_map(|ends| (0..ROUND).map(move |k| ring([ends[0], ends[1]], k))).collect()
}

/// Returns the part of a polygon inside a box (Sutherland and Hodgman, *Reentrant polygon clipping*, 1974).
pub(super) fn within(mut polygon: Vec<Vec3>, bounds: &Bounds) -> Vec<Vec3> {
    for axis in 0..3 {
        for (sign, limit) in [(1.0, bounds.low[axis]), (-1.0, bounds.high[axis])] {
            let inside = |p: Vec3| (p[axis] - limit) * sign;
            let corners = std::mem::take(&mut polygon);
            for (i, &to) in corners.iter().enumerate() {
                let from = corners[(i + corners.len() - 1) % corners.len()];
                let (a, b) = (inside(from), inside(to));
                if (a < 0.0) != (b < 0.0) {
                    polygon.push(from.lerp(to, a / (a - b)));
                }
                if b >= 0.0 {
                    polygon.push(to);
                }
            }
        }
    }
    polygon
}
