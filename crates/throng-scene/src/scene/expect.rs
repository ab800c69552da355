//! The expectations of a scene: every scene is also a test.

use super::Point;
use super::ground::is_zero;
use super::steer::Position;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::borrow::Cow;
use std::fmt;

/// The expectations of a scene. Only the given ones are checked.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Expect {
    /// How many agents arrive (or leave by an exit): `"all"`, a number of agents (`30`), or a share of all (`0.9`).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arrived: Option<Arrived>,
    /// By when they arrive, seconds. Without it, by the scene's end. Limit: > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within: Option<f64>,
    /// The least distance between two centres at any time, over the sum of the radii: 1 is contact, less is overlap.
    /// Limit: >= 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least_separation: Option<f64>,
    /// The least distance between a centre and a wall, or an object that is `solid` to its group, at any time, over the
    /// radius: 1 is contact. Limit: >= 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least_wall_separation: Option<f64>,
    /// The mean change of heading over walking agents, degrees a second, is at most this. Limit: > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub heading_change: Option<f64>,
    /// The mean speed of walking agents, over the whole scene, is at least this, m/s. Limit: >= 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_speed: Option<f64>,
    /// The mean speed of the agents at the end is at most this, m/s: whether a crowd comes to rest. Limit: >= 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub final_speed: Option<f64>,
    /// The number of agents at the end that wait outside the area of their last goal because no place in it is free, at
    /// most.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub waiting_for_room: Option<u64>,
    /// The number of agents at the end that made no progress for 10 seconds and stand in no queue, at most.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub blocked: Option<u64>,
    /// The number of agents at the end that made no progress for 10 seconds although they walked, at most.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub oscillating: Option<u64>,
    /// The number of agents at the end that are blocked, oscillate, or have an unreachable goal, at most.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stuck: Option<u64>,
    /// How often an agent walked for 30 seconds without progress, at most.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub without_progress_30s: Option<u64>,
    /// Flows of agents across lines.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub flow: Vec<FlowExpect>,
    /// Distances of the agents of groups from places or from other agents, metres.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub distance: Vec<DistanceExpect>,
    /// Speeds of the agents of groups, m/s.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub speed: Vec<GroupExpect>,
    /// Alignment of groups: the length of the mean direction in which agents move, or face if they stand, 0 (all
    /// different) to 1 (all the same).
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub order: Vec<GroupExpect>,
    /// Figures of the game's rules.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub figure: Vec<FigureExpect>,
}

impl Expect {
    pub(super) fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// The flow across a line, agents a second between the first and the last crossing, both directions together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FlowExpect {
    /// One end of the line.
    pub from: Point,
    /// The other end.
    pub to: Point,
    /// Least flow, agents a second. Limit: >= 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
    /// Greatest flow, agents a second. Limit: >= 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
}

/// The distance of each agent of a group from a place, the nearest agent of a group, a surface or a path, metres from
/// its centre.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DistanceExpect {
    /// Name of the group. Without it, all agents.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<String>,
    /// From where it is measured.
    pub to: To,
    /// Lower bound. Limit: >= 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
    /// Upper bound. Limit: >= 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
    /// When the bounds hold.
    #[serde(default, skip_serializing_if = "When::is_end")]
    pub when: When,
    /// Start of the check, seconds. Limit: >= 0.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub after: f64,
}

impl DistanceExpect {
    /// Returns the bounds without the place.
    pub(crate) fn of_group(&self) -> GroupExpect {
        let Self { of, at_least, at_most, when, after, .. } = self.clone();
        GroupExpect { of, at_least, at_most, when, after }
    }
}

/// A quantity of every agent of a group.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GroupExpect {
    /// Name of the group. Without it, all agents.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<String>,
    /// Lower bound. Limit: >= 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
    /// Upper bound. Limit: >= 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
    /// When the bounds hold.
    #[serde(default, skip_serializing_if = "When::is_end")]
    pub when: When,
    /// Start of the check, seconds. Limit: >= 0.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub after: f64,
}

/// A figure of the rules.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FigureExpect {
    /// The name of the figure.
    pub of: String,
    /// Lower bound. Limit: finite.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
    /// Upper bound. Limit: finite.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
    /// When the bounds hold.
    #[serde(default, skip_serializing_if = "When::is_end")]
    pub when: When,
    /// Start of the check, seconds. Limit: >= 0.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub after: f64,
}

/// From where a distance is measured. In files `[x, y]`, `[x, y, z]`, or the name of a group, a mover, a surface or a
/// path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "this should be [x, y], [x, y, z] or the name of a group, a surface or a path")]
pub enum To {
    /// From a place.
    Place(Position),
    /// From the nearest other agent of a group; from a surface, on the side it is seen from; or from the spine of a
    /// path.
    Named(String),
}

/// When the bounds must hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum When {
    /// At the end.
    #[default]
    End,
    /// After every step.
    Always,
    /// After at least one step, which may differ between the agents of a group.
    Ever,
}

impl When {
    fn is_end(&self) -> bool {
        *self == Self::End
    }
}

/// How many agents arrive. In files `"all"`, a whole number of agents, or a fraction from 0.0 to 1.0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Arrived {
    /// All agents.
    All,
    /// At least this number of agents.
    Number(u64),
    /// At least this share of all agents. Limit: 0 to 1.
    Fraction(f64),
}

impl Serialize for Arrived {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::All => serializer.serialize_str("all"),
            Self::Number(n) => serializer.serialize_u64(*n),
            Self::Fraction(x) => serializer.serialize_f64(*x),
        }
    }
}

impl<'de> Deserialize<'de> for Arrived {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl de::Visitor<'_> for Visitor {
            type Value = Arrived;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("\"all\", a number of agents such as 30, or a fraction such as 0.9")
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<Arrived, E> {
                if text == "all" { Ok(Arrived::All) } else { Err(E::invalid_value(de::Unexpected::Str(text), &self)) }
            }
            fn visit_i64<E: de::Error>(self, n: i64) -> Result<Arrived, E> {
                u64::try_from(n).map(Arrived::Number).map_err(|_| E::invalid_value(de::Unexpected::Signed(n), &self))
            }
            fn visit_u64<E: de::Error>(self, n: u64) -> Result<Arrived, E> {
                Ok(Arrived::Number(n))
            }
            fn visit_f64<E: de::Error>(self, x: f64) -> Result<Arrived, E> {
                if (0.0..=1.0).contains(&x) {
                    Ok(Arrived::Fraction(x))
                } else {
                    Err(E::invalid_value(de::Unexpected::Float(x), &self))
                }
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

impl JsonSchema for Arrived {
    fn schema_name() -> Cow<'static, str> {
        "Arrived".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "How many agents arrive: \"all\", a whole number of agents, or a fraction from 0.0 to 1.0.",
            "anyOf": [
                { "const": "all" },
                { "type": "integer", "minimum": 0 },
                { "type": "number", "minimum": 0, "maximum": 1 }
            ]
        })
    }
}
