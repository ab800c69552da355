//! Where agents go.

use super::ground::is_zero;
use super::{Lap, Number, Point, Region, Spot};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::{Deserialize, Deserializer, Serialize, de};
use std::borrow::Cow;
use std::fmt;

/// Metres from a point goal that count as there, where a scene does not say.
pub(crate) const TOLERANCE: f64 = 0.1;

/// Where the agents of a group go.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Goal {
    /// A point for all of them.
    Point(PointGoal),
    /// A point in the air for all of them.
    Air(AirGoal),
    /// A point for each: agent number k goes to the k-th.
    Points(PointsGoal),
    /// For each the point opposite its own start.
    Opposite(Opposite),
    /// For each its own start, shifted.
    Shift(Shift),
    /// A region: whoever is inside has arrived.
    Area(Region),
    /// A region that removes whoever enters it.
    Exit(Region),
    /// One goal after the other.
    Journey(Vec<Stop>),
    /// One goal after the other, for ever.
    Cycle(Vec<Stop>),
    /// Round a ring, for ever.
    Lap(Lap),
    /// For each the goal that is nearest to its start, on foot; agents that look ahead change to another where fewer wait.
    Nearest(Vec<Goal>),
    /// For each one of these, drawn by weight.
    Choice(Vec<Weighted>),
}

/// A point for all. In files `[x, y]`, or `{ at = [x, y], tolerance = 0.1 }`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PointGoal {
    /// The point.
    pub at: Point,
    /// Metres that count as there. Limit: > 0.
    pub tolerance: f64,
}

/// A point in the air for all.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AirGoal {
    /// The point. Limit of z: 0 to 20000.
    pub at: Spot,
    /// Metres that count as there. Limit: > 0.
    #[serde(default = "tolerance")]
    pub tolerance: f64,
}

/// A point for each.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointsGoal {
    /// The points, as many as agents.
    pub at: Vec<Point>,
    /// Metres that count as there. Limit: > 0.
    #[serde(default = "tolerance")]
    pub tolerance: f64,
}

/// For each the point opposite its own start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Opposite {
    /// The point in the middle between start and goal. Without it, the middle of the place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub center: Option<Point>,
    /// Metres that count as there. Limit: > 0.
    #[serde(default = "tolerance")]
    pub tolerance: f64,
}

impl Default for Opposite {
    fn default() -> Self {
        Self { center: None, tolerance: TOLERANCE }
    }
}

/// For each its own start, shifted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Shift {
    /// How far along x and y, metres.
    pub by: Point,
    /// How far up, metres; negative for down.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub rise: f64,
    /// Metres that count as there. Limit: > 0.
    #[serde(default = "tolerance")]
    pub tolerance: f64,
}

/// One stop of a journey.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stop {
    /// Where; not a journey itself.
    pub goal: Goal,
    /// Seconds to wait there before going on. Limit: >= 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wait: Option<Number>,
}

impl From<Goal> for Stop {
    fn from(goal: Goal) -> Self {
        Self { goal, wait: None }
    }
}

/// One of the goals to choose from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Weighted {
    /// Where.
    pub goal: Goal,
    /// How often, against the sum of all weights. Limit: >= 0.
    #[serde(default = "one")]
    pub weight: f64,
}

fn tolerance() -> f64 {
    TOLERANCE
}
fn one() -> f64 {
    1.0
}

/// What `{ at = .., tolerance = .. }` says.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PointTable {
    at: Point,
    #[serde(default = "tolerance")]
    tolerance: f64,
}

impl From<Point> for PointGoal {
    fn from(at: Point) -> Self {
        Self { at, tolerance: TOLERANCE }
    }
}

impl<'de> Deserialize<'de> for PointGoal {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl<'de> de::Visitor<'de> for Visitor {
            type Value = PointGoal;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a point [x, y], or { at = [x, y], tolerance = 0.1 }")
            }
            fn visit_seq<A: de::SeqAccess<'de>>(self, mut seq: A) -> Result<PointGoal, A::Error> {
                let mut next = |i: usize| seq.next_element::<f64>()?.ok_or_else(|| de::Error::invalid_length(i, &self));
                let at = [next(0)?, next(1)?];
                match seq.next_element::<de::IgnoredAny>()? {
                    None => Ok(at.into()),
                    Some(_) => Err(de::Error::invalid_length(3, &self)),
                }
            }
            fn visit_map<A: de::MapAccess<'de>>(self, map: A) -> Result<PointGoal, A::Error> {
                let table = PointTable::deserialize(MapAccessDeserializer::new(map))?;
                Ok(PointGoal { at: table.at, tolerance: table.tolerance })
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

impl JsonSchema for PointGoal {
    fn schema_name() -> Cow<'static, str> {
        "PointGoal".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let point = generator.subschema_for::<Point>();
        let table = generator.subschema_for::<PointTable>();
        json_schema!({ "anyOf": [point, table] })
    }
}
