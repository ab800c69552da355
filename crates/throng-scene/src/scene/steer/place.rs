//! Behaviours that ask the world's geometry: obstacles, containers, walls, paths.

use super::{Steer, Target, parameters};
use crate::scene::Point;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;

parameters! {
    /// Goes round what is in the way.
    #[derive(Default)]
    AvoidObstacles {
        /// What it avoids. Without it, everything.
        what: Option<What>,
        /// Where it would like to go: on that side it passes. Without it, where its journey leads, or straight ahead.
        towards: Option<Target>,
        /// How many seconds ahead it looks; farther if it turns slowly. Without it, 2. Limit: > 0.
        horizon: Option<f64>,
        /// How far from obstacles its body stays, metres. Without it, 0.15. Limit: >= 0.
        gap: Option<f64>,
        /// How many seconds it keeps to a side of an obstacle that is no longer in the way. Without it, 1.5. Limit: >= 0.
        keeps: Option<f64>,
    }
    /// Does what a part would, and turns and brakes by a map of what is solid: for fast vehicles that turn in wide circles.
    AvoidMap {
        /// What is solid. Without it, everything.
        what: Option<What>,
        /// The least corner of the map; beyond its rim everything is solid.
        min: Point,
        /// The greatest corner.
        max: Point,
        /// Width of its square cells, metres; a cell is solid where something is nearer to its middle than half of that.
        /// Without it, 1. Limit: > 0, at most 1,000,000 cells in all.
        cell: Option<f64>,
        /// How many seconds ahead it looks at its top speed. Without it, 2.1. Limit: > 0.
        horizon: Option<f64>,
        /// How much farther than its body its corridor reaches to either side at its top speed, metres. Without it, 1.5.
        /// Limit: >= 0.
        margin: Option<f64>,
        /// Whether it expects to go on along the arc that it is on; else straight ahead. Without it, `true`.
        curved: Option<bool>,
        /// What it would do.
        of: Box<Steer>,
    }
    /// Turns away from what its whiskers touch.
    #[derive(Default)]
    Whiskers {
        /// What they feel. Without it, everything.
        what: Option<What>,
        /// The rays. Without them, one of 2 m ahead, and one of 1 m to each side, 35° from ahead.
        rays: Option<Vec<Ray>>,
        /// How far off what they touch the place is that it goes to, metres. Without it, 1. Limit: > 0.
        clearance: Option<f64>,
    }
    /// A whisker.
    Ray {
        /// Its length, metres. Limit: > 0.
        length: f64,
        /// How far to the left of ahead it points, degrees. Without it, 0. Limit: -180 to 180.
        angle: Option<f64>,
        /// How far to the left of the agent's centre it starts, metres. Without it, 0.
        beside: Option<f64>,
    }
    /// Stays on the side of a surface from which that is seen.
    Contain {
        /// The name of the surface.
        surface: String,
        /// How many seconds ahead it looks; farther if it turns slowly. Without it, 1. Limit: > 0.
        horizon: Option<f64>,
        /// How far to the sides it looks as well, half as far, degrees. Without it, 34.4. Limit: 0 to 180.
        angle: Option<f64>,
        /// How far from the surface its body stays, metres. Without it, 0.1. Limit: >= 0.
        gap: Option<f64>,
    }
    /// Goes along a path.
    FollowPath {
        /// The name of the path.
        path: String,
        /// In the order of its points or against it. Without it, `"forward"`.
        way: Option<Direction>,
        /// How many seconds ahead it looks, and how far along the path the place is that it seeks, at its speed. Without
        /// it, 0.5. Limit: > 0.
        horizon: Option<f64>,
        /// How far from the end of a path that is no ring it begins to slow down, metres. Without it, 1. Limit: >= 0.
        slowing_distance: Option<f64>,
        /// Part of the path's radius within which it is led back when it is about to leave the path. Without it, 1: it keeps
        /// to the edge that bends lead it to. Limit: 0 to 1.
        inner: Option<f64>,
    }
    /// Comes back to a path that it is about to leave, whichever way it goes.
    StayOnPath {
        /// The name of the path.
        path: String,
        /// How many seconds ahead it looks. Without it, 1. Limit: >= 0.
        horizon: Option<f64>,
    }
    /// Goes along the nearest wall.
    #[derive(Default)]
    FollowWall {
        /// What are walls. Without it, everything.
        what: Option<What>,
        /// How far from the wall its centre goes, metres. Without it, 1. Limit: > 0.
        offset: Option<f64>,
        /// How many seconds ahead it looks. Without it, 0.3. Limit: > 0.
        horizon: Option<f64>,
        /// How near a wall must be, metres. Without it, 5. Limit: > 0.
        range: Option<f64>,
    }
    /// Hides from somebody behind an obstacle.
    Hide {
        /// From whom.
        from: Target,
        /// Behind what. Without it, everything.
        what: Option<What>,
        /// How far from the obstacle its body stays, metres. Without it, 0.2. Limit: >= 0.
        gap: Option<f64>,
        /// Who is farther away is nobody to hide from, metres. Without it, it hides at any distance. Limit: > 0.
        range: Option<f64>,
        /// How far from its place it begins to slow down, metres. Without it, 1. Limit: >= 0.
        slowing_distance: Option<f64>,
    }
    /// Walks along a path with others, and pushes nobody.
    CrowdPath {
        /// The name of the path.
        path: String,
        /// In the order of its points or against it. Without it, `"forward"`.
        way: Option<Direction>,
        /// How many seconds ahead it looks. Without it, 0.5. Limit: > 0.
        horizon: Option<f64>,
    }
    /// Goes through a door with others, in a queue, and pushes nobody.
    QueueAtDoor {
        /// Where to, behind the door. Without it, where its journey leads.
        goal: Option<Target>,
        /// Where the door is.
        door: Target,
        /// What the walls are. Without it, everything.
        what: Option<What>,
    }
}

/// In which direction a path is walked along.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// In the order of its points.
    Forward,
    /// Against it.
    Backward,
}

/// What a behaviour avoids, follows or hides behind, by name: surfaces, obstacles, `"obstacles"` (all of them and the
/// edges of the walkable ground) or `"everything"` (obstacles and surfaces). In files a name, or a list of names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct What(pub Vec<String>);

impl What {
    /// All obstacles, the edges of the walkable ground, and all surfaces.
    pub const EVERYTHING: &str = "everything";
    /// All obstacles, and the edges of the walkable ground.
    pub const OBSTACLES: &str = "obstacles";
}

impl Default for What {
    fn default() -> Self {
        Self(vec![Self::EVERYTHING.to_owned()])
    }
}

impl Serialize for What {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.0[..] {
            [name] => serializer.serialize_str(name),
            names => serializer.collect_seq(names),
        }
    }
}

impl<'de> Deserialize<'de> for What {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged, expecting = "a name, or a list of names")]
        enum Names {
            One(String),
            Several(Vec<String>),
        }
        Ok(Self(match Names::deserialize(deserializer)? {
            Names::One(name) => vec![name],
            Names::Several(names) => names,
        }))
    }
}

impl JsonSchema for What {
    fn schema_name() -> Cow<'static, str> {
        "What".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let name = json_schema!({ "type": "string" });
        json_schema!({
            "description": "Surfaces and obstacles by name, \"obstacles\", or \"everything\": a name, or a list of names.",
            "anyOf": [name, { "type": "array", "items": name, "minItems": 1 }]
        })
    }
}
