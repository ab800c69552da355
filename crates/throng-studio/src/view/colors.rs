//! Colouring of agents.

use crate::play::RunMoment;
use throng_draw::{ColorBy, Look, Style, Theme};
use throng_scene::Group;

/// The quantity that colours an agent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Coloring {
    /// The group.
    #[default]
    Group,
    /// The speed.
    Speed,
    /// The goal.
    Goal,
    /// The altitude.
    Altitude,
    /// The number of agents within 1.5 m, divided by that area.
    Density,
    /// The local model of the group.
    Model,
    /// The remaining time to the goal on a straight line.
    TimeToGoal,
}

impl Coloring {
    /// All quantities.
    pub const ALL: [Self; 7] =
        [Self::Group, Self::Speed, Self::Goal, Self::Altitude, Self::Density, Self::Model, Self::TimeToGoal];

    /// Returns the label.
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
    /// Returns the style of pictures with these colours, for the displayed scene.
    pub fn style(self, shown: &RunMoment, theme: &Theme) -> Style {
        let said = Style::themed(&shown.scene, theme.clone());
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
                Self::Model => models(shown).0.into_iter().map(|model| Some(theme.group(model))).collect(),
                _ => said.groups,
            },
            ..said
        }
    }

    /// Returns the colours of the agents at the displayed moment.
    pub(super) fn look(self, shown: &RunMoment, theme: &Theme) -> Look {
        let mut look = Look::new(&shown.setting, &self.style(shown, theme), &shown.first);
        look.see(&shown.frame);
        look
    }
}

/// Returns the index of each group's model among the models of the scene, and the names of these models.
pub(super) fn models(shown: &RunMoment) -> (Vec<usize>, Vec<String>) {
    let mut known: Vec<String> = Vec::new();
    let number = |group: &Group| {
        let name = group.local_model().name;
        known.iter().position(|other| *other == name).unwrap_or_else(|| {
            known.push(name);
            known.len() - 1
        })
    };
    (shown.scene.groups.iter().map(number).collect(), known)
}
