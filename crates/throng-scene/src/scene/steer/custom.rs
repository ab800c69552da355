//! A behaviour that a program has added to the scene, as files write it.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserializer, MapAccess};
use serde::ser::{SerializeMap, Serializer};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;
use toml::Table;

/// A behaviour that a program has added to the scene. In files its name, or `{ NAME = { its parameters } }`.
#[derive(Clone, Debug, PartialEq)]
pub struct Custom {
    /// Its name in [`Behaviours`](crate::Behaviours).
    pub name: String,
    /// The given parameters. The behaviour defines the values of the others.
    pub parameters: Table,
}

impl From<&str> for Custom {
    /// Returns the behaviour with this name, without parameters.
    fn from(name: &str) -> Self {
        Self { name: name.to_owned(), parameters: Table::new() }
    }
}

impl Serialize for Custom {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.parameters.is_empty() {
            return serializer.serialize_str(&self.name);
        }
        let mut map = serializer.serialize_map(Some(1))?;
        map.serialize_entry(&self.name, &self.parameters)?;
        map.end()
    }
}

impl<'de> Deserialize<'de> for Custom {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl<'de> de::Visitor<'de> for Visitor {
            type Value = Custom;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("the name of a behaviour, or { NAME = { its parameters } }")
            }
            fn visit_str<E: de::Error>(self, name: &str) -> Result<Custom, E> {
                Ok(name.into())
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Custom, A::Error> {
                let found = map.next_entry()?;
                match (found, map.next_key::<String>()?) {
                    (Some((name, parameters)), None) => Ok(Custom { name, parameters }),
                    (None, _) => Err(de::Error::custom("wanted exactly 1 element")),
                    (Some(_), Some(_)) => Err(de::Error::custom("wanted exactly 1 element, more than 1 element")),
                }
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

impl JsonSchema for Custom {
    fn schema_name() -> Cow<'static, str> {
        "Custom".into()
    }

    /// Accepts any name: [`Plugins::schema`](crate::Plugins::schema) lists the names that exist.
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A behaviour that a program has added to the scene: its name, or `{ NAME = { its parameters } }`.",
            "anyOf": [
                { "type": "string" },
                { "type": "object", "additionalProperties": { "type": "object" }, "minProperties": 1, "maxProperties": 1 },
            ],
        })
    }
}
