//! Persistent settings.

use crate::play::Speed;
use crate::view::{Coloring, Layers, Marks};
use serde::{Deserialize, Serialize};
use throng_draw::{Annotation, Style, Theme};
use throng_scene::Scene;

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
    /// The scene opened last: a name of the gallery or a file.
    pub scene: String,
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
    /// The plots against time.
    pub plots: bool,
    /// The velocity space of the selected agent.
    pub why: bool,
}

impl Default for Panels {
    fn default() -> Self {
        Self { gallery: true, text: false, summary: true, plots: false, tuning: false, why: false }
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
            scene: "circle".into(),
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
    /// `coloring=Speed`.
    ///
    /// # Errors
    /// There is no such setting, or the value is invalid.
    pub fn set(&mut self, said: &str) -> Result<(), String> {
        let (key, value) = said.split_once('=').ok_or_else(|| format!("`{said}`: `key=value` is expected"))?;
        let mut all = serde_json::to_value(&*self).map_err(|error| error.to_string())?;
        let place = all.pointer_mut(&format!("/{}", key.replace('.', "/")));
        *place.ok_or_else(|| format!("there is no setting `{key}`"))? =
            serde_json::from_str(value).unwrap_or_else(|_| value.into());
        *self = serde_json::from_value(all).map_err(|error| format!("`{said}`: {error}"))?;
        Ok(())
    }

    /// Whether agents that are people are drawn as walking people, in a plan or in a view in space.
    pub fn draws_people(&self, plan: bool) -> bool {
        !plan && self.layers.people && self.marks == Marks::Fitting
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
