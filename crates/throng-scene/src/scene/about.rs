//! What viewers read about a scene, and what they can try.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The maximum number of characters of a text.
pub(crate) const LONGEST: usize = 400;

/// What viewers read about a scene, and what they can try. It does not change the simulation. Each text is one line of
/// at most 400 characters.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct About {
    /// What the picture shows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub see: Option<String>,
    /// The detail that tells whether the method works.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub look_for: Option<String>,
    /// The equation or rule behind it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
    /// An experiment, and what it changes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub r#try: Option<String>,
    /// Where the method or the scene comes from: a paper, or what throng derived it from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
    /// The figure or demonstration of a paper that it shows, such as `van den Berg 2008, fig. 7`. Scenes with it are the
    /// gallery's group `papers`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shows: Option<String>,
    /// Numbers of the scene that are worth a change. Limit: at most 8.
    #[serde(rename = "slider", skip_serializing_if = "Vec::is_empty")]
    pub sliders: Vec<AboutSlider>,
    /// Named changes of the scene. Limit: at most 8.
    #[serde(rename = "preset", skip_serializing_if = "Vec::is_empty")]
    pub presets: Vec<AboutPreset>,
}

/// A number of the scene, under a name for viewers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AboutSlider {
    /// Its name, which no other slider of the scene has. Limit: at most 40 characters.
    pub name: String,
    /// The path of the number, as for `--set`.
    pub path: String,
    /// The least value to try.
    pub min: f64,
    /// The greatest value to try. Limit: > `min`.
    pub max: f64,
    /// The unit of the number. Limit: at most 12 characters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
}

/// A named change of the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AboutPreset {
    /// Its name, which no other preset of the scene has. Limit: at most 40 characters.
    pub name: String,
    /// The changed values: a path in quotes, as for `--set`, and its value.
    #[schemars(with = "BTreeMap<String, serde_json::Value>")]
    pub with: BTreeMap<String, toml::Value>,
}

impl About {
    /// Returns what another program's file says about itself: its first characters, in one line.
    pub(crate) fn imported(text: &str) -> Self {
        let line = text.split(|c: char| c.is_whitespace() || c.is_control()).filter(|word| !word.is_empty());
        let see: String = line.collect::<Vec<_>>().join(" ").chars().take(LONGEST).collect();
        Self { see: Some(see).filter(|see| !see.is_empty()), ..Self::default() }
    }

    /// Whether nothing is said.
    pub(crate) fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Returns the texts, each with its key, in the order of the fields.
    pub fn texts(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let texts = [
            ("see", &self.see),
            ("look_for", &self.look_for),
            ("why", &self.why),
            ("try", &self.r#try),
            ("source", &self.source),
            ("shows", &self.shows),
        ];
        texts.into_iter().filter_map(|(key, text)| Some((key, text.as_deref()?)))
    }
}
