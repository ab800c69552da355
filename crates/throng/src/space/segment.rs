//! Crossings of segments.

use glam::DVec2;

/// Returns the point at which the segments `a b` and `c d` cross properly; `None` if they only touch.
///
/// ```
/// use glam::DVec2;
/// use throng::space::crossing;
/// let [a, b] = [DVec2::new(-1.0, 0.0), DVec2::new(3.0, 0.0)];
/// assert_eq!(crossing(a, b, DVec2::new(1.0, -1.0), DVec2::new(1.0, 1.0)), Some(DVec2::X));
/// assert_eq!(crossing(a, b, DVec2::ZERO, DVec2::Y), None);
/// ```
pub fn crossing(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> Option<DVec2> {
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    let (c_side, d_side) = (side(a, b, c), side(a, b, d));
    let crosses = c_side * d_side < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
    crosses.then(|| c + (d - c) * (c_side / (c_side - d_side)))
}

/// Whether a step from `a` to `b` crosses the line between two points. A point on the line counts as on its left side, so
/// a path that touches the line in between two steps is counted once.
///
/// ```
/// use glam::DVec2;
/// use throng::space::crosses_line;
/// let line = [DVec2::NEG_Y, DVec2::Y];
/// let [before, on, after] = [DVec2::NEG_X, DVec2::ZERO, DVec2::X];
/// assert!(crosses_line(before, after, line) && crosses_line(after, before, line));
/// assert!(crosses_line(before, on, line) != crosses_line(on, after, line));
/// assert!(!crosses_line(before + DVec2::Y * 2.0, after + DVec2::Y * 2.0, line));
/// ```
pub fn crosses_line(a: DVec2, b: DVec2, [from, to]: [DVec2; 2]) -> bool {
    let side = |p: DVec2| (to - from).perp_dot(p - from);
    let (before, after) = (side(a), side(b));
    if (before < 0.0) == (after < 0.0) {
        return false;
    }
    let at = a + (b - a) * (before / (before - after));
    let along = (at - from).dot(to - from);
    (0.0..=(to - from).length_squared()).contains(&along)
}
