//! The JSON of a file: the part of the glTF schema that trajectories need.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::borrow::Cow;

/// Component types of an accessor, numbered as in OpenGL.
pub const BYTE: u32 = 5120;
pub const UNSIGNED_BYTE: u32 = 5121;
pub const SHORT: u32 = 5122;
pub const UNSIGNED_SHORT: u32 = 5123;
pub const UNSIGNED_INT: u32 = 5125;
pub const FLOAT: u32 = 5126;

/// A string of the schema.
pub type Word = Cow<'static, str>;

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Root {
    pub asset: Asset,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene: Option<usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub scenes: Vec<Value>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub nodes: Vec<Node>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub animations: Vec<Animation>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub meshes: Vec<Value>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub materials: Vec<Value>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub textures: Vec<Value>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub images: Vec<Value>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub skins: Vec<Value>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub accessors: Vec<Accessor>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub buffer_views: Vec<BufferView>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub buffers: Vec<Buffer>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub extensions_required: Vec<String>,
    /// Data of extensions, which other programs may write.
    #[serde(skip_serializing_if = "Value::is_null")]
    pub extensions: Value,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Asset {
    pub version: Word,
    pub generator: Word,
    #[serde(skip_serializing_if = "Map::is_empty")]
    pub extras: Map<String, Value>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Node {
    #[serde(skip_serializing_if = "String::is_empty")]
    pub name: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub children: Vec<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<usize>,
    /// The joints that bend the mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub skin: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub matrix: Option<[f64; 16]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub translation: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation: Option<[f32; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scale: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub extras: Option<Extras>,
}

/// Data of a node beyond the glTF schema.
#[derive(Debug, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Extras {
    Person(Person),
    Other(Value),
}

/// The agent that a node represents.
#[derive(Debug, Serialize, Deserialize)]
pub struct Person {
    pub number: u32,
    /// The group's name.
    #[serde(default)]
    pub group: String,
    /// Metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius: Option<f32>,
    /// Times of the first and the last sample, seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to: Option<f64>,
    /// The build of the figure, if it has one: `woman`, `man` or `child`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub build: Option<String>,
    /// The legs of the figure, if they are not those of its build: in heights.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub legs: Option<BodyLegs>,
}

/// Lengths of legs and feet in heights ([`throng_figure::Legs`]).
#[derive(Debug, Serialize, Deserialize)]
pub struct BodyLegs {
    pub thigh: f64,
    pub shank: f64,
    pub ankle: f64,
    pub foot: f64,
    pub heel: f64,
    pub ball: f64,
    pub toe_height: f64,
    pub hip: f64,
}

impl From<throng_figure::Legs> for BodyLegs {
    fn from(legs: throng_figure::Legs) -> Self {
        let throng_figure::Legs { thigh, shank, ankle, foot, heel, ball, toe_height, hip } = legs;
        Self { thigh, shank, ankle, foot, heel, ball, toe_height, hip }
    }
}

impl From<&BodyLegs> for throng_figure::Legs {
    fn from(legs: &BodyLegs) -> Self {
        let &BodyLegs { thigh, shank, ankle, foot, heel, ball, toe_height, hip } = legs;
        Self { thigh, shank, ankle, foot, heel, ball, toe_height, hip }
    }
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Animation {
    pub channels: Vec<Channel>,
    pub samplers: Vec<Sampler>,
}

#[derive(Debug, Serialize, Deserialize)]
pub struct Channel {
    pub sampler: usize,
    pub target: Target,
}

#[derive(Debug, Serialize, Deserialize)]
pub struct Target {
    pub node: Option<usize>,
    pub path: Word,
}

#[derive(Debug, Serialize, Deserialize)]
pub struct Sampler {
    pub input: usize,
    pub output: usize,
    /// `LINEAR` if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<Word>,
}

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Accessor {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub buffer_view: Option<usize>,
    #[serde(skip_serializing_if = "is_default")]
    pub byte_offset: u64,
    pub component_type: u32,
    #[serde(skip_serializing_if = "is_default")]
    pub normalized: bool,
    pub count: u64,
    #[serde(rename = "type")]
    pub kind: Word,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub min: Vec<f32>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub max: Vec<f32>,
    /// Sparse elements, which other programs may write.
    #[serde(skip_serializing_if = "Value::is_null")]
    pub sparse: Value,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct BufferView {
    pub buffer: usize,
    #[serde(skip_serializing_if = "is_default")]
    pub byte_offset: u64,
    pub byte_length: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub byte_stride: Option<u64>,
    /// Intended use of the view by the graphics processor.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target: Option<u32>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Buffer {
    pub byte_length: u64,
    /// Location of the bytes, if they are not in the file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uri: Option<String>,
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}
