//! Annotations: what is drawn beside agents about their state and decisions.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The annotations of agents. In files `true`, `false`, or a list of kinds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected true, false, or a list of kinds such as [\"velocity\", \"targets\"]")]
pub enum Annotate {
    /// All annotations, or none.
    All(bool),
    /// These kinds.
    Kinds(Vec<Annotation>),
}

impl Default for Annotate {
    fn default() -> Self {
        Self::All(false)
    }
}

impl Annotate {
    pub(super) fn is_nothing(&self) -> bool {
        *self == Self::default()
    }
}

/// A kind of annotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Annotation {
    /// The reach of the neighbour search, and the neighbours found.
    Neighbourhoods,
    /// The positions of the last ten seconds.
    Trails,
    /// The paths and walls that agents follow: the stretch ahead, its width, and the nearest point on it.
    Paths,
    /// The velocities that neighbours and walls forbid, as the motion in one second.
    VelocityObstacles,
    /// The circles and rectangles with which behaviours construct their targets.
    Constructions,
    /// The feelers for obstacles, and the cylinder that the agent will sweep.
    Feelers,
    /// The velocity of the field that the agent follows, at the place where the agent reads it.
    Flow,
    /// The predicted positions of other agents or of the agent itself.
    Predictions,
    /// The points at which agents aim, and those that they move away from.
    Targets,
    /// The agents that will come too near, and the positions of both agents at that time; the most threatening obstacle.
    Threats,
    /// The preferred velocity.
    Preferred,
    /// The velocity.
    Velocity,
    /// The terms of the steering force, head to tail.
    Terms,
    /// The steering force.
    Force,
}
