//! Regions of forbidden velocities, and the pieces of lines and circles that bound them.

use super::{AvoidanceNeighbour, HalfPlane};
use glam::Vec2;

/// A region of forbidden velocities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Forbidden {
    /// A cone.
    Cone {
        /// Its tip.
        apex: Vec2,
        /// Unit vector along its right leg.
        right: Vec2,
        /// Unit vector along its left leg.
        left: Vec2,
    },
    /// A cone with its tip cut off and rounded by a disc that touches both legs: the velocities that lead to a
    /// collision within a time horizon.
    Truncated {
        /// The tip of the cone before truncation.
        apex: Vec2,
        /// Unit vector along its right leg.
        right: Vec2,
        /// Unit vector along its left leg.
        left: Vec2,
        /// Centre of the disc.
        center: Vec2,
        /// Radius of the disc.
        radius: f32,
    },
    /// The velocities to the right of a line.
    RightOf(HalfPlane),
}

impl Forbidden {
    /// Returns the velocities that lead an agent to a collision with a neighbour within `horizon` seconds if the agent
    /// does its share of the avoidance and the neighbour the rest. With a share of 1 that is the velocity obstacle
    /// (Fiorini, Shiller 1998), with less the reciprocal velocity obstacle (van den Berg, Lin, Manocha 2008), both
    /// truncated as in ClearPath. The result is a half-plane for a neighbour that is too close, because there is no
    /// cone then, and if a body of the two is not a disc, because no cone with a round tip is as narrow as the
    /// forbidden region.
    pub fn truncated(velocity: Vec2, other: &AvoidanceNeighbour, horizon: f32, step: f32) -> Self {
        let AvoidanceNeighbour { offset, radii, share, .. } = *other;
        if other.touches() || !other.outline.is_point() {
            return Self::RightOf(other.half_plane(velocity, horizon, step));
        }
        let (left, right) = other.legs();
        let apex = velocity * (1.0 - share) + other.velocity * share;
        let scale = share / horizon;
        Self::Truncated { apex, right, left, center: apex + offset * scale, radius: radii * scale }
    }

    /// Returns how deep `v` lies within the region, m/s; at most zero outside.
    pub fn depth(&self, v: Vec2) -> f32 {
        let between = |apex: Vec2, right: Vec2, left: Vec2| right.perp_dot(v - apex).min((v - apex).perp_dot(left));
        match *self {
            Self::Cone { apex, right, left } => between(apex, right, left),
            Self::Truncated { apex, right, left, center, radius } => {
                // before the line through the points where the disc touches the legs, the disc is the boundary
                let reach = (center - apex).dot(left);
                let axis = right + left;
                if (v - apex).dot(axis) < reach * left.dot(axis) {
                    radius - v.distance(center)
                } else {
                    between(apex, right, left)
                }
            }
            Self::RightOf(line) => line.violation(v),
        }
    }

    /// Returns the pieces of the boundary. Some pieces may lie partly inside the region.
    pub(super) fn pieces(&self) -> impl Iterator<Item = BoundaryPiece> + use<> {
        let (first, second, third) = match *self {
            Self::Cone { apex, right, left } => (
                BoundaryPiece::Ray { from: apex, along: right },
                Some(BoundaryPiece::Ray { from: apex, along: left }),
                None,
            ),
            Self::Truncated { apex, right, left, center, radius } => {
                let reach = (center - apex).dot(left);
                (
                    BoundaryPiece::Ray { from: apex + right * reach, along: right },
                    Some(BoundaryPiece::Ray { from: apex + left * reach, along: left }),
                    Some(BoundaryPiece::Circle { center, radius }),
                )
            }
            Self::RightOf(line) => (BoundaryPiece::Line(line), None, None),
        };
        [Some(first), second, third].into_iter().flatten()
    }
}

/// A piece of a boundary.
#[derive(Clone, Copy, Debug)]
pub(super) enum BoundaryPiece {
    Line(HalfPlane),
    Ray { from: Vec2, along: Vec2 },
    Circle { center: Vec2, radius: f32 },
}

impl BoundaryPiece {
    /// Returns the point of the piece nearest to `v`.
    pub fn nearest(&self, v: Vec2) -> Vec2 {
        match *self {
            Self::Line(HalfPlane { point, direction }) => point + direction * (v - point).dot(direction),
            Self::Ray { from, along } => from + along * (v - from).dot(along).max(0.0),
            Self::Circle { center, radius } => center + (v - center).normalize_or(Vec2::X) * radius,
        }
    }

    /// Returns the crossings with another piece.
    pub fn crossings(&self, other: &Self) -> impl Iterator<Item = Vec2> + use<> {
        let points = match (self.straight(), other.straight()) {
            (Some(one), Some(two)) => [crossing(one, two), None],
            (Some(one), None) => other.on_circle(one),
            (None, Some(two)) => self.on_circle(two),
            (None, None) => self.on_both(other),
        };
        points.into_iter().flatten()
    }

    /// Returns a point, the direction, and the least parameter along it from the point; `None` for a circle.
    fn straight(&self) -> Option<(Vec2, Vec2, f32)> {
        match *self {
            Self::Line(HalfPlane { point, direction }) => Some((point, direction, f32::NEG_INFINITY)),
            Self::Ray { from, along } => Some((from, along, 0.0)),
            Self::Circle { .. } => None,
        }
    }

    fn circle(&self) -> (Vec2, f32) {
        match *self {
            Self::Circle { center, radius } => (center, radius),
            Self::Line(_) | Self::Ray { .. } => (Vec2::ZERO, f32::NAN),
        }
    }

    fn on_circle(&self, (point, along, least): (Vec2, Vec2, f32)) -> [Option<Vec2>; 2] {
        let (center, radius) = self.circle();
        let from = point - center;
        let middle = -from.dot(along);
        let root = (middle * middle - from.length_squared() + radius * radius).sqrt();
        // the root of a negative number is NaN, which is not greater than anything
        [middle - root, middle + root].map(|t| (t >= least).then(|| point + along * t))
    }

    fn on_both(&self, other: &Self) -> [Option<Vec2>; 2] {
        let ((a, r), (b, s)) = (self.circle(), other.circle());
        let between = b - a;
        let distance_squared = between.length_squared();
        if distance_squared <= 0.0 {
            return [None; 2];
        }
        let t = 0.5 + (r * r - s * s) / (2.0 * distance_squared);
        let height = (r * r / distance_squared - t * t).sqrt();
        let crosses = height >= 0.0;
        [height, -height].map(|height| crosses.then(|| a + between * t + between.perp() * height))
    }
}

/// Returns the crossing of two straight pieces.
fn crossing(one: (Vec2, Vec2, f32), two: (Vec2, Vec2, f32)) -> Option<Vec2> {
    let (point, along, least) = one;
    let (origin, across, other_least) = two;
    let sine = along.perp_dot(across);
    if sine.abs() < 1e-6 {
        return None;
    }
    let t = (origin - point).perp_dot(across) / sine;
    let u = (origin - point).perp_dot(along) / sine;
    (t >= least && u >= other_least).then(|| point + along * t)
}
