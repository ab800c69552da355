//! What is solid.

use super::{Point, Rectangle};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Something solid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Obstacle {
    /// A name for people and for `--set`.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Its outline.
    pub shape: Shape,
    /// What of it is solid: its shape, or the circle round it.
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
    /// The corners of a simple polygon, either way round, the first not repeated. Limit: at least 3.
    Polygon(Vec<Point>),
    /// Thin walls from point to point, not closed. Limit: at least 2.
    Wall(Vec<Point>),
}

/// A circle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Circle {
    /// Its middle.
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
    /// The circle round its bounding box, the seed labs' way (MODELS 1.8): good for pillars and trees, bad for
    /// walls. The box of a rectangle turns with it, that of a polygon or wall lies along the axes. A circle stays
    /// as it is.
    Circle,
}

impl As {
    fn is_shape(&self) -> bool {
        *self == Self::Shape
    }
}
