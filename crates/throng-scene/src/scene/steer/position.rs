//! Places and offsets, on the ground or in space.

use crate::scene::{Point, SpacePoint};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::borrow::Cow;
use std::fmt;

/// Metres along x, y and z (up). In files `[x, y]`, or `[x, y, z]`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Position(pub SpacePoint);

impl From<Point> for Position {
    /// Returns a position on the ground.
    fn from([x, y]: Point) -> Self {
        Self([x, y, 0.0])
    }
}

impl Serialize for Position {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            [x, y, 0.0] => serializer.collect_seq([x, y]),
            place => serializer.collect_seq(place),
        }
    }
}

/// What a position is, for error messages.
const EXPECTED: &str = "[x, y] or [x, y, z]";

impl Position {
    /// Reads a position from a sequence.
    pub(super) fn visit<'de, A: de::SeqAccess<'de>>(mut seq: A) -> Result<Self, A::Error> {
        let (mut place, mut length) = ([0.0; 3], 0);
        while let Some(x) = seq.next_element::<f64>()? {
            if let Some(coordinate) = place.get_mut(length) {
                *coordinate = x;
            }
            length += 1;
        }
        if length == 2 || length == 3 { Ok(Self(place)) } else { Err(de::Error::invalid_length(length, &EXPECTED)) }
    }
}

impl<'de> Deserialize<'de> for Position {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl<'de> de::Visitor<'de> for Visitor {
            type Value = Position;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(EXPECTED)
            }
            fn visit_seq<A: de::SeqAccess<'de>>(self, seq: A) -> Result<Position, A::Error> {
                Position::visit(seq)
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

impl JsonSchema for Position {
    fn schema_name() -> Cow<'static, str> {
        "Position".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Metres along x and y, and up: [x, y] or [x, y, z].",
            "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 3
        })
    }
}
