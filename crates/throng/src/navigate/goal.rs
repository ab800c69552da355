//! Goals, and journeys from goal to goal.

use crate::Position;
use crate::agent::GoalId;
use crate::space::is_inside;
use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

/// A destination, world coordinates in metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Goal {
    /// A point. An agent has arrived when its centre is within `tolerance` of the point, or when it touches an agent
    /// that has arrived there already and the crowd around the point leaves no nearer place.
    Point {
        /// The point.
        at: DVec2,
        /// Distance from the point that counts as arrived. Limit: > 0.
        tolerance: f32,
    },
    /// A point in the air, z up from the ground. The rules for a point apply, with distances in space.
    Air {
        /// The point. Limit of z: 0 to 20000.
        at: DVec3,
        /// Distance from the point that counts as arrived. Limit: > 0.
        tolerance: f32,
    },
    /// An area, given by the corners of a simple polygon. An agent has arrived when its centre is inside.
    Area {
        /// Corners, in either orientation.
        corners: Vec<DVec2>,
    },
    /// An area that removes every agent that enters it.
    Exit {
        /// Corners, in either orientation.
        corners: Vec<DVec2>,
    },
}

/// One stop of a journey.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stop {
    /// The goal of the stop.
    pub goal: GoalId,
    /// Seconds to wait there before going on. Limit: >= 0.
    pub wait: f32,
}

/// The goals of an agent, in order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Journey {
    /// The stops in order. Without stops the agent stays.
    pub stops: Vec<Stop>,
    /// Whether to start again with the first stop after the last.
    pub repeat: bool,
}

/// Tolerance of a goal made from a position, metres.
const TOLERANCE: f32 = 0.1;

impl From<Position> for Goal {
    /// A point on the ground, or in the air if z is greater than 0, with a tolerance of 0.1 m.
    fn from(Position(at): Position) -> Self {
        match at.z == 0.0 {
            true => Self::Point { at: at.truncate(), tolerance: TOLERANCE },
            false => Self::Air { at, tolerance: TOLERANCE },
        }
    }
}

macro_rules! goal_from_place {
    ($($place:ty),*) => {
        $(impl From<$place> for Goal {
            /// As from a [`Position`].
            fn from(place: $place) -> Self {
                Position::from(place).into()
            }
        })*
    };
}

goal_from_place!(DVec2, DVec3, [f64; 2], [f64; 3], (f64, f64), (f64, f64, f64));

impl Goal {
    /// Returns the point, or the mean of the corners: an approximate position of the goal.
    pub fn middle(&self) -> DVec2 {
        match self {
            Self::Point { at, .. } => *at,
            Self::Air { at, .. } => at.truncate(),
            Self::Area { corners } | Self::Exit { corners } => {
                corners.iter().sum::<DVec2>() / corners.len().max(1) as f64
            }
        }
    }

    /// Returns the corners of an area; `None` for a point.
    pub fn corners(&self) -> Option<&[DVec2]> {
        match self {
            Self::Area { corners } | Self::Exit { corners } => Some(corners),
            Self::Point { .. } | Self::Air { .. } => None,
        }
    }

    /// Returns the altitude of the goal; `None`: any. A flying agent keeps its altitude on the way to a goal on the
    /// ground.
    pub fn altitude(&self) -> Option<f64> {
        match self {
            Self::Air { at, .. } => Some(at.z),
            _ => None,
        }
    }

    /// Returns the distance from a goal point that counts as arrived; `None` for an area.
    pub fn tolerance(&self) -> Option<f32> {
        match self {
            Self::Point { tolerance, .. } | Self::Air { tolerance, .. } => Some(*tolerance),
            Self::Area { .. } | Self::Exit { .. } => None,
        }
    }

    /// Returns the maximum distance from the middle, metres, at which a place can count as arrived, rounded up a
    /// little.
    pub(crate) fn reach(&self) -> f32 {
        let farthest = |corners: &[DVec2]| {
            let middle = self.middle();
            corners.iter().map(|corner| corner.distance(middle)).fold(0.0, f64::max) as f32
        };
        1.0001 * self.tolerance().or_else(|| self.corners().map(farthest)).unwrap_or(f32::INFINITY)
    }

    /// Returns the offset from a place to the point, and the distance that counts as arrived; `None` for an area.
    pub fn offset(&self, from: DVec3) -> Option<(DVec3, f32)> {
        match self {
            Self::Point { at, tolerance } => Some(((*at - from.truncate()).extend(0.0), *tolerance)),
            Self::Air { at, tolerance } => Some((*at - from, *tolerance)),
            Self::Area { .. } | Self::Exit { .. } => None,
        }
    }

    /// Whether a place is within the tolerance of the point, or inside the area.
    pub fn holds(&self, place: DVec3) -> bool {
        let near = self.offset(place).is_some_and(|(offset, tolerance)| offset.length() <= f64::from(tolerance));
        near || self.corners().is_some_and(|corners| is_inside(corners, place.truncate()))
    }
}
