//! The targets of behaviours, and the agents that they take into account.

use super::Position;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::{Deserialize, Deserializer, de};
use std::borrow::Cow;
use std::fmt;

/// The agents that a behaviour takes into account. In files `all`, `own`, `others`, or the name of a group or a
/// mover.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum GroupFilter {
    /// All agents.
    All,
    /// The agents of the agent's own group.
    Own,
    /// The agents of all other groups.
    Others,
    /// The agents of the group with this name.
    Group(String),
}

/// The target of a behaviour. In files `[x, y]` or `[x, y, z]`, `"goal"`, `{ group = "wolves", agent = 0 }`, or
/// `{ nearest = "others" }`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Target {
    /// A place.
    At(Position),
    /// The next goal of the agent's journey.
    Goal,
    /// An agent, wherever it is.
    Agent(Member),
    /// The nearest neighbour that counts.
    Nearest(GroupFilter),
}

/// An agent of a group, or a mover.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Member {
    /// Name of the group, or of the mover.
    pub group: String,
    /// The position of the agent in the group, from 0.
    #[serde(default)]
    pub agent: u64,
}

impl<'de> Deserialize<'de> for GroupFilter {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        Ok(match text.as_str() {
            "all" => Self::All,
            "anybody" => return Err(de::Error::custom("the name of all agents is `all` now")),
            "own" => Self::Own,
            "others" => Self::Others,
            _ => Self::Group(text),
        })
    }
}

impl JsonSchema for GroupFilter {
    fn schema_name() -> Cow<'static, str> {
        "GroupFilter".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "The agents that count: \"all\", \"own\", \"others\", or the name of a group or a mover.",
            "type": "string"
        })
    }
}

/// The table of a target.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TargetTable {
    group: Option<String>,
    agent: Option<u64>,
    nearest: Option<GroupFilter>,
}

impl<'de> Deserialize<'de> for Target {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl<'de> de::Visitor<'de> for Visitor {
            type Value = Target;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("[x, y], [x, y, z], \"goal\", { group = \"name\", agent = 0 } or { nearest = \"others\" }")
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<Target, E> {
                if text == "goal" { Ok(Target::Goal) } else { Err(E::invalid_value(de::Unexpected::Str(text), &self)) }
            }
            fn visit_seq<A: de::SeqAccess<'de>>(self, seq: A) -> Result<Target, A::Error> {
                Position::visit(seq).map(Target::At)
            }
            fn visit_map<A: de::MapAccess<'de>>(self, map: A) -> Result<Target, A::Error> {
                match TargetTable::deserialize(MapAccessDeserializer::new(map))? {
                    TargetTable { group: Some(group), agent, nearest: None } => {
                        Ok(Target::Agent(Member { group, agent: agent.unwrap_or(0) }))
                    }
                    TargetTable { group: None, agent: None, nearest: Some(groups) } => Ok(Target::Nearest(groups)),
                    _ => Err(de::Error::invalid_value(de::Unexpected::Map, &self)),
                }
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

impl JsonSchema for Target {
    fn schema_name() -> Cow<'static, str> {
        "Target".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let place = generator.subschema_for::<Position>();
        let member = generator.subschema_for::<Member>();
        let groups = generator.subschema_for::<GroupFilter>();
        json_schema!({
            "description": "The target of a behaviour.",
            "anyOf": [
                place,
                { "description": "The next goal of the agent's journey.", "const": "goal" },
                member,
                {
                    "description": "The nearest neighbour that counts.",
                    "type": "object", "properties": { "nearest": groups },
                    "required": ["nearest"], "additionalProperties": false
                }
            ]
        })
    }
}
