//! Geometry of the view from a root through an interval, between its left and its right end, into the area behind it.

use super::locate::closest_convex;
use crate::space::nearest_on_segment;
use glam::DVec2;

/// Points nearer than this count as the same, metres.
pub(super) const SNAP: f64 = 1e-8;

/// A point this near to the edge of a view counts as on it, metres.
pub(super) const GRAZE: f64 = 1e-9;

/// A root with an interval visible from it. Seen from the root, `left` is on the left; the area ahead is to the left of
/// the line from `left` to `right`.
#[derive(Clone, Copy, Debug)]
pub(super) struct IntervalView {
    /// The last bend of the path.
    pub root: DVec2,
    /// Left end of the interval.
    pub left: DVec2,
    /// Right end of the interval.
    pub right: DVec2,
}

/// What is visible of the triangle behind an interval.
#[derive(Clone, Copy, Debug)]
pub(super) struct IntervalSuccessors {
    /// The signed distances of the corner ahead from the left and from the right edge of the view, positive to the
    /// left.
    pub sides: (f64, f64),
    /// Whether the corner ahead is visible.
    pub sees_corner: bool,
    /// The views through the edge to the left of that corner and through the edge to its right.
    pub through: [Option<IntervalView>; 2],
}

/// A path through an interval to a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct IntervalCrossing {
    /// Its length from the root.
    pub length: f64,
    /// The end of the interval at which the path bends, if it does.
    pub via: Option<DVec2>,
    /// The end of the path.
    pub end: DVec2,
}

impl IntervalView {
    /// Returns the signed distance of `point` from the ray from the root through `through`, positive to the left; zero
    /// if the root is at `through`.
    pub fn left_of(&self, through: DVec2, point: DVec2) -> f64 {
        let ray = through - self.root;
        let length = ray.length();
        if length < SNAP { 0.0 } else { ray.perp_dot(point - self.root) / length }
    }

    /// Returns what is visible of a triangle ahead that has the interval on its edge from `a` to `b`.
    pub fn ahead(&self, [a, b, c]: [DVec2; 3]) -> IntervalSuccessors {
        let sides = (self.left_of(self.left, c), self.left_of(self.right, c));
        let (shows_left, shows_right) = (sides.0 <= GRAZE, sides.0 > GRAZE || sides.1 >= -GRAZE);
        let sees_corner = shows_left && shows_right;
        let through_left = shows_left.then(|| IntervalView {
            left: if self.left == a { a } else { self.hit(self.left, a, c) },
            right: if sees_corner { c } else { self.hit(self.right, a, c) },
            ..*self
        });
        let through_right = shows_right.then(|| IntervalView {
            left: if sees_corner { c } else { self.hit(self.left, c, b) },
            right: if self.right == b { b } else { self.hit(self.right, c, b) },
            ..*self
        });
        IntervalSuccessors { sides, sees_corner, through: [through_left, through_right] }
    }

    /// Returns the part of the view between two directions, the right one first, that are less than a half turn apart.
    pub fn between(&self, [right, left]: [DVec2; 2]) -> Option<Self> {
        let (own_right, own_left) = (self.right - self.root, self.left - self.root);
        let within = |right: DVec2, left: DVec2, d: DVec2| right.perp_dot(d) >= 0.0 && d.perp_dot(left) >= 0.0;
        let end = |direction: DVec2, own: DVec2, own_end: DVec2| {
            if within(own_right, own_left, direction) {
                Some(self.hit(self.root + direction, self.left, self.right))
            } else {
                within(right, left, own).then_some(own_end)
            }
        };
        let (right, left) = (end(right, own_right, self.right)?, end(left, own_left, self.left)?);
        Some(Self { left, right, ..*self })
    }

    /// Whether a box is entirely outside the view, to one side of it.
    pub fn misses(&self, (low, high): (DVec2, DVec2)) -> bool {
        let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        let (right, left) = (self.right - self.root, self.left - self.root);
        let beside = |side: DVec2, sign: f64| corners.iter().all(|&at| side.perp_dot(at - self.root) * sign > GRAZE);
        beside(left, 1.0) || beside(right, -1.0)
    }

    /// Returns the straight path to `point` behind the interval, if the point is visible.
    pub fn straight(&self, point: DVec2) -> Option<IntervalCrossing> {
        let seen = self.left_of(self.left, point) <= GRAZE && self.left_of(self.right, point) >= -GRAZE;
        seen.then(|| IntervalCrossing { length: point.distance(self.root), via: None, end: point })
    }

