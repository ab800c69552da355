//! Moving obstacles: doors, vehicles on their rounds.

use super::group::{first_layer, is_first_layer, is_yes, yes};
use super::{Body, Colour, Point};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Something solid that moves as its script says and avoids nobody. The guard holds it where somebody is in its way;
/// then it catches up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mover {
    /// A name for people and for `--set`. Without it, `mover-1` for the first.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Its body.
    pub body: Body,
    /// Where it is when. Between two entries it moves and turns evenly. Limit: at least 1, at least 2 if it repeats.
    pub script: Vec<Keyframe>,
    /// After the last entry, begin again with the first.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub repeat: bool,
    /// Speed it never exceeds, m/s. Without it, half as much again as the script needs. Limit: > 0, at most 1000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_speed: Option<f64>,
    /// Greatest change of heading, degrees a second. Without it, half as much again as the script needs. Limit: > 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turn_rate: Option<f64>,
    /// The layers it is on. Limit: 0 to 31 each.
    #[serde(default = "first_layer", skip_serializing_if = "is_first_layer")]
    pub layers: Vec<u8>,
    /// Whether the guard keeps it from overlapping walls, and others that are without guard.
    #[serde(default = "yes", skip_serializing_if = "is_yes")]
    pub guard: bool,
    /// Colour in pictures. Without it, the next of the palette.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<Colour>,
}

/// Where a moving obstacle is at a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Keyframe {
    /// When, seconds. Limit: >= 0, later than the one before.
    pub time: f64,
    /// Where its centre is.
    pub at: Point,
    /// Direction of its body, degrees counter-clockwise from +x. From 0 to 360 it turns once round.
    #[serde(default)]
    pub heading: f64,
}

impl Mover {
    /// The name of the moving obstacle at this position of a scene: its own, or `mover-1` for the first.
    pub(crate) fn name_at(name: &str, position: usize) -> String {
        if name.is_empty() { format!("mover-{}", position + 1) } else { name.to_owned() }
    }
}
