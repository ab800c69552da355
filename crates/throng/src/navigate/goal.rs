//! Goals, and journeys from goal to goal.

use crate::agent::GoalId;
use glam::DVec2;
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
            Self::Area { corners } | Self::Exit { corners } => {
                corners.iter().sum::<DVec2>() / corners.len().max(1) as f64
            }
        }
    }
}
