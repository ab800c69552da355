//! Surfaces and paths that behaviours steer by.

use super::Point;
use super::ground::is_zero;
use super::steer::Position;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A surface that behaviours refer to by its name: something to avoid, to follow, to stay in, to hide behind. It is
/// solid to those groups only that say so.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Surface {
    /// The name that behaviours call it by.
    pub name: String,
    /// Its shape, about its own origin.
    pub shape: Form,
    /// Where its own origin is. Without it, at `[0, 0]`.
    #[serde(default, skip_serializing_if = "is_default")]
    pub at: Position,
    /// Where its own x axis points, degrees counter-clockwise from +x.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub heading: f64,
    /// How far its own x axis is raised, degrees.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub pitch: f64,
    /// How far it is turned about its own x axis, first of all, degrees: its y axis goes up.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub roll: f64,
    /// From where it is seen.
    #[serde(default, skip_serializing_if = "is_default")]
    pub seen_from: SeenFrom,
}

pub(super) fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// The shape of a surface, about its own origin. Metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// A ball about the origin.
    Sphere(Ball),
    /// A box about the origin.
    Box(Block),
    /// Everything on one side of a plane through the origin.
    Plane(HalfSpace),
    /// A rectangle without thickness about the origin, in the plane of the own x and y axes: two sides, no inside.
    Rectangle(Sheet),
    /// A cylinder with flat ends.
    Cylinder(Rod),
    /// A cylinder with round ends.
    Capsule(Rod),
    /// What stands on a polygon.
    Prism(Column),
    /// Heights of the ground on a grid.
    HeightField(HeightField),
    /// Triangles from a file.
    Mesh(MeshFile),
}

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ball {
    /// Its radius. Limit: > 0.
    pub radius: f64,
}

/// A box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Block {
    /// Its extents along x, y and z. Limit: > 0.
    pub size: [f64; 3],
}

/// Everything on one side of a plane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HalfSpace {
    /// Where the outside is, a vector of any length but 0.
    pub normal: [f64; 3],
}

/// A rectangle without thickness.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sheet {
    /// Its extents along x and y. Limit: > 0.
    pub size: Point,
}

/// Round about a line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rod {
    /// Where the line starts.
    pub from: [f64; 3],
    /// Where it ends.
    pub to: [f64; 3],
    /// The radius. Limit: > 0.
    pub radius: f64,
}

/// What stands on a polygon.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Column {
    /// Corners of the polygon, either way round. Limit: at least 3.
    pub corners: Vec<Point>,
    /// The height of its lower end. Without it, it has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bottom: Option<f64>,
    /// The height of its upper end. Without it, it has none. Limit: above `bottom`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub top: Option<f64>,
}

/// Heights of the ground on a grid, its lower left corner at the origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeightField {
    /// Width of the square cells. Limit: > 0.
    pub cell: f64,
    /// How many heights are in a row along x. Limit: at least 2.
    pub columns: u64,
    /// The heights, row by row. Limit: at least two full rows.
    pub heights: Vec<f64>,
}

/// Triangles from a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    /// A Wavefront OBJ file, in metres; a relative name starts from the scene file's folder.
    pub file: String,
    /// Which axis of the file points up.
    #[serde(default, skip_serializing_if = "is_default")]
    pub up: Up,
}

/// Which axis of a file points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Up {
    /// y, as most programs write OBJ.
    #[default]
    Y,
    /// z, as here.
    Z,
}

/// From where a surface is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SeenFrom {
    /// From outside: a solid.
    #[default]
    Outside,
    /// From inside: a container.
    Inside,
    /// Hollow: everybody stays on the side they are on.
    Both,
}

/// A path that behaviours refer to by its name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pathway {
    /// The name that behaviours call it by.
    pub name: String,
    /// Its points in order. Limit: at least 2, at least 3 if it is cyclic.
    pub points: Vec<Position>,
    /// How far it reaches to all sides, metres. Without it, `radii` say so. Limit: >= 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
    /// The same for each of its segments.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radii: Option<Vec<f64>>,
    /// Whether it goes on from the last point to the first.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub cyclic: bool,
}
