//! The number of neighbours that an agent takes into account.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::borrow::Cow;
use std::fmt;

/// The number of neighbours that an agent takes into account, of those within the reach of its neighbour search. In
/// files a whole number, or `"all"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Neighbours {
    /// This number of the nearest neighbours. Limit: 1 to 1000.
    Nearest(u32),
    /// All neighbours.
    All,
}

impl Serialize for Neighbours {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Nearest(count) => serializer.serialize_u32(*count),
            Self::All => serializer.serialize_str("all"),
        }
    }
}

impl<'de> Deserialize<'de> for Neighbours {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl de::Visitor<'_> for Visitor {
            type Value = Neighbours;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("\"all\", or a number such as 10")
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<Neighbours, E> {
                if text == "all" {
                    Ok(Neighbours::All)
                } else {
                    Err(E::invalid_value(de::Unexpected::Str(text), &self))
                }
            }
            fn visit_i64<E: de::Error>(self, count: i64) -> Result<Neighbours, E> {
                let count = u32::try_from(count);
                count
                    .map(Neighbours::Nearest)
                    .map_err(|_| E::invalid_value(de::Unexpected::Other("too large a number, or one below 0"), &self))
            }
            fn visit_u64<E: de::Error>(self, count: u64) -> Result<Neighbours, E> {
                self.visit_i64(i64::try_from(count).unwrap_or(i64::MAX))
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

impl JsonSchema for Neighbours {
    fn schema_name() -> Cow<'static, str> {
        "Neighbours".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "How many neighbours an agent takes into account: a number of the nearest, or \"all\".",
            "anyOf": [{ "const": "all" }, { "type": "integer", "minimum": 1, "maximum": 1000 }]
        })
    }
}
