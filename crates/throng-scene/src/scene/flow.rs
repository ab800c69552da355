//! Vector fields: velocities at every place, that lead crowds and that swarms follow.

use super::steer::{Position, What, parameters};
use super::{Number, Point, PointGoal, Region};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A field that groups and other fields refer to by its name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Field {
    /// The name that groups, behaviours and fields below it call it by.
    pub name: String,
    /// What it says.
    pub flow: Flow,
}

/// A velocity at every place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Flow {
    /// The same everywhere, m/s.
    Uniform(Position),
    /// Round a place, everywhere at one speed.
    Whirl(Whirl),
    /// To a place, or away from it.
    Towards(Towards),
    /// A field of the scene, by its name.
    Named(String),
    /// Velocities wanted at some places, and everywhere between them (Jin et al. 2008).
    Sketch(Sketch),
    /// As a sketch, in space.
    SketchInSpace(SketchInSpace),
    /// What was painted with a brush.
    Paint(Paint),
    /// What the pixels of a picture (PNG) say.
    Picture(Picture),
    /// What a file says: a table (CSV), or a vector field of Menge's (text).
    Table(Table),
    /// The way to a goal that costs the least time, from everywhere.
    ToGoal(ToGoal),
    /// The way to a target through space, clear of what is solid: where a swarm goes (Wang et al. 2014).
    ThroughSpace(ThroughSpace),
    /// Eddies by chance, without sources and sinks (Bridson et al. 2007).
    Noise(Noise),
    /// The sum of fields.
    Sum(Vec<FlowPart>),
    /// The mean of fields, directions and speeds each on their own.
    Blend(Vec<FlowPart>),
    /// Another field at some times.
    Keyframes(Keyframes),
    /// A field led round what is solid.
    AroundWalls(AroundWalls),
    /// A field sampled on a grid: as fast as any, however dear it is.
    Sampled(Sampled),
}

