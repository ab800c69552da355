//! Sources: agents that enter while the scene runs.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Agents enter one at a time, each at the group's place as soon as its position is free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// When the first agent enters, seconds. Limit: >= 0.
    #[serde(default)]
    pub start: f64,
    /// No agent enters from this time on, seconds. Without it, `count` ends the source. Limit: > start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<f64>,
    /// The number of agents that enter. Without it, as many as enter until `end`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u64>,
    /// Agents a second. One of `rate`, `interval`, or `end` together with `count` (evenly). Limit: > 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate: Option<f64>,
    /// Seconds from one agent to the next. Limit: > 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interval: Option<f64>,
}

/// Reads `source = { .. }`, or several sources: `[[group.source]]`.
pub(super) mod one_or_many {
    use super::Source;
    use schemars::{Schema, SchemaGenerator, json_schema};
    use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
    use serde::{Deserialize, Deserializer, de};
    use std::fmt;

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Source>, D::Error> {
        struct Visitor;
        impl<'de> de::Visitor<'de> for Visitor {
            type Value = Vec<Source>;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a source such as { start = 0, end = 60, rate = 2 }, or a list of them")
            }
            fn visit_map<A: de::MapAccess<'de>>(self, map: A) -> Result<Vec<Source>, A::Error> {
                Ok(vec![Source::deserialize(MapAccessDeserializer::new(map))?])
            }
            fn visit_seq<A: de::SeqAccess<'de>>(self, seq: A) -> Result<Vec<Source>, A::Error> {
                Vec::deserialize(SeqAccessDeserializer::new(seq))
            }
        }
        deserializer.deserialize_any(Visitor)
    }

    pub fn schema(generator: &mut SchemaGenerator) -> Schema {
        let one = generator.subschema_for::<Source>();
        json_schema!({ "anyOf": [one, { "type": "array", "items": one }] })
    }
}
