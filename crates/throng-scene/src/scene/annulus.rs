//! Rings of ground, and laps of them.

use super::Point;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The ground between two circles: a corridor without ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Annulus {
    /// Its centre.
    #[serde(default)]
    pub center: Point,
    /// Radius of the inner wall. Limit: > 0.
    pub inner: f64,
    /// Radius of the outer wall. Limit: > inner.
    pub outer: f64,
}

/// Laps of an annulus, without end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lap {
    /// The annulus. Without it, that of `walkable.ring`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ring: Option<Annulus>,
    /// Whether the laps run clockwise, instead of counter-clockwise.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub clockwise: bool,
}
