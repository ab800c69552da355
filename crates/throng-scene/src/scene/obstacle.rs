//! Obstacles.

use super::{Point, Rectangle};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An obstacle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Obstacle {
    /// The name, for people and for `--set`.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Its outline.
    pub shape: Shape,
    /// What is solid: the shape, or the circle around it.
    #[serde(default, rename = "as", skip_serializing_if = "As::is_shape")]
    pub solid_as: As,
}

impl From<Shape> for Obstacle {
    fn from(shape: Shape) -> Self {
        Self { name: String::new(), shape, solid_as: As::Shape }
    }
}

/// The outline of an obstacle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// A disc.
    Circle(Circle),
    /// A rectangle.
    Rectangle(Rectangle),
    /// The corners of a simple polygon, in either orientation, the first not repeated. Limit: at least 3.
    Polygon(Vec<Point>),
    /// Thin walls from point to point, not closed. Limit: at least 2.
    Wall(Vec<Point>),
}

/// A circle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Circle {
    /// Its centre.
    pub center: Point,
    /// Its radius. Limit: > 0.
    pub radius: f64,
}

/// What of an obstacle is solid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum As {
    /// Its shape.
    #[default]
    Shape,
    /// The circle around its bounding box, as in the seed labs: good for pillars and trees, bad for walls. The box of a
    /// rectangle turns with it, the box of a polygon or wall is axis-aligned. A circle stays as it is.
    Circle,
}

impl As {
    fn is_shape(&self) -> bool {
        *self == Self::Shape
    }
}
