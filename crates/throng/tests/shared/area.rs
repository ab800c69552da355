//! Areas of polygons.

use glam::DVec2;

/// Area inside rings with the ground to their left.
pub fn shoelace(rings: &[Vec<DVec2>]) -> f64 {
    rings
        .iter()
        .map(|ring| {
            let origin = ring[0];
            (0..ring.len()).map(|k| (ring[k] - origin).perp_dot(ring[(k + 1) % ring.len()] - origin)).sum::<f64>() * 0.5
        })
        .sum()
}
