//! How pictures of a scene look.

use super::{Annotate, Point, Spot};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::borrow::Cow;

/// How pictures of a scene look. What is not said is the drawing program's choice.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct View {
    /// Lower left corner of what the camera sees. Without it, everything is in view.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min: Option<Point>,
    /// Upper right corner of what the camera sees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<Point>,
    /// Whether the scene is seen from straight above or in perspective. Without it, in perspective where somebody flies,
    /// or where there is a `camera`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub projection: Option<Projection>,
    /// From where it is seen in perspective.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<Camera>,
    /// What is drawn beside agents of what they have in mind.
    #[serde(skip_serializing_if = "Annotate::is_nothing")]
    pub annotate: Annotate,
    /// Width and height of the picture, pixels. Limit: 16 to 16384 each.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size: Option<[u32; 2]>,
    /// The moment that tells what the scene is about, for contact sheets, seconds. Without it, a third of
    /// `expect.within` or, without that, of `time.limit`. Limit: >= 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moment: Option<f64>,
    /// Pictures a second of video. Limit: 0.001 to 1000.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fps: Option<f64>,
    /// Colour of what cannot be walked on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub background: Option<Colour>,
    /// Colour of the walkable ground.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ground: Option<Colour>,
    /// Colour of obstacles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub obstacles: Option<Colour>,
    /// Length of the trails, seconds. Limit: >= 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trails: Option<f64>,
    /// Lines on the ground, each a list of at least 2 points: the markings of a field, lanes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lines: Vec<Vec<Point>>,
    /// Whether goals are drawn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub goals: Option<bool>,
}

impl View {
    pub(super) fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// How a scene is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Projection {
    /// From straight above, true to scale.
    Plan,
    /// By an eye: what is far away is small and pale.
    Perspective,
}

/// What an agent looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Mark {
    /// As its body is: a disc or an oblong; in perspective, who flies as a vehicle is a dart.
    Body,
    /// An insect: a thin body with two wings that beat, and a short streak behind it.
    Insect,
}

/// From where a scene is seen in perspective.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Camera {
    /// Where the eye is. Without it, slightly above everybody, far enough away to see everything.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub eye: Option<Spot>,
    /// What is in the middle of the picture. Without it, the middle of everything.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target: Option<Spot>,
    /// The angle between the top and the bottom of the picture, degrees. Limit: 1 to 170.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub field_of_view: Option<f64>,
    /// How fast the eye goes round its target, degrees a second, counter-clockwise from above.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orbit: Option<f64>,
}

/// A colour: red, green, blue. In files `"#rrggbb"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(pub [u8; 3]);

impl Serialize for Colour {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let [r, g, b] = self.0;
        serializer.collect_str(&format_args!("#{r:02x}{g:02x}{b:02x}"))
    }
}

impl<'de> Deserialize<'de> for Colour {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = Cow::<str>::deserialize(deserializer)?;
        text.strip_prefix('#')
            .filter(|digits| digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit()))
            .and_then(|digits| u32::from_str_radix(digits, 16).ok())
            .map(|rgb| Self([(rgb >> 16) as u8, (rgb >> 8) as u8, rgb as u8]))
            .ok_or_else(|| {
                de::Error::invalid_value(de::Unexpected::Str(&text), &"a colour such as \"#3366cc\" (red, green, blue)")
            })
    }
}

impl JsonSchema for Colour {
    fn schema_name() -> Cow<'static, str> {
        "Colour".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "description": "A colour, #rrggbb.", "type": "string", "pattern": "^#[0-9a-fA-F]{6}$" })
    }
}
