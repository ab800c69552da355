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
    /// The paths that agents follow.
    Paths,
    /// The whiskers of agents.
    Feelers,
    /// The predicted positions of other agents or of the agent itself.
    Predictions,
    /// The points at which agents aim.
    Targets,
    /// The agents that will come too near, and the positions of both agents at that time.
    Threats,
    /// The preferred velocity.
    Preferred,
    /// The velocity.
    Velocity,
    /// The steering force.
    Force,
}
