//! Whom or what behaviours steer by.

use super::Position;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::borrow::Cow;
use std::fmt;

/// Which others count. In files `"anybody"`, `"own"`, `"others"`, or the name of a group or a mover.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Who {
    /// Everybody.
    #[default]
    Anybody,
    /// Those of the agent's own group.
    Own,
    /// Those of all other groups.
    Others,
    /// Those of the group of this name.
    Group(String),
}

/// Whom or what a behaviour steers by. In files `[x, y]` or `[x, y, z]`, `"goal"`, `{ group = "wolves", agent = 0 }`, or
/// `{ nearest = "others" }`.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A place.
    At(Position),
    /// Where the agent's own journey leads next.
    Goal,
    /// One agent, wherever it is.
    Agent(Member),
    /// The nearest neighbour that counts.
    Nearest(Who),
}

/// One agent of a group, or a mover.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Member {
    /// Name of the group, or of the mover.
    pub group: String,
    /// Which of the group, from 0.
    #[serde(default)]
    pub agent: u64,
}

impl Serialize for Who {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(match self {
            Self::Anybody => "anybody",
            Self::Own => "own",
            Self::Others => "others",
            Self::Group(name) => name,
        })
    }
}

impl<'de> Deserialize<'de> for Who {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        Ok(match text.as_str() {
            "anybody" => Self::Anybody,
            "own" => Self::Own,
            "others" => Self::Others,
            _ => Self::Group(text),
        })
    }
}

impl JsonSchema for Who {
    fn schema_name() -> Cow<'static, str> {
        "Who".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Which others count: \"anybody\", \"own\", \"others\", or the name of a group or a mover.",
            "type": "string"
        })
    }
}

/// What the table of a target says.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Table {
    #[serde(skip_serializing_if = "Option::is_none")]
    group: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    agent: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    nearest: Option<Who>,
}

impl Serialize for Target {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::At(place) => place.serialize(serializer),
            Self::Goal => serializer.serialize_str("goal"),
            Self::Agent(member) => member.serialize(serializer),
            Self::Nearest(who) => Table { group: None, agent: None, nearest: Some(who.clone()) }.serialize(serializer),
        }
    }
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
                match Table::deserialize(MapAccessDeserializer::new(map))? {
                    Table { group: Some(group), agent, nearest: None } => {
                        Ok(Target::Agent(Member { group, agent: agent.unwrap_or(0) }))
                    }
                    Table { group: None, agent: None, nearest: Some(who) } => Ok(Target::Nearest(who)),
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
        let who = generator.subschema_for::<Who>();
        json_schema!({
            "description": "Whom or what a behaviour steers by.",
            "anyOf": [
                place,
                { "description": "Where the agent's own journey leads next.", "const": "goal" },
                member,
                {
                    "description": "The nearest neighbour that counts.",
                    "type": "object", "properties": { "nearest": who },
                    "required": ["nearest"], "additionalProperties": false
                }
            ]
        })
    }
}
