//! What the colour of an agent says.

use crate::play::Shown;
use throng_draw::{ColorBy, Look, Style, Theme, palette};

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
                Self::Model => models(shown).into_iter().map(|model| Some(palette(model))).collect(),
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

/// The number of each group's model among those that the scene has.
fn models(shown: &Shown) -> Vec<usize> {
    let kinds: Vec<_> =
        shown.scene.groups.iter().map(|group| group.avoid.as_ref().map(std::mem::discriminant)).collect();
    let mut known = Vec::new();
    let number = |kind| {
        known.iter().position(|other| *other == kind).unwrap_or_else(|| {
            known.push(kind);
            known.len() - 1
        })
    };
    kinds.into_iter().map(number).collect()
}
