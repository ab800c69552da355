//! Goals, and journeys from goal to goal.

use crate::agent::GoalId;
use crate::space::is_inside;
use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

/// A place to go to, world coordinates in metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Goal {
    /// A point. An agent is there when its centre is within `tolerance` of it, or when it touches somebody who has
    /// arrived there already and the crowd round the point leaves no nearer place (MODELS 1.9).
    Point {
        /// The point.
        at: DVec2,
        /// Distance that counts as there. Limit: > 0.
        tolerance: f32,
    },
    /// A point in the air, z up from the ground; as a point, with distances in space.
    Air {
        /// The point. Limit of z: 0 to 20000.
        at: DVec3,
        /// Distance that counts as there. Limit: > 0.
        tolerance: f32,
    },
    /// An area, the corners of a simple polygon. An agent is there when its centre is inside.
    Area {
        /// Corners, either way round.
        corners: Vec<DVec2>,
    },
    /// An area that removes whoever enters it.
    Exit {
        /// Corners, either way round.
        corners: Vec<DVec2>,
    },
}

/// One stop of a journey.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stop {
    /// Where.
    pub goal: GoalId,
    /// Seconds to wait there before going on. Limit: >= 0.
    pub wait: f32,
}

/// The goals of an agent, one after the other.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Journey {
    /// The stops in order. None: stay.
    pub stops: Vec<Stop>,
    /// After the last stop, begin again with the first.
    pub repeat: bool,
}

impl Goal {
    /// The point, or the middle of the corners: where the goal is, roughly.
    pub fn middle(&self) -> DVec2 {
        match self {
            Self::Point { at, .. } => *at,
            Self::Air { at, .. } => at.truncate(),
            Self::Area { corners } | Self::Exit { corners } => {
                corners.iter().sum::<DVec2>() / corners.len().max(1) as f64
            }
        }
    }

    /// The corners, of a goal that is an area.
    pub fn corners(&self) -> Option<&[DVec2]> {
        match self {
            Self::Area { corners } | Self::Exit { corners } => Some(corners),
            Self::Point { .. } | Self::Air { .. } => None,
        }
    }

    /// The altitude to be at there; `None`: any. Who flies keeps theirs on the way to a goal on the ground.
    pub fn altitude(&self) -> Option<f64> {
        match self {
            Self::Air { at, .. } => Some(at.z),
            _ => None,
        }
    }

    /// The distance that counts as there, of a goal that is a point.
    pub fn tolerance(&self) -> Option<f32> {
        match self {
            Self::Point { tolerance, .. } | Self::Air { tolerance, .. } => Some(*tolerance),
            Self::Area { .. } | Self::Exit { .. } => None,
        }
    }

    /// How far from the middle a place can be that counts as there, metres: a little more than that.
    pub(crate) fn reach(&self) -> f32 {
        let farthest = |corners: &[DVec2]| {
            let middle = self.middle();
            corners.iter().map(|corner| corner.distance(middle)).fold(0.0, f64::max) as f32
        };
        1.0001 * self.tolerance().or_else(|| self.corners().map(farthest)).unwrap_or(f32::INFINITY)
    }

    /// From a place to the point straight on, and the distance that counts as there; `None` for an area.
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
