//! Approximates curves by lines, within a tolerance.

use crate::geometry::DVec2;
use std::f64::consts::TAU;

/// The default tolerance: lines deviate from their curves by no more than this, metres.
pub(super) const TOLERANCE: f64 = 0.01;

/// The maximum number of lines of a curve: very large curves are coarser.
const MOST: f64 = 1024.0;

/// Returns points of an arc of an ellipse with the half axes `a` and `b`, from one angle to another, both ends
/// included. The angles are radians from `a` towards `b`.
pub(super) fn arc(center: DVec2, [a, b]: [DVec2; 2], [from, to]: [f64; 2], tolerance: f64) -> Vec<DVec2> {
    let radius = a.length().max(b.length());
    // a chord over an angle lies r (1 - cos(angle / 2)) inside the circle
    let chord = 2.0 * libm::acos((1.0 - tolerance / radius).clamp(-1.0, 1.0));
    let lines = ((to - from).abs() / chord).ceil().clamp(8.0 * (to - from).abs() / TAU, MOST).max(1.0);
    let point = |k: u32| {
        let (sin, cos) = libm::sincos(from + (to - from) * f64::from(k) / lines.ceil());
        center + a * cos + b * sin
    };
    (0..=lines.ceil() as u32).map(point).collect()
}

/// Returns the arc between two points, without the first point. It deviates from the line to the right by `bulge` times
/// half the line's length. As in DXF, `bulge` is the tangent of a quarter of the arc's angle.
fn bulge(from: DVec2, to: DVec2, bulge: f64, tolerance: f64) -> Vec<DVec2> {
    let half = (to - from) * 0.5;
    if bulge.abs() < 1e-9 || half.length_squared() == 0.0 {
        return vec![to];
    }
    let center = from + half + half.perp() * ((1.0 - bulge * bulge) / (2.0 * bulge));
    let a = from - center;
    let mut points = arc(center, [a, a.perp()], [0.0, 4.0 * libm::atan(bulge)], tolerance);
    points.remove(0);
    points.pop();
    points.push(to);
    points
}

/// Returns the points of a polyline of corners, each with the bulge of the line after it.
pub(super) fn bulged(corners: &[(DVec2, f64)], closed: bool, tolerance: f64) -> Vec<DVec2> {
    let mut points: Vec<DVec2> = corners.first().map(|(at, _)| *at).into_iter().collect();
    let next = corners.iter().skip(1).chain(corners.first().filter(|_| closed));
    for ((from, bent), (to, _)) in corners.iter().zip(next) {
        points.extend(bulge(*from, *to, *bent, tolerance));
    }
    if closed && points.len() > 1 {
        points.pop();
    }
    points
}

/// Returns a cubic Bézier curve, without its first point.
pub(super) fn cubic([a, b, c, d]: [DVec2; 4], tolerance: f64) -> Vec<DVec2> {
    // the second derivative is at most six times the larger second difference
    let bend = (a - 2.0 * b + c).length().max((b - 2.0 * c + d).length());
    let lines = (0.75 * bend / tolerance).sqrt().ceil().clamp(1.0, MOST);
    let point = |k: u32| {
        let t = f64::from(k) / lines;
        let s = 1.0 - t;
        a * (s * s * s) + b * (3.0 * s * s * t) + c * (3.0 * s * t * t) + d * (t * t * t)
    };
    (1..=lines as u32).map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the greatest deviation of the lines' midpoints from a circle about the origin.
    fn off(points: &[DVec2], radius: f64) -> f64 {
        points.windows(2).map(|ends| (ends[0].midpoint(ends[1]).length() - radius).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn arcs_stay_within_the_tolerance() {
        for radius in [0.02, 0.3, 5.0, 400.0] {
            let axes = [DVec2::X * radius, DVec2::Y * radius];
            let whole = arc(DVec2::ZERO, axes, [0.0, TAU], TOLERANCE);
            assert!(off(&whole, radius) <= TOLERANCE * 1.0001 && whole.len() >= 9, "{radius}: {}", off(&whole, radius));
        }
        // an excessively large circle has a bounded number of lines
        let axes = [DVec2::X * 1e12, DVec2::Y * 1e12];
        assert_eq!(arc(DVec2::ZERO, axes, [0.0, TAU], TOLERANCE).len(), 1025);
    }

    #[test]
    fn a_bulge_of_one_is_half_a_circle() {
        let points = bulge(DVec2::new(1.0, 0.0), DVec2::new(-1.0, 0.0), 1.0, 1e-4);
        assert_eq!(points.last(), Some(&DVec2::new(-1.0, 0.0)));
        assert!(points.iter().all(|p| (p.length() - 1.0).abs() < 1e-9 && p.y > -1e-9));
        assert_eq!(bulge(DVec2::ZERO, DVec2::X, 0.0, 0.1), [DVec2::X]);
    }

    #[test]
    fn cubics_stay_within_the_tolerance() {
        let k = 0.551_915_024_494;
        let quarter = [DVec2::X, DVec2::new(1.0, k), DVec2::new(k, 1.0), DVec2::Y].map(|p| p * 30.0);
        let points = cubic(quarter, TOLERANCE);
        // the curve itself deviates from the circle by 2e-4 of the radius
        assert!(off(&points, 30.0) < TOLERANCE + 30.0 * 2e-4);
        assert!(points.len() < 60);
    }
}
