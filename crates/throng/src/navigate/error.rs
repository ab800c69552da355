//! Errors of floor plans, and the reasons why there is no path.

use glam::DVec2;
use std::fmt;

/// A ring or chain of points of the input, identified by its index in the given slices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ring {
    /// The outer boundary of the walkable area with this index.
    Outer {
        /// Index of the walkable area.
        area: usize,
    },
    /// A hole of a walkable area.
    Hole {
        /// Index of the walkable area.
        area: usize,
        /// Index of the hole in it.
        hole: usize,
    },
    /// The obstacle with this index.
    Obstacle {
        /// Index of the obstacle.
        index: usize,
    },
    /// The corners of a goal area.
    Goal,
}

impl fmt::Display for Ring {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Outer { area } => write!(f, "walkable area {area}"),
            Self::Hole { area, hole } => write!(f, "hole {hole} of walkable area {area}"),
            Self::Obstacle { index } => write!(f, "obstacle {index}"),
            Self::Goal => write!(f, "the goal area"),
        }
    }
}

/// Why no mesh can be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NavError {
    /// A number is not finite or out of its range.
    #[error("{what} is {value}, but must be {limit}")]
    Limit {
        /// The number.
        what: &'static str,
        /// Its value.
        value: f64,
        /// Its permitted range.
        limit: &'static str,
    },
    /// A coordinate is infinite or not a number.
    #[error("point {point} of {ring} is not finite")]
    NotFinite {
        /// The ring.
        ring: Ring,
        /// Index of the point in the ring.
        point: usize,
    },
    /// A ring has too few different corners.
    #[error("{ring} has {found} different points, but needs at least {needed}")]
    TooFewCorners {
        /// The ring.
        ring: Ring,
        /// Number of different points.
        found: usize,
        /// Number that is needed.
        needed: usize,
    },
    /// Two edges of a ring cross.
    #[error("{ring} crosses itself at ({:.3}, {:.3}): the edges after its points {first} and {second}", at.x, at.y)]
    SelfCrossing {
        /// The ring.
        ring: Ring,
        /// Index of the point where the first edge begins.
        first: usize,
        /// Index of the point where the second edge begins.
        second: usize,
        /// Where the edges cross.
        at: DVec2,
    },
    /// The input is wider than the lattice.
    #[error(
        "the floor plan is {size:.0} m wide, but may be at most {limit:.0} m; move far-away parts into a mesh of their own"
    )]
    TooWide {
        /// Largest side of its bounding box, metres.
        size: f64,
        /// The limit, metres.
        limit: f64,
    },
    /// No ground is free for a disc of this radius.
    #[error("no free ground is left for a radius of {radius} m")]
    NoRoom {
        /// The radius.
        radius: f64,
    },
    /// The triangulation failed, which is a defect of this library.
    #[error("the free ground cannot be triangulated: {0}")]
    Triangulation(String),
}

/// The reason why there is no path.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize, thiserror::Error)]
#[non_exhaustive]
pub enum Unreachable {
    /// The start is neither on the mesh nor close enough to be moved onto it.
    #[error("the start ({:.3}, {:.3}) is inside a wall, {} from free ground", at.x, at.y, away(*distance))]
    StartInWall {
        /// The start.
        at: DVec2,
        /// Its distance from the mesh.
        distance: f64,
    },
    /// The goal is neither on the mesh nor within a radius of it.
    #[error("the goal ({:.3}, {:.3}) is inside a wall, {} from free ground", at.x, at.y, away(*distance))]
    GoalInWall {
        /// The goal, or a corner of the goal area.
        at: DVec2,
        /// Its distance from the mesh; for an area farther away than a radius, infinite.
        distance: f64,
    },
    /// Start and goal are on different islands of the mesh.
    #[error("there is no way: walls, or gaps narrower than the body, close off the goal")]
    NoWay {
        /// Island of the start.
        from: u32,
        /// Island of the goal; for an area with several islands, the first.
        to: u32,
    },
    /// A coordinate is infinite or not a number.
    #[error("a coordinate of the start or the goal is not finite")]
    NotFinite,
}

/// Formats a distance for messages. Infinite stands for farther away than the search reached.
fn away(distance: f64) -> String {
    if distance.is_finite() { format!("{distance:.3} m") } else { "more than a body's radius".into() }
}
