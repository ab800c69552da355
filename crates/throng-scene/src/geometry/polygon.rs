//! Polygons: lists of corners; the first corner is not repeated.

use crate::scene::{Point, Rectangle, Region};
use glam::DVec2;

/// The number of corners of a polygon that stands for a disc.
const DISC_CORNERS: usize = 32;

/// Returns the corners as vectors. A repeated first corner is dropped.
pub(crate) fn points(corners: &[Point]) -> Vec<DVec2> {
    let mut out: Vec<DVec2> = corners.iter().map(|p| DVec2::from_array(*p)).collect();
    if out.len() > 1 && out.first() == out.last() {
        out.pop();
    }
    out
}

/// Returns the corners of a rectangle, counter-clockwise.
pub(crate) fn rectangle(rectangle: &Rectangle) -> Vec<DVec2> {
    let (sin, cos) = libm::sincos(rectangle.rotation.to_radians());
    let (sin, cos) = if rectangle.rotation == 0.0 { (0.0, 1.0) } else { (sin, cos) };
    let [x, y] = rectangle.size.map(|side| side * 0.5);
    let center = DVec2::from_array(rectangle.center);
    [(-x, -y), (x, -y), (x, y), (-x, y)].map(|(x, y)| center + DVec2::new(cos * x - sin * y, sin * x + cos * y)).into()
}

/// Returns the corners of a region.
pub(crate) fn outline_of_region(region: &Region) -> Vec<DVec2> {
    match region {
        Region::Rectangle(r) => rectangle(r),
        Region::Polygon(corners) => points(corners),
        Region::Disc(disc) => {
            let corner = |i: usize| {
                let (sin, cos) = libm::sincos(std::f64::consts::TAU * i as f64 / DISC_CORNERS as f64);
                DVec2::from_array(disc.center) + disc.radius * DVec2::new(cos, sin)
            };
            (0..DISC_CORNERS).map(corner).collect()
        }
    }
}

/// Returns the least and the greatest coordinates, if there is a point.
pub(crate) fn bounds(points: impl IntoIterator<Item = DVec2>) -> Option<[DVec2; 2]> {
    points.into_iter().fold(None, |box_, p| match box_ {
        None => Some([p, p]),
        Some([low, high]) => Some([low.min(p), high.max(p)]),
    })
}

/// Returns the area, positive if the corners go counter-clockwise.
pub(crate) fn signed_area(corners: &[DVec2]) -> f64 {
    let Some(&first) = corners.first() else { return 0.0 };
    edges(corners).map(|(a, b)| (a - first).perp_dot(b - first)).sum::<f64>() * 0.5
}

/// Whether a point is inside (even-odd rule).
pub(crate) fn contains(corners: &[DVec2], p: DVec2) -> bool {
    edges(corners).filter(|(a, b)| crosses_ray(*a, *b, p)).count() % 2 == 1
}

/// Whether the edge crosses the ray from `p` towards +x.
pub(super) fn crosses_ray(a: DVec2, b: DVec2, p: DVec2) -> bool {
    (a.y > p.y) != (b.y > p.y) && {
        let side = (b - a).perp_dot(p - a);
        if b.y > a.y { side > 0.0 } else { side < 0.0 }
    }
}

/// Returns the edges of a closed polygon.
pub(crate) fn edges(corners: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| (*a, *b))
}

/// Returns the distance from a point to a segment.
pub(crate) fn distance_to_segment(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let length = along.length_squared();
    let t = if length > 0.0 { ((p - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    p.distance(a + t * along)
}

/// Returns where two edges of a polygon cross, and the indices of the edges, if any do. Edges that only touch do not
/// cross.
///
/// Sweeps over x: quadratic only if many edges share an x range.
pub(crate) fn crossing(corners: &[DVec2]) -> Option<(DVec2, usize, usize)> {
    let edges: Vec<_> = edges(corners).collect();
    let mut order: Vec<usize> = (0..edges.len()).collect();
    let left = |i: usize| edges[i].0.x.min(edges[i].1.x);
    order.sort_by(|i, j| left(*i).total_cmp(&left(*j)).then(i.cmp(j)));
    let mut active: Vec<usize> = vec![];
    for i in order {
        let (a, b) = edges[i];
        active.retain(|j| edges[*j].0.x.max(edges[*j].1.x) >= left(i));
        for &j in &active {
            let (c, d) = edges[j];
            if let Some(at) = properly_cross(a, b, c, d) {
                return Some((at, i.min(j), i.max(j)));
            }
        }
        active.push(i);
    }
    None
}

fn properly_cross(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> Option<DVec2> {
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    let (c_side, d_side) = (side(a, b, c), side(a, b, d));
    let (a_side, b_side) = (side(c, d, a), side(c, d, b));
    // Edges within a billionth of the lengths touch: rounding must not make that a crossing.
    let eps = 1e-9 * (b - a).length() * (d - c).length();
    let apart = |x: f64, y: f64| (x > eps && y < -eps) || (x < -eps && y > eps);
    (apart(c_side, d_side) && apart(a_side, b_side)).then(|| c + (d - c) * (c_side / (c_side - d_side)))
}

/// Returns a convex polygon with each edge moved outwards by `by`; for other polygons, the grown bounding box.
pub(crate) fn grown(corners: &[DVec2], by: f64) -> Vec<DVec2> {
    let n = corners.len();
    let sign = signed_area(corners).signum();
    let turn = |i: usize| {
        let (a, b, c) = (corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]);
        (b - a).normalize_or_zero().perp_dot((c - b).normalize_or_zero()) * sign
    };
    if n < 3 || (0..n).any(|i| turn(i) < 0.05) {
        let Some([low, high]) = bounds(corners.iter().copied()) else { return vec![] };
        let (low, high) = (low - by, high + by);
        return vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    }
    (0..n)
        .map(|i| {
            let (a, b, c) = (corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]);
            let outwards = |from: DVec2, to: DVec2| -sign * (to - from).normalize_or_zero().perp();
            let (m, k) = (outwards(a, b), outwards(b, c));
            b + by * (m + k) / (1.0 + m.dot(k))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Vec<DVec2> {
        points(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [0.0, 0.0]])
    }

    #[test]
    fn a_square_is_what_it_is() {
        assert_eq!(square().len(), 4);
        assert_eq!(signed_area(&square()), 4.0);
        assert!(contains(&square(), DVec2::ONE) && !contains(&square(), DVec2::new(3.0, 1.0)));
        assert_eq!(crossing(&square()), None);
        assert_eq!(distance_to_segment(DVec2::new(1.0, 3.0), DVec2::ZERO, DVec2::X), 3.0);
    }

    #[test]
    fn a_bow_tie_crosses_itself_in_the_middle() {
        let tie = points(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]]);
        assert_eq!(crossing(&tie), Some((DVec2::ONE, 0, 2)));
    }

    #[test]
    fn a_polygon_that_touches_itself_is_fine() {
        let eight = points(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.0], [0.0, 2.0]]);
        assert_eq!(crossing(&eight), None);
    }

    #[test]
    fn a_square_grows_on_all_sides() {
        let reversed: Vec<DVec2> = square().into_iter().rev().collect();
        for corners in [square(), reversed] {
            let grown = grown(&corners, 0.5);
            assert_eq!(bounds(grown.iter().copied()), Some([DVec2::splat(-0.5), DVec2::splat(2.5)]));
        }
    }
}
