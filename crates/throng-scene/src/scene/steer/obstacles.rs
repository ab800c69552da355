//! The names of obstacles.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;

/// The obstacles of a behaviour, by name: surfaces, obstacles, `"obstacles"` (all of them and the edges of the walkable
/// ground) or `"everything"` (obstacles and surfaces). In files a name, or a list of names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObstacleNames(pub Vec<String>);

impl ObstacleNames {
    /// All obstacles, the edges of the walkable ground, and all surfaces.
    pub const EVERYTHING: &str = "everything";
    /// All obstacles, and the edges of the walkable ground.
    pub const OBSTACLES: &str = "obstacles";
}

impl Serialize for ObstacleNames {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.0[..] {
            [name] => serializer.serialize_str(name),
            names => serializer.collect_seq(names),
        }
    }
}

impl<'de> Deserialize<'de> for ObstacleNames {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged, expecting = "a name, or a list of names")]
        enum Names {
            One(String),
            Several(Vec<String>),
        }
        Ok(Self(match Names::deserialize(deserializer)? {
            Names::One(name) => vec![name],
            Names::Several(names) => names,
        }))
    }
}

impl JsonSchema for ObstacleNames {
    fn schema_name() -> Cow<'static, str> {
        "What".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let name = json_schema!({ "type": "string" });
        json_schema!({
            "description": "Surfaces and obstacles by name, \"obstacles\", or \"everything\": a name, or a list of names.",
            "anyOf": [name, { "type": "array", "items": name, "minItems": 1 }]
        })
    }
}