    /// Returns the shortest path through the interval to `point` behind it.
    pub fn way(&self, point: DVec2) -> IntervalCrossing {
        let around = |via: DVec2| IntervalCrossing {
            length: via.distance(self.root) + via.distance(point),
            via: Some(via),
            end: point,
        };
        if (self.left - self.root).perp_dot(point - self.root) > 0.0 {
            around(self.left)
        } else if (self.right - self.root).perp_dot(point - self.root) < 0.0 {
            around(self.right)
        } else {
            IntervalCrossing { length: point.distance(self.root), via: None, end: point }
        }
    }

    /// Returns a lower bound of the lengths of paths through the interval to `point`, on either side of it.
    pub fn bound(&self, point: DVec2) -> f64 {
        let along = self.right - self.left;
        // a point on the root's side is mirrored to the area ahead, to the left of the line from `left` to `right`
        let side = along.perp_dot(point - self.left);
        let ahead = if side < 0.0 { point - along.perp() * (2.0 * side / along.length_squared()) } else { point };
        self.way(ahead).length
    }

    /// Returns the shortest straight path to a convex polygon behind the interval, if a part of the polygon is visible.
    pub fn straight_to(&self, polygon: &[DVec2], scratch: &mut [Vec<DVec2>; 2]) -> Option<IntervalCrossing> {
        let [first, second] = scratch;
        let seen = if self.left.distance_squared(self.root) < SNAP * SNAP
            || self.right.distance_squared(self.root) < SNAP * SNAP
        {
            // from an end of the interval everything behind it is visible
            polygon
        } else {
            clip(polygon, self.root, self.root - (self.left - self.root), first);
            clip(first, self.root, self.right, second);
            second
        };
        (!seen.is_empty()).then(|| {
            let end = closest_convex(seen, self.root);
            IntervalCrossing { length: end.distance(self.root), via: None, end }
        })
    }

    /// Returns the shortest path through the interval to a convex polygon behind it.
    pub fn way_to(&self, polygon: &[DVec2], scratch: &mut [Vec<DVec2>; 2]) -> Option<IntervalCrossing> {
        let around = [self.left, self.right].map(|via| {
            let end = closest_convex(polygon, via);
            IntervalCrossing { length: via.distance(self.root) + end.distance(via), via: Some(via), end }
        });
        let straight = self.straight_to(polygon, scratch);
        straight.into_iter().chain(around).min_by(|one, other| one.length.total_cmp(&other.length))
    }

    /// Returns a lower bound of the lengths of paths through the interval to a box.
    pub fn bound_to_box(&self, low: DVec2, high: DVec2) -> f64 {
        let straight = self.root.distance(self.root.clamp(low, high));
        let first = self.root.distance(nearest_on_segment(self.left, self.right, self.root));
        straight.max(first + segment_to_box(self.left, self.right, low, high))
    }

    /// Returns the intersection of the ray from the root through `through` with the edge from `left` to `right`.
    pub fn hit(&self, through: DVec2, left: DVec2, right: DVec2) -> DVec2 {
        let ray = through - self.root;
        let (before, after) = (ray.perp_dot(left - self.root), ray.perp_dot(right - self.root));
        let span = before - after;
        let part = if span > 0.0 { (before / span).clamp(0.0, 1.0) } else { 0.0 };
        let at = left + (right - left) * part;
        if at.distance_squared(left) < SNAP * SNAP {
            left
        } else if at.distance_squared(right) < SNAP * SNAP {
            right
        } else {
            at
        }
    }
}

/// Computes the part of a convex polygon to the left of the line from `from` to `to`.
pub(super) fn clip(polygon: &[DVec2], from: DVec2, to: DVec2, out: &mut Vec<DVec2>) {
    out.clear();
    let along = to - from;
    for (at, &a) in polygon.iter().enumerate() {
        let b = polygon[(at + 1) % polygon.len()];
        let (here, next) = (along.perp_dot(a - from), along.perp_dot(b - from));
        if here >= 0.0 {
            out.push(a);
        }
        if here < 0.0 && next > 0.0 || here > 0.0 && next < 0.0 {
            out.push(a + (b - a) * (here / (here - next)));
        }
    }
}

/// Returns the distance between a segment and a box.
pub(super) fn segment_to_box(a: DVec2, b: DVec2, low: DVec2, high: DVec2) -> f64 {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let (start, along) = (a[axis], b[axis] - a[axis]);
        if along == 0.0 {
            if start < low[axis] || start > high[axis] {
                to = -1.0;
            }
        } else {
            let (one, other) = ((low[axis] - start) / along, (high[axis] - start) / along);
            from = from.max(one.min(other));
            to = to.min(one.max(other));
        }
    }
    if from <= to {
        return 0.0;
    }
    let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    let ends = a.distance(a.clamp(low, high)).min(b.distance(b.clamp(low, high)));
    corners.iter().fold(ends, |least, &corner| least.min(corner.distance(nearest_on_segment(a, b, corner))))
}
