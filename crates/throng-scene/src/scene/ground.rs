//! Ground, and regions of it.

use super::{Circle, Point};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Ground that can be walked on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Walkable {
    /// A rectangle.
    Rectangle(Rectangle),
    /// A polygon with holes.
    Polygon(Area),
    /// Several polygons with holes: what lies in any of them.
    Polygons(Vec<Area>),
    /// The polygons of a WKT file. A relative name is looked for beside the scene file.
    File(String),
}

/// A polygon with holes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Area {
    /// Corners of the boundary, either way round, the first not repeated. Limit: at least 3.
    pub outer: Vec<Point>,
    /// Corners of each hole.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holes: Vec<Vec<Point>>,
}

/// A rectangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rectangle {
    /// Its middle.
    pub center: Point,
    /// Its sides along x and y, before it is turned. Limit: > 0.
    pub size: Point,
    /// Turned counter-clockwise about its middle, degrees.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub rotation: f64,
}

impl Rectangle {
    /// With sides along the axes, from one corner to the opposite one.
    pub fn between(a: Point, b: Point) -> Self {
        Self {
            center: [(a[0] + b[0]) * 0.5, (a[1] + b[1]) * 0.5],
            size: [(a[0] - b[0]).abs(), (a[1] - b[1]).abs()],
            rotation: 0.0,
        }
    }
}

/// A region of the ground: what a goal covers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Region {
    /// A disc (a polygon of 32 corners on its circle stands for it).
    Disc(Circle),
    /// A rectangle.
    Rectangle(Rectangle),
    /// The corners of a simple polygon, either way round.
    Polygon(Vec<Point>),
}

pub(super) fn is_zero(x: &f64) -> bool {
    *x == 0.0
}
