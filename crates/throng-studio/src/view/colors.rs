//! What the colour of an agent says.

use crate::play::Shown;
use throng_draw::{ColorBy, Look, Style, Theme, palette};
use throng_scene::Group;

/// What the colour of an agent says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Coloring {
    /// Its group.
    #[default]
    Group,
    /// How fast it is.
    Speed,
    /// Where it goes.
    Goal,
    /// How high it flies.
    Altitude,
    /// How many there are within a metre and a half, over the area.
    Density,
    /// The local model that it avoids others by.
    Model,
    /// How long it has still to go on a straight line.
    TimeToGoal,
}

impl Coloring {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Group, Self::Speed, Self::Goal, Self::Altitude, Self::Density, Self::Model, Self::TimeToGoal];

    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            Self::Group => "group",
            Self::Speed => "speed",
            Self::Goal => "goal",
            Self::Altitude => "altitude",
            Self::Density => "density",
            Self::Model => "model",
            Self::TimeToGoal => "time to goal",
        }
    }
}

impl Coloring {
    /// The colours as pictures have them, of a scene as it is shown now.
    pub fn style(self, shown: &Shown, theme: &Theme) -> Style {
        let said = Style::said(&shown.scene);
        Style {
            color_by: match self {
                Self::Speed => ColorBy::Speed { max: None },
                Self::Goal => ColorBy::Goal,
                Self::Altitude => ColorBy::Altitude,
                Self::Density => ColorBy::Density,
                Self::TimeToGoal => ColorBy::TimeToGoal,
                Self::Group | Self::Model => ColorBy::Group,
            },
            groups: match self {
                Self::Model => models(shown).0.into_iter().map(|model| Some(palette(model))).collect(),
                _ => said.groups,
            },
            theme: theme.clone(),
            ..said
        }
    }

    /// The colours of agents at the moment that is shown.
    pub(super) fn look(self, shown: &Shown, theme: &Theme) -> Look {
        let mut look = Look::new(&shown.setting, &self.style(shown, theme), &shown.first);
        look.see(&shown.frame);
        look
    }
}

/// The number of each group's model among those that the scene has, and what those are called.
pub(super) fn models(shown: &Shown) -> (Vec<usize>, Vec<String>) {
    let mut known: Vec<String> = Vec::new();
    let number = |group: &Group| {
        let name = group.local_model().name();
        known.iter().position(|other| *other == name).unwrap_or_else(|| {
            known.push(name);
            known.len() - 1
        })
    };
    (shown.scene.groups.iter().map(number).collect(), known)
}
