//! Distances of convex polygons, for checks, without functions of the library.

use glam::DVec2;

/// Distance of two convex polygons, points or segments from their sides; zero where they overlap.
pub fn apart(a: &[DVec2], b: &[DVec2]) -> f64 {
    let sides = |ring: &[DVec2]| {
        let next = ring.iter().cycle().skip(1).copied();
        ring.iter().copied().zip(next).take(ring.len()).collect::<Vec<_>>()
    };
    let inside = |ring: &[DVec2], p: DVec2| sides(ring).iter().all(|&(q, r)| (r - q).perp_dot(p - q) > 0.0);
    let to_segment = |p: DVec2, (q, r): (DVec2, DVec2)| {
        let t = ((p - q).dot(r - q) / (r - q).length_squared().max(1e-300)).clamp(0.0, 1.0);
        p.distance(q.lerp(r, t))
    };
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    if a.iter().any(|&p| inside(b, p)) || b.iter().any(|&p| inside(a, p)) {
        return 0.0;
    }
    let mut least = f64::INFINITY;
    for (p, q) in sides(a) {
        for (r, s) in sides(b) {
            if side(p, q, r) * side(p, q, s) < 0.0 && side(r, s, p) * side(r, s, q) < 0.0 {
                return 0.0;
            }
            let ends = [to_segment(p, (r, s)), to_segment(q, (r, s)), to_segment(r, (p, q)), to_segment(s, (p, q))];
            least = ends.into_iter().fold(least, f64::min);
        }
    }
    least
}
