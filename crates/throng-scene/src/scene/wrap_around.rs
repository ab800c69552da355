//! The sphere that agents leave on one side and enter on the other.

use super::steer::Position;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A sphere that agents do not leave: an agent that crosses it enters on the other side, as soon as there is room for it
/// there. Agents on the ground leave the circle in which the sphere cuts the ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WrapAround {
    /// Its centre. Without it, `[0, 0]`.
    #[serde(default)]
    pub center: Position,
    /// Its radius, metres. Limit: > 0.
    pub radius: f64,
}
