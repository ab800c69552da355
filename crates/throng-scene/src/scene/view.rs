//! The look of a scene's pictures.

use super::surface::is_default;
use super::{Annotate, Point, SpacePoint};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::borrow::Cow;

/// The look of a scene's pictures. The drawing program chooses what is not given.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct View {
    /// Lower left corner of the view. Without it, all of the scene is in view.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min: Option<Point>,
    /// Upper right corner of the view.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<Point>,
    /// The projection: from straight above or in perspective. Without it, in perspective if agents fly, or if there is
    /// a `camera`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub projection: Option<Projection>,
    /// The camera of a view in perspective.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<Camera>,
    /// How the fields that lead groups are drawn, in plan view.
    #[serde(skip_serializing_if = "DrawnFields::is_nothing")]
    pub field: DrawnFields,
    /// What is drawn beside agents about their state and decisions.
    #[serde(skip_serializing_if = "Annotate::is_nothing")]
    pub annotate: Annotate,
    /// Width and height of the picture, pixels. Limit: 16 to 16384 each.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size: Option<[u32; 2]>,
    /// The most typical moment of the scene, for contact sheets, seconds. Without it, a third of `expect.within` or,
    /// without that, of `time.limit`. Limit: >= 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moment: Option<f64>,
    /// Pictures a second of video. Limit: 0.001 to 1000.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fps: Option<f64>,
    /// Colour outside the walkable ground.
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
    /// Whether agents on the ground of the size of people are drawn as people, in perspective. Without it, they are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub people: Option<bool>,
    /// The sun, in perspective.
    #[serde(skip_serializing_if = "Sun::is_default")]
    pub sun: Sun,
    /// The distance at which haze has taken 63 % of the colour of things, in perspective, metres. Without it, little: 4.5
    /// times the distance of the farthest things. Limit: > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub haze: Option<f64>,
    /// A set to look at, in perspective. Agents do not see it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub set: Option<StageSet>,
    /// The positions of lamps that shine, in perspective. A scene with lamps is drawn at night, in dark colours.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lamps: Vec<SpacePoint>,
}

impl View {
    pub(super) fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// The sun of pictures in perspective.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Sun {
    /// The direction to the sun, seen from above, degrees from the axis x, counter-clockwise. Without it, behind the
    /// camera, to its left. Limit: -360 to 360.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub azimuth: Option<f64>,
    /// The height of the sun above the horizon, degrees. Without it, as in the afternoon: 41, or 69 over agents that
    /// fly. Limit: 3 to 90.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height: Option<f64>,
}

impl Sun {
    fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// A set: the meshes of a glTF file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StageSet {
    /// A `.glb` file, or a `.gltf` file with everything in it. A relative name refers to the scene file's folder. The axis y
    /// of the file points up: its point (x, y, z) is (x, -z, y) of the scene.
    pub file: String,
    /// The place of the file's origin. Its height is within 10000 m.
    #[serde(default, skip_serializing_if = "is_default")]
    pub at: SpacePoint,
    /// The angle by which the set is turned, degrees, counter-clockwise from above. Limit: -360 to 360.
    #[serde(default, skip_serializing_if = "is_default")]
    pub turn: f64,
    /// The length of the file's unit, metres. Without it, 1. Limit: 0.000001 to 1000000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<f64>,
    /// Whether the set stands in place of the ground and the obstacles, which are not drawn then.
    #[serde(default, skip_serializing_if = "is_default")]
    pub replaces: bool,
}

/// How fields are drawn. In files `true` (the default layers), `false`, or a list of layers.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected true, false, or a list of layers such as [\"speed\", \"arrows\"]")]
pub enum DrawnFields {
    /// The default layers, or none.
    Usual(bool),
    /// These layers.
    Layers(Vec<FieldLayer>),
}

impl Default for DrawnFields {
    fn default() -> Self {
        Self::Usual(false)
    }
}

impl DrawnFields {
    fn is_nothing(&self) -> bool {
        *self == Self::default()
    }
}

/// A layer of drawn fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FieldLayer {
    /// The speed, as a tone.
    Speed,
    /// A texture along the field.
    Lic,
    /// Evenly spaced lines along the field.
    Streamlines,
    /// Arrows on an even grid.
    Arrows,
    /// The anchors of a sketch, with their velocities.
    Anchors,
    /// The places where the field is zero, by their kind.
    Critical,
}

/// The projection of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Projection {
    /// From straight above, true to scale.
    Plan,
    /// In perspective: distant things are small and pale.
    Perspective,
}

/// The symbol of an agent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AgentShape {
    /// The shape of its body: a disc or an oblong; in perspective, an agent that flies as a vehicle is a dart.
    Body,
    /// An insect: a thin body with two wings that beat, and a short streak behind it.
    Insect,
    /// A bird: it beats its wings to climb and to speed up, and glides down.
    Bird,
    /// A car of the length and width of the body: its wheels roll, and the front wheels steer.
    Car,
    /// A robot on two wheels, which roll, with a visor that shows the heading.
    Robot,
    /// A walking person, also in scenes in which agents fly.
    Person,
    /// A ball: round, without a mark of its heading.
    Ball,
}

/// The camera of a view in perspective.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Camera {
    /// Position of the eye. Without it, slightly above all agents, where they fill the picture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub eye: Option<SpacePoint>,
    /// The point in the middle of the picture. Without it, the middle of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target: Option<SpacePoint>,
    /// The angle between the top and the bottom of the picture, degrees. Limit: 1 to 170.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub field_of_view: Option<f64>,
    /// Angular speed of the eye around its target, degrees a second, counter-clockwise from above.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orbit: Option<f64>,
    /// Number of the agent that the camera follows, from 0. With `eye` and `target` the camera keeps the direction and the
    /// distance that these have, and lags behind the agent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub follow: Option<u32>,
    /// Whether the camera moves so that the agents fill the picture.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub crowd: bool,
    /// Where the camera is at which time, in the order of time. It moves smoothly from key to key.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub keys: Vec<CameraKey>,
}

/// The camera at a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CameraKey {
    /// The time, seconds. Limit: >= 0.
    pub time: f64,
    /// Position of the eye.
    pub eye: SpacePoint,
    /// The point in the middle of the picture.
    pub target: SpacePoint,
    /// The angle between the top and the bottom of the picture, degrees. Without it, that of the camera. Limit: 1 to 170.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field_of_view: Option<f64>,
    /// Whether the film cuts to this key; otherwise the camera moves to it from the key before.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub cut: bool,
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
