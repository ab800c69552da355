//! Shapes of obstacles and of walkable ground.

use super::{is_inside, nearest_on_segment};
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// An obstacle. World coordinates, metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Obstacle {
    /// A disc.
    Circle {
        /// Its centre.
        center: DVec2,
        /// Its radius. Limit: > 0.
        radius: f64,
    },
    /// A solid simple polygon, in either orientation.
    Polygon {
        /// Its corners; the first is not repeated.
        corners: Vec<DVec2>,
    },
    /// A chain of thin walls from point to point, solid from both sides. The chain is not closed.
    Wall {
        /// Its points, at least two.
        points: Vec<DVec2>,
    },
}

impl Obstacle {
    /// Whether a point is inside the obstacle; for a thin wall, within a micrometre of it.
    pub fn covers(&self, p: DVec2) -> bool {
        match self {
            Self::Circle { center, radius } => center.distance(p) < *radius,
            Self::Polygon { corners } => is_inside(corners, p),
            Self::Wall { points } => {
                points.windows(2).any(|ends| nearest_on_segment(ends[0], ends[1], p).distance(p) < 1e-6)
            }
        }
    }

    /// Returns the lower left and upper right corners of its bounding box.
    pub(crate) fn bounds(&self) -> (DVec2, DVec2) {
        match self {
            Self::Circle { center, radius } => (*center - *radius, *center + *radius),
            Self::Polygon { corners: points } | Self::Wall { points } => {
                points.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)))
            }
        }
    }

    /// Returns the obstacle, moved by an offset, metres.
    pub fn moved(mut self, by: DVec2) -> Self {
        match &mut self {
            Self::Circle { center, .. } => *center += by,
            Self::Polygon { corners: points } | Self::Wall { points } => points.iter_mut().for_each(|p| *p += by),
        }
        self
    }

    /// Returns a rectangle with sides `size`, turned by `angle` radians counter-clockwise about its centre.
    pub fn rectangle(center: DVec2, size: DVec2, angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        let half = size * 0.5;
        let corner = |x: f64, y: f64| center + DVec2::new(cos * x - sin * y, sin * x + cos * y);
        Self::Polygon {
            corners: vec![
                corner(-half.x, -half.y),
                corner(half.x, -half.y),
                corner(half.x, half.y),
                corner(-half.x, half.y),
            ],
        }
    }
}

/// A walkable area: a polygon with holes. World coordinates, metres.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Walkable {
    /// Corners of the outer boundary, in either orientation; the first is not repeated.
    pub outer: Vec<DVec2>,
    /// Corners of each hole, in either orientation.
    pub holes: Vec<Vec<DVec2>>,
}
