//! The step, and the end of a scene.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::borrow::Cow;
use std::fmt;

/// The step, and the end of the scene. Seconds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Time {
    /// Seconds from one output to the next. Limit: 0.00001 to 10.
    pub step: f64,
    /// How a step is divided: `"auto"`, or a number of parts.
    pub sub_steps: SubSteps,
    /// When the scene ends, if before `limit`.
    pub until: Until,
    /// The latest end of the scene, seconds. Limit: > 0.
    pub limit: f64,
}

impl Default for Time {
    fn default() -> Self {
        Self { step: 0.04, sub_steps: SubSteps::Auto, until: Until::Arrived, limit: 300.0 }
    }
}

impl Time {
    /// Whether the scene is over: at its limit, or by [`until`](Self::until). A scene that ends when no agent is left
    /// also ends when all remaining agents have arrived or cannot arrive: its state would not change any more.
    pub fn over(&self, world: &throng::World) -> bool {
        let done = match self.until {
            Until::Arrived | Until::Empty => world.finished(),
            Until::Limit => false,
        };
        // the step nearest to the limit is the last
        done || world.time() + self.step * 0.5 >= self.limit
    }
}

/// When a scene ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Until {
    /// When all agents have arrived (or left) and no agent has yet to enter.
    #[default]
    Arrived,
    /// When no agent is left and no agent has yet to enter: for scenes with exits.
    Empty,
    /// At the limit.
    Limit,
}

/// How a step is divided. In files `"auto"` or a whole number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SubSteps {
    /// By a rule that depends only on the world's state.
    #[default]
    Auto,
    /// Always into this number of parts. Limit: 1 to 1000.
    Fixed(u32),
}

impl From<SubSteps> for throng::SubSteps {
    fn from(sub_steps: SubSteps) -> Self {
        match sub_steps {
            SubSteps::Auto => Self::Auto,
            SubSteps::Fixed(n) => Self::Fixed(n),
        }
    }
}

impl Serialize for SubSteps {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Auto => serializer.serialize_str("auto"),
            Self::Fixed(n) => serializer.serialize_u32(*n),
        }
    }
}

impl<'de> Deserialize<'de> for SubSteps {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl de::Visitor<'_> for Visitor {
            type Value = SubSteps;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("\"auto\" or a whole number from 1 to 1000")
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<SubSteps, E> {
                if text == "auto" {
                    Ok(SubSteps::Auto)
                } else {
                    Err(E::invalid_value(de::Unexpected::Str(text), &self))
                }
            }
            fn visit_i64<E: de::Error>(self, n: i64) -> Result<SubSteps, E> {
                match u32::try_from(n) {
                    Ok(n) if (1..=1000).contains(&n) => Ok(SubSteps::Fixed(n)),
                    _ => Err(E::invalid_value(de::Unexpected::Signed(n), &self)),
                }
            }
            fn visit_u64<E: de::Error>(self, n: u64) -> Result<SubSteps, E> {
                self.visit_i64(i64::try_from(n).unwrap_or(-1))
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

impl JsonSchema for SubSteps {
    fn schema_name() -> Cow<'static, str> {
        "SubSteps".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "How a step is divided: \"auto\", or a fixed number of parts.",
            "anyOf": [{ "const": "auto" }, { "type": "integer", "minimum": 1, "maximum": 1000 }]
        })
    }
}
