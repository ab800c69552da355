//! What is drawn beside agents of what they have in mind.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What is drawn beside agents. In files `true`, `false`, or a list of kinds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected true, false, or a list of kinds such as [\"velocity\", \"targets\"]")]
pub enum Annotate {
    /// Everything, or nothing.
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

/// One of the things that can be drawn beside agents.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Annotation {
    /// How far they look, and whom they see.
    Neighbourhoods,
    /// Where they have been for the last ten seconds.
    Trails,
    /// The paths they follow.
    Paths,
    /// What they feel their way along.
    Feelers,
    /// Where they expect others, or themselves, to be.
    Predictions,
    /// Where they aim at.
    Targets,
    /// Who will come too near, and where the two will be then.
    Threats,
    /// The velocity they would like.
    Preferred,
    /// The velocity they have.
    Velocity,
    /// The force they steer by.
    Force,
}
