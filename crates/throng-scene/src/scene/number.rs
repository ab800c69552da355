//! Numbers that may differ between agents.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::borrow::Cow;
use std::fmt;

/// A number, the same for every agent of a group or drawn for each agent. In files `1.3`, `{ uniform = [1.0, 1.5] }` or
/// `{ normal = { mean = 1.3, deviation = 0.2 } }`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// The same for every agent.
    Constant(f64),
    /// Uniformly distributed between two bounds, the lower first.
    Uniform([f64; 2]),
    /// A truncated normal distribution.
    Normal(Normal),
}

/// A truncated normal distribution: a draw outside the bounds is drawn again.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Normal {
    /// Its mean, before truncation.
    pub mean: f64,
    /// Its standard deviation, before truncation. Limit: >= 0.
    pub deviation: f64,
    /// The least value; without it, three deviations below the mean.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min: Option<f64>,
    /// The greatest value; without it, three deviations above the mean.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max: Option<f64>,
}

impl Normal {
    /// Returns the least and the greatest value.
    pub fn bounds(&self) -> [f64; 2] {
        [self.min.unwrap_or(self.mean - 3.0 * self.deviation), self.max.unwrap_or(self.mean + 3.0 * self.deviation)]
    }
}

impl Number {
    /// Returns the least and the greatest value.
    pub fn bounds(&self) -> [f64; 2] {
        match self {
            Self::Constant(x) => [*x, *x],
            Self::Uniform(bounds) => *bounds,
            Self::Normal(normal) => normal.bounds(),
        }
    }

    /// Whether every agent has the same value.
    pub fn is_constant(&self) -> bool {
        matches!(self, Self::Constant(_))
    }
}

impl From<f64> for Number {
    fn from(x: f64) -> Self {
        Self::Constant(x)
    }
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Constant(x) => serializer.serialize_f64(*x),
            Self::Uniform(bounds) => {
                let mut map = serializer.serialize_map(Some(1))?;
                map.serialize_entry("uniform", bounds)?;
                map.end()
            }
            Self::Normal(normal) => {
                let mut map = serializer.serialize_map(Some(1))?;
                map.serialize_entry("normal", normal)?;
                map.end()
            }
        }
    }
}

#[derive(Deserialize)]
#[serde(field_identifier, rename_all = "snake_case")]
enum Key {
    Uniform,
    Normal,
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl<'de> de::Visitor<'de> for Visitor {
            type Value = Number;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a number, { uniform = [least, most] } or { normal = { mean = .., deviation = .. } }")
            }
            fn visit_f64<E: de::Error>(self, x: f64) -> Result<Number, E> {
                Ok(Number::Constant(x))
            }
            fn visit_i64<E: de::Error>(self, n: i64) -> Result<Number, E> {
                Ok(Number::Constant(n as f64))
            }
            fn visit_u64<E: de::Error>(self, n: u64) -> Result<Number, E> {
                Ok(Number::Constant(n as f64))
            }
            fn visit_map<A: de::MapAccess<'de>>(self, mut map: A) -> Result<Number, A::Error> {
                let number = match map.next_key::<Key>()? {
                    Some(Key::Uniform) => Number::Uniform(map.next_value()?),
                    Some(Key::Normal) => Number::Normal(map.next_value()?),
                    None => return Err(de::Error::invalid_length(0, &self)),
                };
                match map.next_key::<Key>()? {
                    None => Ok(number),
                    Some(_) => Err(de::Error::custom("a number has one distribution: uniform or normal, not both")),
                }
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

impl JsonSchema for Number {
    fn schema_name() -> Cow<'static, str> {
        "Number".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let normal = generator.subschema_for::<Normal>();
        json_schema!({
            "description": "A number, the same for every agent of a group or drawn for each agent.",
            "anyOf": [
                { "type": "number" },
                {
                    "type": "object",
                    "properties": { "uniform": {
                        "description": "Uniformly distributed between two bounds, the lower first.",
                        "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2
                    } },
                    "required": ["uniform"], "additionalProperties": false
                },
                {
                    "type": "object",
                    "properties": { "normal": normal },
                    "required": ["normal"], "additionalProperties": false
                }
            ]
        })
    }
}
