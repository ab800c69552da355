//! Shapes people cannot enter, and the area they can.

use super::{is_inside, nearest_on_segment};
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// Something solid. World coordinates, metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Obstacle {
    /// A disc.
    Circle {
        /// Its centre.
        center: DVec2,
        /// Its radius. Limit: > 0.
        radius: f64,
    },
    /// A solid simple polygon, either way round.
    Polygon {
        /// Its corners; the first is not repeated.
        corners: Vec<DVec2>,
    },
    /// A chain of thin walls from point to point, solid from both sides. It is not closed.
    Wall {
        /// Its points, at least two.
        points: Vec<DVec2>,
    },
}

impl Obstacle {
    /// Whether a point is inside what is solid; of a thin wall, on it, give or take a micrometre.
    pub fn covers(&self, p: DVec2) -> bool {
        match self {
            Self::Circle { center, radius } => center.distance(p) < *radius,
            Self::Polygon { corners } => is_inside(corners, p),
            Self::Wall { points } => {
                points.windows(2).any(|ends| nearest_on_segment(ends[0], ends[1], p).distance(p) < 1e-6)
            }
        }
    }

    /// A rectangle with sides `size`, turned by `angle` radians counter-clockwise about its centre.
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

/// Ground that can be walked on: a polygon with holes. World coordinates, metres.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Walkable {
    /// Corners of the outer boundary, either way round; the first is not repeated.
    pub outer: Vec<DVec2>,
    /// Corners of each hole, either way round.
    pub holes: Vec<Vec<DVec2>>,
}
