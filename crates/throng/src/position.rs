//! Places as callers give them.

use glam::{DVec2, DVec3};

/// A place in world coordinates, metres, z up from the ground.
///
/// The rule for two and three dimensions: a world is three-dimensional, and z = 0 is the ground. Every call that takes the
/// place of an agent or of a goal takes `impl Into<Position>`: two numbers are a place on the ground, three are a place in
/// space. Every call that returns such a place returns a [`DVec3`]. Walls, obstacles and areas stand on the ground: their
/// points are [`DVec2`].
///
/// ```
/// use glam::{DVec2, DVec3};
/// use throng::Position;
/// assert_eq!(Position::from([1.0, 2.0]).0, DVec3::new(1.0, 2.0, 0.0));
/// assert_eq!(Position::from(DVec2::new(1.0, 2.0)), Position::from([1.0, 2.0, 0.0]));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Position(pub DVec3);

impl From<DVec3> for Position {
    fn from(place: DVec3) -> Self {
        Self(place)
    }
}

impl From<DVec2> for Position {
    fn from(place: DVec2) -> Self {
        Self(place.extend(0.0))
    }
}

impl From<[f64; 3]> for Position {
    fn from(place: [f64; 3]) -> Self {
        Self(place.into())
    }
}

impl From<[f64; 2]> for Position {
    fn from([x, y]: [f64; 2]) -> Self {
        Self(DVec3::new(x, y, 0.0))
    }
}

impl From<(f64, f64)> for Position {
    fn from((x, y): (f64, f64)) -> Self {
        Self(DVec3::new(x, y, 0.0))
    }
}

impl From<(f64, f64, f64)> for Position {
    fn from(place: (f64, f64, f64)) -> Self {
        Self(place.into())
    }
}
