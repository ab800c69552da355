//! Moving obstacles: doors, vehicles on their rounds.

use super::group::{first_layer, is_first_layer, is_yes, yes};
use super::{Body, Colour, Point};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A moving obstacle that follows a script and does not avoid agents. The guard stops it if an agent is in its way;
/// then it catches up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mover {
    /// The name, for people and for `--set`. Without it, `mover-1` for the first mover.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Its body.
    pub body: Body,
    /// Its positions over time. Between two entries it moves and turns evenly. Limit: at least 1, at least 2 if it
    /// repeats.
    pub script: Vec<Keyframe>,
    /// Whether the script starts again after the last entry.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub repeat: bool,
    /// Greatest speed, m/s. Without it, one and a half times what the script needs. Limit: > 0, at most 1000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_speed: Option<f64>,
    /// Greatest change of heading, degrees a second. Without it, one and a half times what the script needs. Limit: >
    /// 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turn_rate: Option<f64>,
    /// The layers it is on. Limit: 0 to 31 each.
    #[serde(default = "first_layer", skip_serializing_if = "is_first_layer")]
    pub layers: Vec<u8>,
    /// Whether the guard keeps it from overlapping walls, and agents and movers without guard.
    #[serde(default = "yes", skip_serializing_if = "is_yes")]
    pub guard: bool,
    /// Colour in pictures. Without it, the next of the palette.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<Colour>,
}

/// The position of a moving obstacle at a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Keyframe {
    /// The time, seconds. Limit: >= 0, later than the one before.
    pub time: f64,
    /// Position of its centre.
    pub at: Point,
    /// Direction of its body, degrees counter-clockwise from +x. From 0 to 360 it turns round once.
    #[serde(default)]
    pub heading: f64,
}

impl Mover {
    /// Returns the name of the moving obstacle at this position of a scene: its own name, or `mover-1` for the first.
    pub(crate) fn name_at(name: &str, position: usize) -> String {
        if name.is_empty() { format!("mover-{}", position + 1) } else { name.to_owned() }
    }
}
