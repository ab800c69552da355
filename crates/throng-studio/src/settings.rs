//! What the studio remembers from one time to the next.

use crate::play::Speed;
use crate::view::{Coloring, Layers, Marks};
use serde::{Deserialize, Serialize};
use throng_draw::Theme;

/// What people have chosen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Light on dark ground.
    pub dark: bool,
    /// Whether there is a grid on the ground.
    pub grid: bool,
    /// Length of the trails, seconds; 0 for none.
    pub trails: f32,
    /// What the colour of an agent says.
    pub coloring: Coloring,
    /// What agents are drawn as.
    pub marks: Marks,
    /// How fast scenes play.
    pub speed: Speed,
    /// Whether what the selected agent has in mind is drawn.
    pub annotations: bool,
    /// What is seen beside the crowd.
    pub layers: Layers,
    /// Which panels are open.
    pub panels: Panels,
    /// The model that the scene is played with beside its own; empty: none.
    pub beside: String,
    /// The scene that was open last: a name of the gallery or a file.
    pub scene: String,
}

/// Which panels are open.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Panels {
    /// The scenes that come with the project.
    pub gallery: bool,
    /// The scene's text.
    pub text: bool,
    /// How the run goes.
    pub summary: bool,
    /// Sliders for what groups are.
    pub tuning: bool,
    /// Figures against time.
    pub plots: bool,
    /// Why the selected agent goes where it goes.
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
            layers: Layers::default(),
            panels: Panels::default(),
            beside: String::new(),
            scene: "circle".into(),
        }
    }
}

impl Settings {
    /// Changes one of them: `key=value`, with the names of this file, such as `dark=true`, `panels.plots=true` or
    /// `coloring=Speed`.
    ///
    /// # Errors
    /// There is no such setting, or it takes no such value; in words.
    pub fn set(&mut self, said: &str) -> Result<(), String> {
        let (key, value) = said.split_once('=').ok_or_else(|| format!("`{said}`: `key=value` is expected"))?;
        let mut all = serde_json::to_value(&*self).map_err(|error| error.to_string())?;
        let place = all.pointer_mut(&format!("/{}", key.replace('.', "/")));
        *place.ok_or_else(|| format!("there is no setting `{key}`"))? =
            serde_json::from_str(value).unwrap_or_else(|_| value.into());
        *self = serde_json::from_value(all).map_err(|error| format!("`{said}`: {error}"))?;
        Ok(())
    }

    /// The colours of everything but the agents.
    pub fn theme(&self) -> Theme {
        if self.dark { Theme::dark() } else { Theme::light() }
    }
}
