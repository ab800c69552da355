//! The goals of throng, as scenes describe them.

use super::ground::is_zero;
use super::{Lap, Number, Point, Region, SpacePoint};
use crate::registry::{Goal, Goals, described, schema_of_value};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::borrow::Cow;
use std::fmt;

/// The default distance from a point goal that counts as arrival, metres.
pub(crate) const TOLERANCE: f64 = 0.1;

described! {
    Goal in Goals:
    /// One point for all agents.
    PointGoal = "point",
    /// One point in the air for all agents.
    AirGoal = "air",
    /// A point for each agent: agent number k goes to the k-th point.
    PointsGoal = "points",
    /// For each agent, the point opposite its start.
    Opposite = "opposite",
    /// For each agent, its start shifted by a vector.
    Shift = "shift",
    /// A region: an agent inside it has arrived.
    AreaGoal = "area",
    /// A region that removes the agents that enter it.
    ExitGoal = "exit",
    /// A sequence of goals.
    JourneyGoal = "journey",
    /// A sequence of goals, repeated for ever.
    CycleGoal = "cycle",
    /// Laps of a ring, for ever.
    Lap = "lap",
    /// For each agent, the goal with the shortest path from its start; agents that look ahead change to another goal
    /// with a shorter queue.
    NearestGoal = "nearest",
    /// For each agent, one of these goals, drawn by weight.
    ChoiceGoal = "choice",
}

schema_of_value! {
    AreaGoal: Region,
    ExitGoal: Region,
    JourneyGoal: Vec<Stop>,
    CycleGoal: Vec<Stop>,
    NearestGoal: Vec<Goal>,
    ChoiceGoal: Vec<Weighted>,
}

/// A region: an agent inside it has arrived.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct AreaGoal(pub Region);

/// A region that removes the agents that enter it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ExitGoal(pub Region);

/// A sequence of goals.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct JourneyGoal(pub Vec<Stop>);

/// A sequence of goals, repeated for ever.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct CycleGoal(pub Vec<Stop>);

/// For each agent, the nearest of these goals.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct NearestGoal(pub Vec<Goal>);

/// For each agent, one of these goals, drawn by weight.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ChoiceGoal(pub Vec<Weighted>);

/// A point for all agents. In files `[x, y]`, or `{ at = [x, y], tolerance = 0.1 }`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointGoal {
    /// The point.
    pub at: Point,
    /// Distance that counts as arrival, metres. Limit: > 0.
    pub tolerance: f64,
}

/// A point in the air for all agents.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AirGoal {
    /// The point. Limit of z: 0 to 20000.
    pub at: SpacePoint,
    /// Distance that counts as arrival, metres. Limit: > 0.
    #[serde(default = "tolerance")]
    pub tolerance: f64,
}

/// A point for each agent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointsGoal {
    /// The points, as many as agents.
    pub at: Vec<Point>,
    /// Distance that counts as arrival, metres. Limit: > 0.
    #[serde(default = "tolerance")]
    pub tolerance: f64,
}

/// For each agent, the point opposite its start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Opposite {
    /// The midpoint between start and goal. Without it, the centre of the place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub center: Option<Point>,
    /// Distance that counts as arrival, metres. Limit: > 0.
    #[serde(default = "tolerance")]
    pub tolerance: f64,
}

impl Default for Opposite {
    fn default() -> Self {
        Self { center: None, tolerance: TOLERANCE }
    }
}

/// For each agent, its start shifted by a vector.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Shift {
    /// Shift along x and y, metres.
    pub by: Point,
    /// Shift upwards, metres; negative: downwards.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub rise: f64,
    /// Distance that counts as arrival, metres. Limit: > 0.
    #[serde(default = "tolerance")]
    pub tolerance: f64,
}

/// A stop of a journey.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stop {
    /// The goal; not a journey itself.
    pub goal: Goal,
    /// Seconds to wait at the goal. Limit: >= 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wait: Option<Number>,
}

impl From<Goal> for Stop {
    fn from(goal: Goal) -> Self {
        Self { goal, wait: None }
    }
}

/// A goal of a random choice.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Weighted {
    /// The goal.
    pub goal: Goal,
    /// Weight: the probability is the weight over the sum of all weights. Limit: >= 0.
    #[serde(default = "one")]
    pub weight: f64,
}

fn tolerance() -> f64 {
    TOLERANCE
}
fn one() -> f64 {
    1.0
}

/// The table `{ at = .., tolerance = .. }`.
#[derive(Serialize, Deserialize, JsonSchema)]
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

impl Serialize for PointGoal {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match *self {
            Self { at, tolerance: TOLERANCE } => at.serialize(serializer),
            Self { at, tolerance } => PointTable { at, tolerance }.serialize(serializer),
        }
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
