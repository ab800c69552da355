//! Surfaces and paths that behaviours steer by.

use super::Point;
use super::ground::is_zero;
use super::steer::Position;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A surface that behaviours refer to by its name, to avoid it, follow it, stay in it or hide behind it. It is solid
/// only to groups that name it as `solid`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Surface {
    /// The name by which behaviours refer to it.
    pub name: String,
    /// Its shape, about its own origin.
    pub shape: Form,
    /// Position of its own origin. Without it, at `[0, 0]`.
    #[serde(default, skip_serializing_if = "is_default")]
    pub at: Position,
    /// Direction of its own x axis, degrees counter-clockwise from +x.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub heading: f64,
    /// Elevation of its own x axis, degrees.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub pitch: f64,
    /// Rotation about its own x axis, applied first, degrees: its y axis turns upwards.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub roll: f64,
    /// The side from which it is seen.
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
    /// A sphere about the origin.
    Sphere(Ball),
    /// A box about the origin.
    Box(Block),
    /// Everything on one side of a plane through the origin.
    Plane(HalfSpace),
    /// A rectangle without thickness about the origin, in the plane of its own x and y axes: two sides, no inside.
    Rectangle(Sheet),
    /// A cylinder with flat ends.
    Cylinder(Rod),
    /// A cylinder with round ends.
    Capsule(Rod),
    /// A prism over a polygon.
    Prism(Column),
    /// Heights of the ground on a grid.
    HeightField(HeightField),
    /// Triangles from a file.
    Mesh(MeshFile),
}

/// A sphere.
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
    /// The normal that points outside, a vector of any length but 0.
    pub normal: [f64; 3],
}

/// A rectangle without thickness.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sheet {
    /// Its extents along x and y. Limit: > 0.
    pub size: Point,
}

/// A cylinder or capsule about a line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rod {
    /// Start of the line.
    pub from: [f64; 3],
    /// End of the line.
    pub to: [f64; 3],
    /// The radius. Limit: > 0.
    pub radius: f64,
}

/// A prism over a polygon.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Column {
    /// Corners of the polygon, in either orientation. Limit: at least 3.
    pub corners: Vec<Point>,
    /// The height of its lower end. Without it, it is unbounded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bottom: Option<f64>,
    /// The height of its upper end. Without it, it is unbounded. Limit: above `bottom`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub top: Option<f64>,
}

/// Heights of the ground on a grid, its lower left corner at the origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeightField {
    /// Width of the square cells. Limit: > 0.
    pub cell: f64,
    /// The number of heights in a row along x. Limit: at least 2.
    pub columns: u64,
    /// The heights, row by row. Limit: at least two full rows.
    pub heights: Vec<f64>,
}

/// Triangles from a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    /// A Wavefront OBJ file, in metres; a relative name refers to the scene file's folder.
    pub file: String,
    /// The axis of the file that points up.
    #[serde(default, skip_serializing_if = "is_default")]
    pub up: Up,
}

/// The axis of a file that points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Up {
    /// y, as most programs write OBJ.
    #[default]
    Y,
    /// z, as in scenes.
    Z,
}

/// The side from which a surface is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SeenFrom {
    /// From outside: a solid.
    #[default]
    Outside,
    /// From inside: a container.
    Inside,
    /// From both sides: a hollow surface. Agents stay on the side they are on.
    Both,
}

/// A path that behaviours refer to by its name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pathway {
    /// The name by which behaviours refer to it.
    pub name: String,
    /// Its points in order. Limit: at least 2, at least 3 if it is cyclic.
    pub points: Vec<Position>,
    /// Radius of the tube around it, metres. Without it, `radii` defines it. Limit: >= 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
    /// The radius of each segment, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radii: Option<Vec<f64>>,
    /// Whether it continues from the last point to the first.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub cyclic: bool,
}
