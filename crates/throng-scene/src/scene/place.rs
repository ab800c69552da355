//! Where agents start.

use super::ground::is_zero;
use super::{Point, Spot};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where the agents of a group start.
///
/// Points, line, ring, sphere and grid put agent number k at the k-th spot. Disc, rectangle, polygon and walkable draw a
/// spot for each, clear of walls, of obstacles and of everybody else.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Place {
    /// One spot: for a single agent, or for a source.
    Point(Point),
    /// A spot for each.
    Points(Vec<Point>),
    /// Evenly along a line, both ends included.
    Line(Line),
    /// Evenly on a circle.
    Ring(Ring),
    /// Evenly on a sphere, in the air.
    Sphere(Sphere),
    /// On a square grid, row by row.
    Grid(Grid),
    /// At random in a disc.
    Disc(DiscPlace),
    /// At random in a rectangle.
    Rectangle(RectanglePlace),
    /// At random in a polygon.
    Polygon(PolygonPlace),
    /// At random on all of the walkable ground.
    Walkable(WalkablePlace),
}

impl Default for Place {
    fn default() -> Self {
        Self::Point([0.0, 0.0])
    }
}

/// Evenly along a line, both ends included; a single agent stands in the middle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// Where the first stands.
    pub from: Point,
    /// Where the last stands.
    pub to: Point,
}

/// Evenly on a circle, counter-clockwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ring {
    /// Its middle.
    #[serde(default)]
    pub center: Point,
    /// Its radius. Limit: > 0.
    pub radius: f64,
    /// Where the first stands, degrees counter-clockwise from +x.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub start: f64,
}

/// Evenly on a sphere, from its top down in a spiral (a Fibonacci lattice).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sphere {
    /// Its middle. Limit of z: at least `radius`, so that all of it is above the ground.
    pub center: Spot,
    /// Its radius. Limit: > 0.
    pub radius: f64,
}

/// On a square grid, row by row.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Grid {
    /// Its middle.
    #[serde(default)]
    pub center: Point,
    /// How many side by side along x. Limit: at least 1.
    pub columns: u64,
    /// How many rows along y. Limit: at least 1.
    pub rows: u64,
    /// Metres between neighbours' centres. Limit: > 0.
    pub spacing: f64,
    /// Turned counter-clockwise about its middle, degrees.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub rotation: f64,
}

/// At random in a disc.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DiscPlace {
    /// Its middle.
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
    /// Its middle.
    pub center: Point,
    /// Its sides; bodies may reach over its edges. Limit: > 0.
    pub size: Point,
    /// Turned counter-clockwise about its middle, degrees.
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
    /// Its corners, either way round; bodies may reach over its edges. Limit: at least 3.
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
