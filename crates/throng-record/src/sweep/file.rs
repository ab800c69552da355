//! The keys of a plan's file.

use serde::{Deserialize, Deserializer, de};
use serde_json::{Map, Value};
use throng_scene::{Point, Rectangle};

/// A plan as its file says it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlanFile {
    #[serde(default)]
    pub title: String,
    pub scenes: Scenes,
    #[serde(default)]
    pub seeds: Option<Seeds>,
    #[serde(default)]
    pub limit: Option<f64>,
    #[serde(default)]
    pub set: Map<String, Value>,
    #[serde(default)]
    pub vary: Vec<Map<String, Value>>,
    /// Names of columns by keys of parameters.
    #[serde(default)]
    pub columns: Map<String, Value>,
    #[serde(default)]
    pub record: RecordFile,
}

/// Names of scenes, or a single one.
#[derive(Debug)]
pub struct Scenes(pub Vec<String>);

impl<'de> Deserialize<'de> for Scenes {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let wrong = || de::Error::custom("expected the name of a scene, or a list of names");
        match Value::deserialize(deserializer)? {
            Value::String(name) => Ok(Self(vec![name])),
            Value::Array(names) => {
                let names: Option<_> = names.iter().map(|name| name.as_str().map(str::to_owned)).collect();
                names.map(Self).ok_or_else(wrong)
            }
            _ => Err(wrong()),
        }
    }
}

/// Seeds: a list, or a text such as `1..10`.
#[derive(Debug)]
pub struct Seeds(pub Vec<u64>);

impl<'de> Deserialize<'de> for Seeds {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = match Value::deserialize(deserializer)? {
            Value::String(text) => text,
            Value::Array(numbers) => numbers.iter().map(Value::to_string).collect::<Vec<_>>().join(","),
            other => other.to_string(),
        };
        let numbers = super::whole_numbers("seed", &text);
        numbers.map(Self).map_err(|why| de::Error::custom(format_args!("{why}; write \"1..10\", or [1, 3, 7]")))
    }
}

/// What is recorded beside the summary.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields, default)]
pub struct RecordFile {
    /// Seconds from one recorded position to the next.
    pub interval: f64,
    /// Seconds over which a velocity is taken.
    pub velocity_interval: f64,
    /// Seconds before which nothing is recorded.
    pub from: f64,
    /// Seconds after which nothing is recorded.
    pub to: Option<f64>,
    /// Whether figures of walking people are measured.
    pub people: bool,
    #[serde(rename = "line")]
    pub lines: Vec<LineFile>,
    #[serde(rename = "area")]
    pub areas: Vec<AreaFile>,
}

impl Default for RecordFile {
    fn default() -> Self {
        let (lines, areas) = (Vec::new(), Vec::new());
        Self { interval: 0.1, velocity_interval: 0.4, from: 0.0, to: None, people: false, lines, areas }
    }
}

/// A line at which people are counted.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct LineFile {
    pub name: String,
    pub from: Point,
    pub to: Point,
}

/// An area in which density and speed are measured.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct AreaFile {
    pub name: String,
    pub shape: AreaShape,
}

/// The shape of an area.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum AreaShape {
    Rectangle(Rectangle),
    Polygon(Vec<Point>),
}
