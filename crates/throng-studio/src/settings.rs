//! Persistent settings.

use crate::direct::Snapping;
use crate::play::Speed;
use crate::view::{Coloring, Heat, Layers, Marks, Streams};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use throng_draw::{Annotation, Style, Theme};
use throng_scene::Scene;

/// The number of files that are remembered.
const RECENT: usize = 8;

/// The settings of the user.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Whether the theme is dark.
    pub dark: bool,
    /// Whether the ground has a grid.
    pub grid: bool,
    /// Length of the trails, seconds. 0 draws no trails.
    pub trails: f32,
    /// The quantity that colours the agents.
    pub coloring: Coloring,
    /// The shape of the agents.
    pub marks: Marks,
    /// The playback speed.
    pub speed: Speed,
    /// Whether the annotations of the selected agent are drawn.
    pub annotations: bool,
    /// The names of the kinds of annotations that are drawn for the selected agent.
    pub kinds: Vec<String>,
    /// The visible layers.
    pub layers: Layers,
    /// The open panels.
    pub panels: Panels,
    /// The model that runs beside the model of the scene. Empty for none.
    pub beside: String,
    /// What gestures in the view snap to.
    pub snapping: Snapping,
    /// Whether edits that the run cannot follow start the scene again.
    pub restarts: bool,
    /// Whether the user has seen the hints, or wants none.
    pub hinted: bool,
    /// The scene opened last: a name of the gallery or a file.
    pub scene: String,
    /// The files opened or saved last, the last first.
    pub recent: Vec<String>,
}

/// The open panels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Panels {
    /// The gallery of scenes.
    pub gallery: bool,
    /// The text of the scene.
    pub text: bool,
    /// The summary of the run.
    pub summary: bool,
    /// The sliders of the parameters of the groups.
    pub tuning: bool,
    /// The look of pictures and films.
    pub look: bool,
    /// The plots against time.
    pub plots: bool,
    /// The velocity space of the selected agent.
    pub why: bool,
}

/// A value of a setting that is a choice.
struct Choice {
    label: String,
    value: Value,
}

impl Choice {
    fn all<T: Serialize>(all: &[T], label: impl Fn(&T) -> String) -> Vec<Self> {
        let choice = |one| Self { label: label(one), value: serde_json::to_value(one).unwrap_or_default() };
        all.iter().map(choice).collect()
    }

    /// Whether a text is the label or the name of the variant. Case does not matter, and a hyphen is a space.
    fn is(&self, text: &str) -> bool {
        let same = |name: &str| {
            let plain = |name: &str| name.to_lowercase().replace('-', " ").replace('×', "x");
            plain(name) == plain(text)
        };
        same(&self.label) || self.value.as_str().is_some_and(same)
    }
}

/// Returns the values of a setting that is a choice, none for other settings.
fn choices(key: &str) -> Vec<Choice> {
    match key {
        "coloring" => Choice::all(&Coloring::ALL, |one| one.label().into()),
        "marks" => Choice::all(&Marks::ALL, |one| one.label().into()),
        "speed" => Choice::all(&Speed::ALL, |one| one.label()),
        "layers.heat" => Choice::all(&Heat::ALL, |one| one.label().into()),
        "layers.streams" => Choice::all(&Streams::ALL, |one| one.label().into()),
        _ => Vec::new(),
    }
}

impl Default for Panels {
    fn default() -> Self {
        Self { gallery: true, text: false, summary: true, plots: false, tuning: false, look: false, why: false }
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            dark: false,
            grid: true,
            trails: 1.5,
            coloring: Coloring::Group,
            marks: Marks::Fitting,
            speed: Speed::Times(1.0),
            annotations: true,
            kinds: first_kinds(),
            layers: Layers::default(),
            panels: Panels::default(),
            beside: String::new(),
            snapping: Snapping::default(),
            restarts: true,
            hinted: false,
            scene: "circle".into(),
            recent: Vec::new(),
        }
    }
}

/// Returns all kinds of annotations but velocity obstacles, which the panel *Why* shows.
fn first_kinds() -> Vec<String> {
    let kinds = Annotation::ALL.into_iter().filter(|kind| *kind != Annotation::VelocityObstacles);
    kinds.map(|kind| kind.name().to_owned()).collect()
}

impl Settings {
    /// Returns the kinds of annotations that are drawn for the selected agent.
    pub fn annotation_kinds(&self) -> Vec<Annotation> {
        Annotation::ALL.into_iter().filter(|kind| self.kinds.iter().any(|name| name == kind.name())).collect()
    }

    /// Changes a setting: `key=value`, with the field names of this file, such as `dark=true`, `panels.plots=true` or
    /// `coloring=speed`. A choice has the labels of the panels, or the names of its variants.
    ///
    /// # Errors
    /// There is no such setting, or the value is invalid. The message lists the values of a choice.
    pub fn set(&mut self, said: &str) -> Result<(), String> {
        let (key, value) = said.split_once('=').ok_or_else(|| format!("`{said}`: `key=value` is expected"))?;
        let mut all = serde_json::to_value(&*self).map_err(|error| error.to_string())?;
        let place = all.pointer_mut(&format!("/{}", key.replace('.', "/")));
        let place = place.ok_or_else(|| format!("there is no setting `{key}`"))?;
        let choices = choices(key);
        let chosen = choices.iter().find(|choice| choice.is(value)).map(|choice| choice.value.clone());
        *place = chosen.unwrap_or_else(|| serde_json::from_str(value).unwrap_or_else(|_| value.into()));
        *self = serde_json::from_value(all).map_err(|error| {
            let labels: Vec<&str> = choices.iter().map(|choice| choice.label.as_str()).collect();
            match labels.is_empty() {
                true => format!("`{said}`: {error}"),
                false => format!("`{said}`: {key} is one of: {}", labels.join(", ")),
            }
        })?;
        Ok(())
    }

    /// Notes a file as the one that was opened or saved last.
    pub fn used(&mut self, file: String) {
        self.recent.retain(|other| *other != file);
        self.recent.insert(0, file);
        self.recent.truncate(RECENT);
    }

    /// Whether agents that are people are drawn as walking people, in a plan or in a view in space.
    pub fn draws_people(&self, scene: &Scene, plan: bool) -> bool {
        !plan && self.layers.people && self.marks == Marks::Fitting && scene.view.people != Some(false)
    }

    /// Returns the colours of everything but the agents, with those that a scene gives.
    pub fn theme_of(&self, scene: &Scene) -> Theme {
        Style::themed(scene, self.theme()).theme
    }

    /// Returns the colours of everything but the agents.
    pub fn theme(&self) -> Theme {
        if self.dark { Theme::dark() } else { Theme::light() }
    }
}
