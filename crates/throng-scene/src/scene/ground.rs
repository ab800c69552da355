//! Ground and regions of it.

use super::{Annulus, Circle, Point};
use crate::geometry::{points, signed_area};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The walkable ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Walkable {
    /// A rectangle.
    Rectangle(Rectangle),
    /// The union of several rectangles.
    Rectangles(Vec<Rectangle>),
    /// A ring: a corridor without ends.
    Ring(Annulus),
    /// A polygon with holes.
    Polygon(Area),
    /// The union of several polygons with holes.
    Polygons(Vec<Area>),
    /// The ground of a floor plan, without its solid parts.
    File(PlanFile),
}

/// A floor plan: WKT, GeoJSON, DXF, SVG or OBJ. In files its name, or `{ name = "hall.dxf", unit = 0.001 }`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(from = "Said", into = "Said")]
pub struct PlanFile {
    /// The file. A relative name refers to the scene file's folder.
    pub name: String,
    /// The length of its unit, metres. Without it, the unit that the file states, or a metre, in SVG a centimetre.
    /// Limit: > 0.
    pub unit: Option<f64>,
    /// The level of a mesh, from 1 for the lowest. Without it, the largest.
    pub level: Option<u64>,
}

/// A floor plan as scene files write it.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected the name of a floor plan, or { name = .., unit = .., level = .. }")]
enum Said {
    /// The file. A relative name refers to the scene file's folder.
    Name(String),
    /// The file, and how it is read.
    Table(PlanTable),
}

/// A floor plan, and how it is read.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PlanTable {
    /// The file. A relative name refers to the scene file's folder.
    name: String,
    /// The length of its unit, metres. Without it, the unit that the file states, or a metre, in SVG a centimetre.
    /// Limit: > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<f64>,
    /// The level of a mesh, from 1 for the lowest. Without it, the largest.
    #[serde(skip_serializing_if = "Option::is_none")]
    level: Option<u64>,
}

impl From<Said> for PlanFile {
    fn from(said: Said) -> Self {
        match said {
            Said::Name(name) => Self { name, ..Self::default() },
            Said::Table(PlanTable { name, unit, level }) => Self { name, unit, level },
        }
    }
}

impl From<PlanFile> for Said {
    fn from(plan: PlanFile) -> Self {
        match plan {
            PlanFile { name, unit: None, level: None } => Self::Name(name),
            PlanFile { name, unit, level } => Self::Table(PlanTable { name, unit, level }),
        }
    }
}

/// A polygon with holes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Area {
    /// Corners of the boundary, in either orientation, the first not repeated. Limit: at least 3.
    pub outer: Vec<Point>,
    /// Corners of each hole.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holes: Vec<Vec<Point>>,
}

impl Area {
    /// Returns its area, m².
    pub(crate) fn size(&self) -> f64 {
        let size = |ring: &Vec<Point>| signed_area(&points(ring)).abs();
        size(&self.outer) - self.holes.iter().map(size).sum::<f64>()
    }

    /// Returns the area in the form that the world takes.
    pub(crate) fn walkable(&self) -> throng::Walkable {
        throng::Walkable { outer: points(&self.outer), holes: self.holes.iter().map(|hole| points(hole)).collect() }
    }
}

/// A rectangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rectangle {
    /// Its centre.
    pub center: Point,
    /// Its sides along x and y, before it is turned. Limit: > 0.
    pub size: Point,
    /// Rotation about its centre, degrees counter-clockwise.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub rotation: f64,
}

impl Rectangle {
    /// Returns the rectangle with sides along the axes between two opposite corners.
    pub fn between(a: Point, b: Point) -> Self {
        Self {
            center: [(a[0] + b[0]) * 0.5, (a[1] + b[1]) * 0.5],
            size: [(a[0] - b[0]).abs(), (a[1] - b[1]).abs()],
            rotation: 0.0,
        }
    }
}

/// A region of the ground that a goal covers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Region {
    /// A disc (represented by a polygon with 32 corners on its circle).
    Disc(Circle),
    /// A rectangle.
    Rectangle(Rectangle),
    /// The corners of a simple polygon, in either orientation.
    Polygon(Vec<Point>),
}

pub(super) fn is_zero(x: &f64) -> bool {
    *x == 0.0
}
