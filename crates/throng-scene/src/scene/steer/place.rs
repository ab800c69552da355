//! Behaviours that use the world's geometry: obstacles, containers, walls, paths.

use super::{Steer, Target, parameters};
use crate::scene::Point;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;

parameters! {
    /// Avoids obstacles in its way.
    #[derive(Default)]
    AvoidObstacles {
        /// The obstacles. Without it, everything.
        obstacles: Option<ObstacleNames>,
        /// The target: it decides the side on which the agent passes. Without it, the next goal of its journey, or
        /// straight ahead.
        towards: Option<Target>,
        /// How far ahead it looks, seconds; farther if it turns slowly. Without it, 2. Limit: > 0.
        horizon: Option<f64>,
        /// Gap between its body and obstacles, metres. Without it, 0.15. Limit: >= 0.
        gap: Option<f64>,
        /// Seconds for which it keeps to a side of an obstacle that is no longer in the way. Without it, 1.5. Limit: >=
        /// 0.
        keeps: Option<f64>,
    }
    /// Turns and brakes the motion of a part by a map of the obstacles: for fast vehicles with wide turning circles.
    AvoidMap {
        /// The obstacles. Without it, everything.
        obstacles: Option<ObstacleNames>,
        /// The corner of the map with the least coordinates; everything outside the map is solid.
        min: Point,
        /// The corner with the greatest coordinates.
        max: Point,
        /// Side of its square cells, metres; a cell is solid if an obstacle is nearer to its centre than half of that.
        /// Without it, 1. Limit: > 0, at most 1,000,000 cells in all.
        cell: Option<f64>,
        /// How far ahead it looks at top speed, seconds. Without it, 2.1. Limit: > 0.
        horizon: Option<f64>,
        /// Extent of its corridor beyond its body, to either side at top speed, metres. Without it, 1.5. Limit: >= 0.
        margin: Option<f64>,
        /// Whether it predicts its motion along its present arc; else straight ahead. Without it, `true`.
        curved: Option<bool>,
        /// The behaviour of the part.
        of: Box<Steer>,
    }
    /// Moves away from what its whiskers touch.
    #[derive(Default)]
    Whiskers {
        /// The obstacles. Without it, everything.
        obstacles: Option<ObstacleNames>,
        /// The whiskers. Without them, one of 2 m ahead, and one of 1 m to each side, 35° from ahead.
        rays: Option<Vec<Ray>>,
        /// Distance of the point that it moves to from the touched surface, metres. Without it, 1. Limit: > 0.
        clearance: Option<f64>,
    }
    /// A whisker.
    Ray {
        /// Its length, metres. Limit: > 0.
        length: f64,
        /// Its angle to the left of ahead, degrees. Without it, 0. Limit: -180 to 180.
        angle: Option<f64>,
        /// Offset of its start to the left of the agent's centre, metres. Without it, 0.
        beside: Option<f64>,
    }
    /// Stays on the side of a surface from which the surface is seen.
    Contain {
        /// The name of the surface.
        surface: String,
        /// How far ahead it looks, seconds; farther if it turns slowly. Without it, 1. Limit: > 0.
        horizon: Option<f64>,
        /// Angle of two further looks to the sides, half as far, degrees. Without it, 34.4. Limit: 0 to 180.
        angle: Option<f64>,
        /// Gap between its body and the surface, metres. Without it, 0.1. Limit: >= 0.
        gap: Option<f64>,
    }
    /// Moves along a path.
    FollowPath {
        /// The name of the path.
        path: String,
        /// Whether it moves in the order of the path's points or against it. Without it, `"forward"`.
        direction: Option<Direction>,
        /// How far ahead it looks, and how far ahead along the path the point is that it seeks, seconds at its speed.
        /// Without it, 0.5. Limit: > 0.
        horizon: Option<f64>,
        /// Distance from the end of an open path at which it starts to slow down, metres. Without it, 1. Limit: >= 0.
        slowing_distance: Option<f64>,
        /// Part of the path's radius to which it is led back if it is about to leave the path. Without it, 1: it keeps
        /// to the edge that it reaches in bends. Limit: 0 to 1.
        inner: Option<f64>,
    }
    /// Returns to a path that it is about to leave, whichever way it moves.
    StayOnPath {
        /// The name of the path.
        path: String,
        /// How far ahead it looks, seconds. Without it, 1. Limit: >= 0.
        horizon: Option<f64>,
    }
    /// Moves along the nearest wall.
    #[derive(Default)]
    FollowWall {
        /// The walls. Without it, everything.
        obstacles: Option<ObstacleNames>,
        /// Distance between the wall and its centre, metres. Without it, 1. Limit: > 0.
        offset: Option<f64>,
        /// How far ahead it looks, seconds. Without it, 0.3. Limit: > 0.
        horizon: Option<f64>,
        /// Greatest distance of a wall that counts, metres. Without it, 5. Limit: > 0.
        range: Option<f64>,
    }
    /// Hides from another agent behind an obstacle.
    Hide {
        /// The target that it hides from.
        from: Target,
        /// The obstacles. Without it, everything.
        obstacles: Option<ObstacleNames>,
        /// Gap between the obstacle and its body, metres. Without it, 0.2. Limit: >= 0.
        gap: Option<f64>,
        /// Distance beyond which it does not hide, metres. Without it, it hides at any distance. Limit: > 0.
        range: Option<f64>,
        /// Distance from its place at which it starts to slow down, metres. Without it, 1. Limit: >= 0.
        slowing_distance: Option<f64>,
    }
    /// Moves along a path among other agents without pushing them.
    CrowdPath {
        /// The name of the path.
        path: String,
        /// Whether it moves in the order of the path's points or against it. Without it, `"forward"`.
        direction: Option<Direction>,
        /// How far ahead it looks, seconds. Without it, 0.5. Limit: > 0.
        horizon: Option<f64>,
    }
    /// Moves through a door among other agents, in a queue, without pushing them.
    QueueAtDoor {
        /// The target behind the door. Without it, the next goal of its journey.
        goal: Option<Target>,
        /// The position of the door.
        door: Target,
        /// The walls. Without it, everything.
        obstacles: Option<ObstacleNames>,
    }
}

/// The direction of motion along a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// In the order of its points.
    Forward,
    /// Against the order of its points.
    Backward,
}

/// The obstacles of a behaviour, by name: surfaces, obstacles, `"obstacles"` (all of them and the edges of the walkable
/// ground) or `"everything"` (obstacles and surfaces). In files a name, or a list of names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObstacleNames(pub Vec<String>);

impl ObstacleNames {
    /// All obstacles, the edges of the walkable ground, and all surfaces.
    pub const EVERYTHING: &str = "everything";
    /// All obstacles, and the edges of the walkable ground.
    pub const OBSTACLES: &str = "obstacles";
}

impl Default for ObstacleNames {
    fn default() -> Self {
        Self(vec![Self::EVERYTHING.to_owned()])
    }
}

impl Serialize for ObstacleNames {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.0[..] {
            [name] => serializer.serialize_str(name),
            names => serializer.collect_seq(names),
        }
    }
}

impl<'de> Deserialize<'de> for ObstacleNames {
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

impl JsonSchema for ObstacleNames {
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
