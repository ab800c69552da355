//! Geometry of a view through an interval: from a root, between a left and a right end, into what is behind.

use super::locate::closest_convex;
use crate::space::nearest_on_segment;
use glam::DVec2;

/// Points nearer than this are one, metres.
pub(super) const SNAP: f64 = 1e-8;

/// A point this near to the edge of a view counts as on it, metres.
pub(super) const GRAZE: f64 = 1e-9;

/// A root that sees an interval. Looking ahead from the root, `left` is on the left; what is ahead lies to the left of
/// the line from `left` to `right`.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    /// Where the path bends last.
    pub root: DVec2,
    /// Left end of the interval.
    pub left: DVec2,
    /// Right end of the interval.
    pub right: DVec2,
}

/// What a view shows of the triangle behind its interval.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ahead {
    /// How far the corner ahead lies to the left of the left edge of the view, and of its right edge.
    pub sides: (f64, f64),
    /// Whether the corner ahead is in sight.
    pub sees_corner: bool,
    /// What is in sight through the edge to the left of that corner, and through the edge to its right.
    pub through: [Option<View>; 2],
}

/// A way through an interval to a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// Its length from the root.
    pub length: f64,
    /// The end of the interval that it bends at, if it does.
    pub via: Option<DVec2>,
    /// Where it ends.
    pub end: DVec2,
}

impl View {
    /// How far `point` lies to the left of the ray from the root through `through`; zero for a root at `through`.
    pub fn left_of(&self, through: DVec2, point: DVec2) -> f64 {
        let ray = through - self.root;
        let length = ray.length();
        if length < SNAP { 0.0 } else { ray.perp_dot(point - self.root) / length }
    }

    /// What is in sight of a triangle ahead, whose edge from `a` to `b` holds the interval.
    pub fn ahead(&self, [a, b, c]: [DVec2; 3]) -> Ahead {
        let sides = (self.left_of(self.left, c), self.left_of(self.right, c));
        let (shows_left, shows_right) = (sides.0 <= GRAZE, sides.0 > GRAZE || sides.1 >= -GRAZE);
        let sees_corner = shows_left && shows_right;
        let through_left = shows_left.then(|| View {
            left: if self.left == a { a } else { self.hit(self.left, a, c) },
            right: if sees_corner { c } else { self.hit(self.right, a, c) },
            ..*self
        });
        let through_right = shows_right.then(|| View {
            left: if sees_corner { c } else { self.hit(self.left, c, b) },
            right: if self.right == b { b } else { self.hit(self.right, c, b) },
            ..*self
        });
        Ahead { sides, sees_corner, through: [through_left, through_right] }
    }

    /// The part of the view between two directions, the right one first, that are less than a half turn apart.
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

    /// Whether all of a box is out of the view, to one side of it.
    pub fn misses(&self, (low, high): (DVec2, DVec2)) -> bool {
        let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        let (right, left) = (self.right - self.root, self.left - self.root);
        let beside = |side: DVec2, sign: f64| corners.iter().all(|&at| side.perp_dot(at - self.root) * sign > GRAZE);
        beside(left, 1.0) || beside(right, -1.0)
    }

    /// The straight way to `point` behind the interval, if it is in sight.
    pub fn straight(&self, point: DVec2) -> Option<Way> {
        let seen = self.left_of(self.left, point) <= GRAZE && self.left_of(self.right, point) >= -GRAZE;
        seen.then(|| Way { length: point.distance(self.root), via: None, end: point })
    }

    /// The shortest way through the interval to `point` behind it.
    pub fn way(&self, point: DVec2) -> Way {
        let around =
            |via: DVec2| Way { length: via.distance(self.root) + via.distance(point), via: Some(via), end: point };
        if (self.left - self.root).perp_dot(point - self.root) > 0.0 {
            around(self.left)
        } else if (self.right - self.root).perp_dot(point - self.root) < 0.0 {
            around(self.right)
        } else {
            Way { length: point.distance(self.root), via: None, end: point }
        }
    }

    /// A lower bound for ways through the interval to `point`, wherever it lies.
    pub fn bound(&self, point: DVec2) -> f64 {
        let along = self.right - self.left;
        // What is ahead lies to the left of left-to-right; a point on the root's side is mirrored to there.
        let side = along.perp_dot(point - self.left);
        let ahead = if side < 0.0 { point - along.perp() * (2.0 * side / along.length_squared()) } else { point };
        self.way(ahead).length
    }

    /// The shortest straight way to a convex polygon behind the interval, if some of it is in sight.
    pub fn straight_to(&self, polygon: &[DVec2], scratch: &mut [Vec<DVec2>; 2]) -> Option<Way> {
        let [first, second] = scratch;
        let seen = if self.left.distance_squared(self.root) < SNAP * SNAP
            || self.right.distance_squared(self.root) < SNAP * SNAP
        {
            // From an end of the interval, everything behind it is in view.
            polygon
        } else {
            clip(polygon, self.root, self.root - (self.left - self.root), first);
            clip(first, self.root, self.right, second);
            second
        };
        (!seen.is_empty()).then(|| {
            let end = closest_convex(seen, self.root);
            Way { length: end.distance(self.root), via: None, end }
        })
    }

    /// The shortest way through the interval to a convex polygon behind it.
    pub fn way_to(&self, polygon: &[DVec2], scratch: &mut [Vec<DVec2>; 2]) -> Option<Way> {
        let around = [self.left, self.right].map(|via| {
            let end = closest_convex(polygon, via);
            Way { length: via.distance(self.root) + end.distance(via), via: Some(via), end }
        });
        let straight = self.straight_to(polygon, scratch);
        straight.into_iter().chain(around).min_by(|one, other| one.length.total_cmp(&other.length))
    }

    /// A lower bound for ways through the interval to a box.
    pub fn bound_to_box(&self, low: DVec2, high: DVec2) -> f64 {
        let straight = self.root.distance(self.root.clamp(low, high));
        let first = self.root.distance(nearest_on_segment(self.left, self.right, self.root));
        straight.max(first + segment_to_box(self.left, self.right, low, high))
    }

    /// Where the ray from the root through `through` meets the edge from `left` to `right`.
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

/// The part of a convex polygon to the left of the line from `from` to `to`.
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

/// Distance between a segment and a box.
fn segment_to_box(a: DVec2, b: DVec2, low: DVec2, high: DVec2) -> f64 {
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
