//! Regions of forbidden velocities, and the pieces of line and circle that bound them.

use super::{Line, Neighbour, orca};
use glam::Vec2;

/// Velocities that are forbidden.
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
    /// A cone whose tip is cut off and rounded by a disc that touches both legs: what leads to a collision within a
    /// time horizon.
    Truncated {
        /// The tip it would have.
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
    /// What is right of a line.
    RightOf(Line),
}

impl Forbidden {
    /// The velocities that lead an agent to a collision with a neighbour within `horizon` seconds, if the agent does
    /// its share of the avoiding and the neighbour the rest: with a share of 1 the velocity obstacle (Fiorini, Shiller
    /// 1998), with less the reciprocal one (van den Berg, Lin, Manocha 2008), both cut off as in ClearPath. For a
    /// neighbour that is too close there is no cone: a half-plane leads out; and so for one of two that are no discs: no
    /// cone with a round tip is as narrow as what leads to a collision.
    pub fn truncated(velocity: Vec2, other: &Neighbour, horizon: f32, step: f32) -> Self {
        let Neighbour { offset, radii, share, .. } = *other;
        if other.touches() || !other.outline.is_point() {
            return Self::RightOf(orca::line(velocity, other, horizon, step));
        }
        let (left, right) = other.legs();
        let apex = velocity * (1.0 - share) + other.velocity * share;
        let scale = share / horizon;
        Self::Truncated { apex, right, left, center: apex + offset * scale, radius: radii * scale }
    }

    /// How deep `v` lies within, at most zero outside. m/s
    pub fn depth(&self, v: Vec2) -> f32 {
        let between = |apex: Vec2, right: Vec2, left: Vec2| right.perp_dot(v - apex).min((v - apex).perp_dot(left));
        match *self {
            Self::Cone { apex, right, left } => between(apex, right, left),
            Self::Truncated { apex, right, left, center, radius } => {
                // before the line through the points where the disc touches the legs, the disc bounds it
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

    /// What bounds it; some pieces may lie partly within.
    pub(super) fn pieces(&self) -> impl Iterator<Item = Piece> + use<> {
        let (first, second, third) = match *self {
            Self::Cone { apex, right, left } => {
                (Piece::Ray { from: apex, along: right }, Some(Piece::Ray { from: apex, along: left }), None)
            }
            Self::Truncated { apex, right, left, center, radius } => {
                let reach = (center - apex).dot(left);
                (
                    Piece::Ray { from: apex + right * reach, along: right },
                    Some(Piece::Ray { from: apex + left * reach, along: left }),
                    Some(Piece::Circle { center, radius }),
                )
            }
            Self::RightOf(line) => (Piece::Line(line), None, None),
        };
        [Some(first), second, third].into_iter().flatten()
    }
}

/// A piece of a boundary.
#[derive(Clone, Copy, Debug)]
pub(super) enum Piece {
    Line(Line),
    Ray { from: Vec2, along: Vec2 },
    Circle { center: Vec2, radius: f32 },
}

impl Piece {
    /// Its point nearest to `v`.
    pub fn nearest(&self, v: Vec2) -> Vec2 {
        match *self {
            Self::Line(Line { point, direction }) => point + direction * (v - point).dot(direction),
            Self::Ray { from, along } => from + along * (v - from).dot(along).max(0.0),
            Self::Circle { center, radius } => center + (v - center).normalize_or(Vec2::X) * radius,
        }
    }

    /// Where it crosses another.
    pub fn crossings(&self, other: &Self) -> impl Iterator<Item = Vec2> + use<> {
        let points = match (self.straight(), other.straight()) {
            (Some(one), Some(two)) => [crossing(one, two), None],
            (Some(one), None) => other.on_circle(one),
            (None, Some(two)) => self.on_circle(two),
            (None, None) => self.on_both(other),
        };
        points.into_iter().flatten()
    }

    /// A point of it, its direction, and how far back from the point it reaches.
    fn straight(&self) -> Option<(Vec2, Vec2, f32)> {
        match *self {
            Self::Line(Line { point, direction }) => Some((point, direction, f32::NEG_INFINITY)),
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
        // the root of a negative number is no number, and not greater than anything
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

/// Where two straight pieces cross.
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
