//! Vector fields: a velocity at every place, which guides crowds and swarms.

use super::steer::Position;
use super::{Number, Point, PointGoal, Region};
use crate::registry::{Fields, Flow, described};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Defines tables of parameters.
macro_rules! parameters {
    ($($(#[$meta:meta])* $name:ident { $($(#[$about:meta])* $key:ident: $type:ty,)* })*) => { $(
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub struct $name {
            $($(#[$about])* pub $key: $type,)*
        }
    )* };
}

/// A field that groups and other fields refer to by its name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Field {
    /// The name by which groups, behaviours and later fields refer to it.
    pub name: String,
    /// The velocities of the field.
    pub flow: Flow,
}

described! {
    Flow in Fields:
    /// A field of the scene, by its name.
    Named = "named",
    /// Velocities given at some places and interpolated between them (Jin et al. 2008).
    Sketch = "sketch",
    /// A sketch in space.
    SketchInSpace = "sketch_in_space",
    /// A field painted with a brush. Where the paint is thin, it governs a group only in part.
    Paint = "paint",
    /// A field encoded in the pixels of a picture (PNG). It is zero at transparent pixels.
    Picture = "picture",
    /// A field from a file: a table (CSV), or a vector field of Menge (text).
    Table = "table",
    /// The direction of the cheapest path to a goal, from everywhere.
    ToGoal = "to_goal",
    /// A field sampled on a grid: fast to evaluate, however expensive the field is.
    Sampled = "sampled",
}

/// A field of the scene, by its name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(inline)]
pub struct Named(pub String);

parameters! {
    /// A field through anchors: the given anchors and those of strokes and stamps, without the erased ones.
    Sketch {
        /// Velocities at given places.
        anchors: Option<Vec<Anchor>>,
        /// Strokes: lines that the field follows.
        strokes: Option<Vec<Stroke>>,
        /// Stamps: whirls, sources, sinks and saddles.
        stamps: Option<Vec<Stamp>>,
        /// Places from which anchors are removed.
        erase: Option<Vec<Eraser>>,
        /// The kernel: how the influence of an anchor falls off. Without it, `thin_plate`.
        kernel: Option<Kernel>,
        /// 0: the field passes through the anchors; above 0 it passes near them and is smoother. 1e-6 to 1e-2 smooths
        /// strokes drawn by hand. Without it, 0. Limit: >= 0.
        smoothing: Option<f64>,
        /// Metres beyond the hull of the anchors over which the field falls to 1/e. Without it, 10. Limit: > 0.
        fade: Option<f64>,
        /// Greatest speed of the field, m/s. Without it, one and a half times that of the fastest anchor. Limit: > 0.
        max_speed: Option<f64>,
        /// Width of the cells of the sampling grid, metres. Without it, 0.5, or more in wide scenes and with many
        /// anchors. Limit: > 0.
        cell: Option<f64>,
    }

    /// A velocity given at a place.
    Anchor {
        /// The place.
        at: Point,
        /// The velocity, m/s.
        velocity: Point,
        /// Ratio of the reach along its velocity to the reach across it; only for a kernel with a reach. Without it, 1.
        /// Limit: 1 to 100.
        stretch: Option<f64>,
    }

    /// A field through anchors in space, for agents that fly.
    SketchInSpace {
        /// Velocities at given places.
        anchors: Vec<AnchorInSpace>,
        /// As for a sketch.
        kernel: Option<Kernel>,
        /// As for a sketch.
        smoothing: Option<f64>,
        /// As for a sketch, beyond the box that holds the anchors.
        fade: Option<f64>,
        /// As for a sketch.
        max_speed: Option<f64>,
    }

    /// A velocity given at a place in space.
    AnchorInSpace {
        /// The place.
        at: Position,
        /// The velocity, m/s.
        velocity: Position,
    }

    /// A line that the field follows.
    Stroke {
        /// The points of the line, at least two.
        points: Vec<Point>,
        /// Speed along the line, m/s; negative: against it. Without it, 1.3.
        speed: Option<f64>,
        /// Distance between its anchors, metres. Without it, 2. Limit: > 0.
        spacing: Option<f64>,
        /// As for an anchor.
        stretch: Option<f64>,
    }

    /// Anchors on a circle and in its centre.
    Stamp {
        /// The centre.
        at: Point,
        /// The pattern of the field around the centre.
        kind: StampKind,
        /// Radius of the circle, metres. Limit: > 0.
        radius: f64,
        /// Speed of the field on the circle, m/s; negative: reversed. Without it, 1.3.
        speed: Option<f64>,
    }

    /// A disc without anchors.
    Eraser {
        /// The centre.
        at: Point,
        /// Radius, metres. Limit: > 0.
        radius: f64,
    }

    /// A kernel with a finite reach.
    Wendland {
        /// Beyond this distance an anchor has no influence, metres. Limit: > 0.
        reach: f64,
    }

    /// The kernel of a thin plate, without a finite reach.
    ThinPlate {}

    /// A painted field, stroke by stroke.
    Paint {
        /// The lower left corner of the canvas.
        min: Point,
        /// The upper right corner of the canvas.
        max: Point,
        /// Width of the cells, metres. Without it, 0.5. Limit: > 0.
        cell: Option<f64>,
        /// The field below the strokes. Without it, nothing.
        on: Option<Box<Flow>>,
        /// The strokes, in order.
        strokes: Vec<BrushStroke>,
    }

    /// A stroke of the brush.
    BrushStroke {
        /// The points of the line that the brush follows.
        points: Vec<Point>,
        /// Speed that the stroke paints, along the line, m/s; negative: against it. Without it, 1.3.
        speed: Option<f64>,
        /// Radius of the brush, metres. Without it, 2. Limit: > 0.
        radius: Option<f64>,
        /// How much of the field below is covered. Without it, 1: all. Limit: 0 to 1.
        strength: Option<f64>,
        /// Part of the radius within which the brush has its full strength. Without it, 0.5. Limit: 0 to 1.
        hardness: Option<f64>,
        /// Whether the stroke erases.
        erase: Option<bool>,
    }

    /// A field encoded in the pixels of a picture.
    Picture {
        /// The PNG file; the name is relative to the scene file.
        file: String,
        /// Position of the lower left corner.
        min: Point,
        /// Position of the upper right corner.
        max: Point,
        /// The encoding of velocities. Without it, `flow_map`.
        encoding: Option<PixelEncoding>,
        /// The greatest speed along x or y (`flow_map`), or the greatest speed (`direction`), m/s. Without it, 1.3.
        /// Limit: > 0.
        speed: Option<f64>,
    }

    /// A field from a table.
    Table {
        /// A CSV with columns x, y, vx, vy. Its places are all corners of a grid with square cells; or, with another
        /// extension, a vector field of Menge. The name is relative to the scene file.
        file: String,
    }

    /// The direction of the cheapest path to a goal.
    ToGoal {
        /// The goals: the path leads to the nearest of them.
        to: Vec<Destination>,
        /// Speed, m/s. Without it, 1.3. Limit: > 0.
        speed: Option<f64>,
        /// Radius of the bodies, metres: the path keeps this distance from walls. Without it, 0.25. Limit: >= 0.
        radius: Option<f64>,
        /// Cost of walking close to walls, square metres: at a distance `d` a metre costs `clearance / (d - radius)^2`
        /// more. Without it, 0.05. Limit: >= 0.
        clearance: Option<f64>,
        /// Additional cost of a metre, painted: 1 doubles the cost.
        cost: Option<Map>,
        /// Costs of crowded ground: the path leads around jams.
        jams: Option<Jams>,
        /// Width of the cells, metres. Without it, 0.25, or more in wide scenes. Limit: > 0.
        cell: Option<f64>,
        /// The lower left corner of the ground that is searched. Without it, that of the scene and 2 m around it.
        min: Option<Point>,
        /// The upper right corner. Without it, that of the scene and 2 m around it.
        max: Option<Point>,
    }

    /// How a path to a goal leads around jams.
    Jams {
        /// The density at which the cost of ground doubles, agents a square metre. Without it, 1. Limit: > 0.
        weary: Option<f64>,
        /// Metres over which agents are counted. Without it, 1.5. Limit: > 0.
        radius: Option<f64>,
        /// Seconds between two measurements. Without it, 0.5. Limit: > 0.
        every: Option<f64>,
        /// Weight of the latest measurement in the running mean. Without it, 0.5. Limit: > 0, at most 1.
        part: Option<f64>,
    }

    /// A field on a grid, as it is at the start.
    Sampled {
        /// The field.
        of: Box<Flow>,
        /// Width of the cells, metres. Without it, 0.5, or more in wide scenes. Limit: > 0.
        cell: Option<f64>,
        /// The lower left corner. Without it, that of the scene.
        min: Option<Point>,
        /// The upper right corner. Without it, that of the scene.
        max: Option<Point>,
    }

    /// A number at every place: painted, or the brightness of a picture. 0 outside its rectangle.
    Map {
        /// The lower left corner.
        min: Point,
        /// The upper right corner.
        max: Point,
        /// A PNG: black is 0, white is 1. The name is relative to the scene file.
        file: Option<String>,
        /// Width of the cells of the painting, metres. Without it, 0.5. Limit: > 0.
        cell: Option<f64>,
        /// The strokes, in order.
        strokes: Option<Vec<MapStroke>>,
    }

    /// A stroke of a brush that paints a number.
    MapStroke {
        /// The points of the line that the brush follows.
        points: Vec<Point>,
        /// The number that the stroke paints. Without it, 1.
        value: Option<f64>,
        /// Radius of the brush, metres. Without it, 2. Limit: > 0.
        radius: Option<f64>,
        /// How much of the values below is covered. Without it, 1: all. Limit: 0 to 1.
        strength: Option<f64>,
        /// Part of the radius within which the brush has its full strength. Without it, 0.5. Limit: 0 to 1.
        hardness: Option<f64>,
    }

    /// The fields that guide a group.
    Governed {
        /// The field. Without it, only the fields of `around`.
        of: Option<Flow>,
        /// Weight of the field against the agents' own routes. Without it, 1: the field alone. Limit: 0 to 1.
        ratio: Option<Number>,
        /// A map that multiplies the ratio. Without it, the ratio is the same everywhere.
        map: Option<Map>,
        /// Interaction fields, which move with other agents.
        around: Option<Vec<Interaction>>,
    }

    /// An interaction field: it moves and turns with every agent of a group (Colas et al. 2022).
    Interaction {
        /// The name of the group or mover that carries the field.
        source: String,
        /// The velocity near the agent that carries the field: metres from its centre, x ahead of it, y to its left.
        of: Flow,
        /// The direction in which agents face, in the same coordinates. Without it, they face the direction in which
        /// they move.
        looks: Option<Flow>,
        /// Weight relative to other interaction fields and the field. Without it, 1. Limit: > 0.
        weight: Option<f64>,
        /// Part of the carrier's velocity that is added; 1 moves agents along with it. Without it, 0.
        carried: Option<f64>,
        /// Beyond this distance it has no influence, metres. Without it, it has no limit. Limit: > 0.
        reach: Option<f64>,
    }
}

/// A goal of a path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Destination {
    /// A point.
    Point(PointGoal),
    /// A region, entered anywhere.
    Area(Region),
}

/// The pattern of the field around the centre of a stamp.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StampKind {
    /// Around the centre, counter-clockwise.
    Vortex,
    /// Away from the centre.
    Source,
    /// To the centre.
    Sink,
    /// Away from the centre along x, to it along y.
    Saddle,
}

/// How the influence of an anchor falls off.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Kernel {
    /// The kernel of a thin plate: smooth everywhere, with influence at any distance.
    ThinPlate(ThinPlate),
    /// Wendland's kernel, with a finite reach: an anchor has no influence beyond it.
    Wendland(Wendland),
}

/// The encoding of velocities in pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PixelEncoding {
    /// Red is the velocity along x, green along y: half of the range is 0.
    #[default]
    FlowMap,
    /// The hue is the direction (red: +x, then counter-clockwise), saturation and brightness are the speed.
    Direction,
}
