//! The placements of throng, as scenes describe them.

use super::ground::is_zero;
use super::{Point, SpacePoint};
use crate::registry::{Place, Placements, described, schema_of_value};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

described! {
    Place in Placements:
    /// One position: for a single agent, or for a source.
    PointPlace = "point",
    /// A position for each agent.
    PointsPlace = "points",
    /// Evenly along a line, both ends included.
    Line = "line",
    /// Evenly on a circle.
    Ring = "ring",
    /// Evenly on a sphere, in the air.
    Sphere = "sphere",
    /// On a square grid, row by row.
    Grid = "grid",
    /// At random in a disc.
    DiscPlace = "disc",
    /// At random in a rectangle.
    RectanglePlace = "rectangle",
    /// At random in a polygon.
    PolygonPlace = "polygon",
    /// At random on all of the walkable ground.
    WalkablePlace = "walkable",
}

impl Default for Place {
    /// Returns the point (0, 0).
    fn default() -> Self {
        PointPlace::default().into()
    }
}

schema_of_value! {
    PointPlace: Point,
    PointsPlace: Vec<Point>,
}

/// One position: for a single agent, or for a source.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct PointPlace(pub Point);

/// A position for each agent.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct PointsPlace(pub Vec<Point>);

/// Evenly along a line, both ends included; a single agent stands in the middle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// Position of the first agent.
    pub from: Point,
    /// Position of the last agent.
    pub to: Point,
}

/// Evenly on a circle, counter-clockwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ring {
    /// Its centre.
    #[serde(default)]
    pub center: Point,
    /// Its radius. Limit: > 0.
    pub radius: f64,
    /// Direction from the centre to the first agent, degrees counter-clockwise from +x.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub start: f64,
}

/// Evenly on a sphere, in a spiral from the top down (a Fibonacci lattice).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sphere {
    /// Its centre. Limit of z: at least `radius`, so that all of it is above the ground.
    pub center: SpacePoint,
    /// Its radius. Limit: > 0.
    pub radius: f64,
}

/// On a square grid, row by row.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Grid {
    /// Its centre.
    #[serde(default)]
    pub center: Point,
    /// The number of agents side by side along x. Limit: at least 1.
    pub columns: u64,
    /// The number of rows along y. Limit: at least 1.
    pub rows: u64,
    /// Distance between neighbouring centres, metres. Limit: > 0.
    pub spacing: f64,
    /// Rotation about its centre, degrees counter-clockwise.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub rotation: f64,
}

/// At random in a disc.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DiscPlace {
    /// Its centre.
    #[serde(default)]
    pub center: Point,
    /// Its radius; bodies may reach over its edge. Limit: > 0.
    pub radius: f64,
    /// The least distance between bodies, metres. Limit: >= 0.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub gap: f64,
}

/// At random in a rectangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RectanglePlace {
    /// Its centre.
    pub center: Point,
    /// Its sides; bodies may reach over its edges. Limit: > 0.
    pub size: Point,
    /// Rotation about its centre, degrees counter-clockwise.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub rotation: f64,
    /// The least distance between bodies, metres. Limit: >= 0.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub gap: f64,
}

/// At random in a polygon.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PolygonPlace {
    /// Its corners, in either orientation; bodies may reach over its edges. Limit: at least 3.
    pub corners: Vec<Point>,
    /// The least distance between bodies, metres. Limit: >= 0.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub gap: f64,
}

/// At random on all of the walkable ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WalkablePlace {
    /// The least distance between bodies, metres. Limit: >= 0.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub gap: f64,
}