parameters! {
    /// Round a place, everywhere at one speed.
    Whirl {
        /// Its middle.
        center: Position,
        /// The speed, m/s; negative: clockwise.
        speed: f64,
    }

    /// To a place, everywhere at one speed.
    Towards {
        /// The place.
        at: Position,
        /// The speed, m/s; negative: away from it.
        speed: f64,
        /// Nearer than this, metres, it is slower, in proportion. Without it, 0.5. Limit: > 0.
        slow: Option<f64>,
        /// Beyond this distance it says nothing, metres. Without it, everywhere. Limit: > 0.
        within: Option<f64>,
    }

    /// A field through anchors: those given, those of strokes and of stamps, less those that were erased.
    Sketch {
        /// Velocities at places.
        anchors: Option<Vec<Anchor>>,
        /// Strokes: lines to go along.
        strokes: Option<Vec<Stroke>>,
        /// Stamps: whirls, sources, sinks and saddles.
        stamps: Option<Vec<Stamp>>,
        /// Where anchors are taken out again.
        erase: Option<Vec<Eraser>>,
        /// How the influence of an anchor falls off. Without it, as a thin plate bends.
        kernel: Option<Kernel>,
        /// 0: through the anchors; more: past them, more evenly. 1e-6 to 1e-2 smooths strokes drawn by hand. Without it, 0. Limit: >= 0.
        smoothing: Option<f64>,
        /// Metres beyond the hull of the anchors at which 1/e of the field is left. Without it, 10. Limit: > 0.
        fade: Option<f64>,
        /// It is nowhere faster, m/s. Without it, one and a half times the fastest anchor. Limit: > 0.
        max_speed: Option<f64>,
        /// Width of the cells of the grid that it is sampled on, metres. Without it, 0.5, or more in wide scenes. Limit: > 0.
        cell: Option<f64>,
    }

    /// A velocity wanted at a place.
    Anchor {
        /// Where.
        at: Point,
        /// The velocity, m/s.
        velocity: Point,
        /// How many times as far it reaches along its velocity as across; only with a kernel that has a reach. Without it, 1.
        /// Limit: 1 to 100.
        stretch: Option<f64>,
    }

    /// A field through anchors in space, for those who fly.
    SketchInSpace {
        /// Velocities at places.
        anchors: Vec<AnchorInSpace>,
        /// As that of a sketch.
        kernel: Option<Kernel>,
        /// As that of a sketch.
        smoothing: Option<f64>,
        /// As that of a sketch, beyond the box that holds the anchors.
        fade: Option<f64>,
        /// As that of a sketch.
        max_speed: Option<f64>,
    }

    /// A velocity wanted at a place in space.
    AnchorInSpace {
        /// Where.
        at: Position,
        /// The velocity, m/s.
        velocity: Position,
    }

    /// A line to go along.
    Stroke {
        /// Its points, at least two.
        points: Vec<Point>,
        /// How fast, m/s; negative: against it. Without it, 1.3.
        speed: Option<f64>,
        /// How far apart its anchors are, metres. Without it, 2. Limit: > 0.
        spacing: Option<f64>,
        /// As that of an anchor.
        stretch: Option<f64>,
    }

    /// Anchors on a circle and in its middle.
    Stamp {
        /// Its middle.
        at: Point,
        /// What the field does about it.
        kind: StampKind,
        /// Metres. Limit: > 0.
        radius: f64,
        /// How fast the field is on the circle, m/s; negative: the other way. Without it, 1.3.
        speed: Option<f64>,
    }

    /// A round place without anchors.
    Eraser {
        /// Its middle.
        at: Point,
        /// Metres. Limit: > 0.
        radius: f64,
    }

    /// A kernel with a reach.
    Wendland {
        /// Beyond this distance an anchor says nothing, metres. Limit: > 0.
        reach: f64,
    }

    /// A bend and no reach.
    ThinPlate {}

    /// What was painted, stroke after stroke.
    Paint {
        /// The lower left corner of what can be painted.
        min: Point,
        /// The upper right corner.
        max: Point,
        /// Width of its cells, metres. Without it, 0.5. Limit: > 0.
        cell: Option<f64>,
        /// What was there before. Without it, nothing.
        on: Option<Box<Flow>>,
        /// The strokes.
        strokes: Vec<BrushStroke>,
    }

    /// A stroke of the brush.
    BrushStroke {
        /// The points of the line it goes along.
        points: Vec<Point>,
        /// The speed that it leaves, along the line, m/s; negative: against it. Without it, 1.3.
        speed: Option<f64>,
        /// How far the brush reaches, metres. Without it, 2. Limit: > 0.
        radius: Option<f64>,
        /// How much it covers of what was there. Without it, 1: all. Limit: 0 to 1.
        strength: Option<f64>,
        /// Part of the radius within which it is in full. Without it, 0.5. Limit: 0 to 1.
        hardness: Option<f64>,
        /// It rubs out what is there.
        erase: Option<bool>,
    }

    /// What the pixels of a picture say.
    Picture {
        /// The PNG; the name is relative to the scene file.
        file: String,
        /// Where its lower left corner is.
        min: Point,
        /// Where its upper right corner is.
        max: Point,
        /// How a pixel says a velocity. Without it, as a flow map.
        says: Option<Says>,
        /// The greatest speed along x or y (flow map), or of all (direction), m/s. Without it, 1.3. Limit: > 0.
        speed: Option<f64>,
    }

    /// What a table says.
    Table {
        /// A CSV with columns x, y, vx, vy, whose places are all corners of a grid with square cells; or, with another
        /// extension, a vector field of Menge's. The name is relative to the scene file.
        file: String,
    }

    /// The way to a goal.
    ToGoal {
        /// Where to: the nearest of these.
        to: Vec<Destination>,
        /// How fast, m/s. Without it, 1.3. Limit: > 0.
        speed: Option<f64>,
        /// Radius of the bodies, metres: nobody is led nearer to a wall. Without it, 0.25. Limit: >= 0.
        radius: Option<f64>,
        /// How dear it is to go close to walls, square metres: at a distance `d` a metre costs `clearance / (d - radius)^2` more. Without
        /// it, 0.05. Limit: >= 0.
        clearance: Option<f64>,
        /// What a metre costs more, painted: 1 is twice as dear.
        cost: Option<Map>,
        /// It leads round jams.
        jams: Option<Jams>,
        /// Width of the cells, metres. Without it, 0.25, or more in wide scenes. Limit: > 0.
        cell: Option<f64>,
        /// The lower left corner of the ground that ways are searched on. Without it, that of the scene.
        min: Option<Point>,
        /// The upper right corner. Without it, that of the scene.
        max: Option<Point>,
    }

    /// How a way to a goal leads round jams.
    Jams {
        /// The density at which ground costs twice as much, people a square metre. Without it, 1. Limit: > 0.
        weary: Option<f64>,
        /// Metres over which people are counted. Without it, 1.5. Limit: > 0.
        radius: Option<f64>,
        /// Seconds after which it looks again. Without it, 0.5. Limit: > 0.
        every: Option<f64>,
        /// What part of what it saw last is what it sees now, the rest is from before. Without it, 0.5. Limit: > 0, at most 1.
        part: Option<f64>,
    }

    /// The way to a target through space.
    ThroughSpace {
        /// The target.
        to: Position,
        /// How near is there, metres. Without it, 0.1. Limit: >= 0.
        tolerance: Option<f64>,
        /// How fast, m/s. Without it, 1. Limit: > 0.
        speed: Option<f64>,
        /// Where the swarm comes from: then it follows one smooth way from there, and from elsewhere joins it.
        from: Option<Position>,
        /// How far from that way it leads along it, metres. Without it, 1. Limit: > 0.
        tube: Option<f64>,
        /// How far that way keeps off what is solid where there is room, metres. Without it, 0.5. Limit: >= 0.
        distance: Option<f64>,
        /// What is solid: names of surfaces and of obstacles, `"obstacles"`, or `"everything"`. Without it, nothing.
        walls: Option<What>,
        /// Radius of the bodies, metres. Without it, 0.05. Limit: >= 0.
        radius: Option<f64>,
        /// As that of a way to a goal. Without it, 0.05. Limit: >= 0.
        clearance: Option<f64>,
        /// Width of the cubes that the way is searched in, metres. Without it, 0.25. Limit: > 0.
        cell: Option<f64>,
        /// The corner of the space with the least coordinates.
        min: Position,
        /// The corner with the greatest.
        max: Position,
    }

    /// Eddies by chance.
    Noise {
        /// How wide eddies are, metres. Limit: > 0.
        length: f64,
        /// How long they live, seconds. Without it, for ever. Limit: > 0.
        period: Option<f64>,
        /// The root of the mean square of the speed, m/s. Limit: >= 0.
        speed: f64,
        /// Octaves, each half as wide. Without it, 1. Limit: 1 to 16.
        octaves: Option<u32>,
        /// Where it flows. Without it, along the ground.
        potential: Option<Potential>,
        /// Others with another seed. Without it, 0.
        seed: Option<u64>,
        /// What it flows along: names of surfaces and of obstacles, `"obstacles"`, or `"everything"`. Without it, nothing.
        walls: Option<What>,
        /// How far walls change it, metres. Without it, as wide as eddies are. Limit: > 0.
        width: Option<f64>,
    }

    /// A field that is part of another.
    FlowPart {
        /// The field.
        of: Flow,
        /// How much of it. Without it, 1. Limit: finite; in a blend >= 0.
        weight: Option<f64>,
        /// Where: the weight is multiplied by it. Without it, everywhere.
        map: Option<Map>,
    }

    /// Fields at some times, and the mean of the two before and after between them.
    Keyframes {
        /// The fields and when they are as they say.
        frames: Vec<Keyframe>,
        /// Seconds after which all comes again. Without it, the last stays.
        period: Option<f64>,
    }

    /// A field at a time.
    Keyframe {
        /// Seconds.
        at: f64,
        /// The field.
        of: Flow,
    }

    /// A field led round what is solid: near it, what leads into it is taken out.
    AroundWalls {
        /// The field.
        of: Box<Flow>,
        /// From how far away on, metres. Without it, 1. Limit: > 0.
        width: Option<f64>,
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

    /// A number at every place: painted, or the brightness of a picture. Beyond its rim 0.
    Map {
        /// The lower left corner.
        min: Point,
        /// The upper right corner.
        max: Point,
        /// A PNG: black is 0, white is 1. The name is relative to the scene file.
        file: Option<String>,
        /// Width of the cells of what is painted, metres. Without it, 0.5. Limit: > 0.
        cell: Option<f64>,
        /// What is painted, stroke after stroke.
        strokes: Option<Vec<MapStroke>>,
    }

    /// A stroke of a brush that leaves a number.
    MapStroke {
        /// The points of the line it goes along.
        points: Vec<Point>,
        /// The number that it leaves. Without it, 1.
        value: Option<f64>,
        /// How far the brush reaches, metres. Without it, 2. Limit: > 0.
        radius: Option<f64>,
        /// How much it covers of what was there. Without it, 1: all. Limit: 0 to 1.
        strength: Option<f64>,
        /// Part of the radius within which it is in full. Without it, 0.5. Limit: 0 to 1.
        hardness: Option<f64>,
    }

    /// How fields govern a group.
    Governed {
        /// The field. Without it, only those that go with others.
        of: Option<Flow>,
        /// What part of where they go is the field's. Without it, 1: all of it. Limit: 0 to 1.
        ratio: Option<Number>,
        /// Where: the ratio is multiplied by it. Without it, everywhere.
        map: Option<Map>,
        /// Fields that go with others.
        around: Option<Vec<Interaction>>,
    }

    /// A field that goes with every agent of a group, and turns with it (Colas et al. 2022).
    Interaction {
        /// The group, or the mover.
        source: String,
        /// The velocity near it: metres from its centre, x ahead of it, y to its left.
        of: Flow,
        /// Where to look near it, in the same way. Without it, wherever one goes.
        looks: Option<Flow>,
        /// How much it counts beside others and the field. Without it, 1. Limit: > 0.
        weight: Option<f64>,
        /// Part of its own velocity that is added; 1 for those who come along. Without it, 0.
        carried: Option<f64>,
        /// Beyond this distance it says nothing, metres. Without it, everywhere. Limit: > 0.
        reach: Option<f64>,
    }
}

/// Where a way leads to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Destination {
    /// A point.
    Point(PointGoal),
    /// A region, entered anywhere.
    Area(Region),
}

/// What noise is the curl of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Potential {
    /// Along the ground.
    #[default]
    Plane,
    /// In space.
    Space,
    /// In space, faster, and less even.
    Crossed,
}

/// What a stamp does about its middle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StampKind {
    /// Round it, counter-clockwise.
    Vortex,
    /// Away from it.
    Source,
    /// To it.
    Sink,
    /// Away along x, to it along y.
    Saddle,
}

/// How the influence of an anchor falls off.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Kernel {
    /// As a thin plate bends: smooth everywhere, never quite ending.
    ThinPlate(ThinPlate),
    /// Wendland's, that ends: what is sketched here changes nothing there.
    Wendland(Wendland),
}

/// How a pixel says a velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Says {
    /// Red says how fast along x, green along y: half of the range is 0.
    #[default]
    FlowMap,
    /// The hue says the direction (red: +x, then counter-clockwise), saturation and brightness how fast.
    Direction,
}
