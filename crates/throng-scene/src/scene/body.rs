//! Bodies of agents.

use super::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A body. In files `{ radius = 0.2 }`, `{ capsule = { length = 0.5, width = 0.3 } }` or
/// `{ rectangle = { length = 4.2, width = 1.8 } }`; the length lies along the heading.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Body {
    /// A disc of this radius, metres. Limit: > 0, at most 1000.
    Radius(Number),
    /// A capsule: a rectangle with a half disc at each end.
    Capsule(Sides),
    /// A rectangle with slightly rounded corners.
    Rectangle(Sides),
}

/// The length and width of a body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sides {
    /// Along the heading, metres. Limit: > 0, at most 1000.
    pub length: Number,
    /// Across the heading, metres. Limit: > 0, at most 1000.
    pub width: Number,
}

impl Default for Body {
    fn default() -> Self {
        Self::Radius(Number::Constant(0.13))
    }
}
