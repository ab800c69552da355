//! What the colour of an agent says.

use super::cells::Cells;
use super::layers::DENSE;
use crate::play::Shown;
use glam::DVec2;
use throng_draw::{Coat, ColorBy, Look, Style, Theme, palette, ramp};
use throng_record::Body;
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

/// Who is nearer than this counts for the density, metres.
const NEAR: f64 = 1.5;

/// The colours of the agents of one moment.
pub struct Colors {
    look: Look,
    by: Coloring,
    /// Who is where, where that is asked for.
    cells: Cells,
    /// The model of each group, as the number of its colour.
    models: Vec<usize>,
    /// What each of those models is called.
    names: Vec<String>,
    goals: Vec<DVec2>,
    /// The longest way at first, seconds.
    longest: f64,
}

impl Colors {
    /// The colours of a moment.
    pub fn new(shown: &Shown, by: Coloring, theme: &Theme) -> Self {
        let style = Style {
            color_by: match by {
                Coloring::Speed => ColorBy::Speed { max: None },
                Coloring::Goal => ColorBy::Goal,
                Coloring::Altitude => ColorBy::Altitude,
                _ => ColorBy::Group,
            },
            theme: theme.clone(),
            ..Style::said(&shown.scene)
        };
        let (models, names) = if by == Coloring::Model { models(shown) } else { Default::default() };
        let mut colors = Self {
            look: Look::new(&shown.setting, &style, &shown.first),
            by,
            cells: Cells::default(),
            models,
            names,
            goals: shown.setting.goals.iter().map(throng::Goal::middle).collect(),
            longest: 1.0,
        };
        match by {
            Coloring::Density => colors.cells = Cells::new(shown.frame.bodies.iter().map(|body| body.position), NEAR),
            Coloring::TimeToGoal => {
                let times = shown.first.bodies.iter().filter_map(|body| colors.time_to_goal(body));
                colors.longest = times.fold(1e-3, f64::max);
            }
            _ => {}
        }
        colors
    }

    /// The colours by group, speed, goal and altitude.
    pub fn look(&self) -> &Look {
        &self.look
    }

    /// What the models are called that colours tell apart, in the order of the palette.
    pub fn models(&self) -> impl Iterator<Item = &str> {
        self.names.iter().map(String::as_str)
    }

    /// The time to the goal at the end of the ramp, seconds.
    pub fn longest(&self) -> f32 {
        self.longest as f32
    }

    /// The colours of an agent.
    pub fn coat(&self, body: &Body) -> Coat {
        let color = match self.by {
            Coloring::Density => ramp(self.density(body.position) as f32 / DENSE),
            Coloring::Model => palette(self.models.get(body.group as usize).copied().unwrap_or_default()),
            Coloring::TimeToGoal => ramp(self.time_to_goal(body).map_or(0.0, |time| (time / self.longest) as f32)),
            _ => return self.look.coat(body),
        };
        self.look.coat_of(color, body.status)
    }

    fn time_to_goal(&self, body: &Body) -> Option<f64> {
        let goal = self.goals.get(body.goal? as usize)?;
        let time = goal.distance(body.position) / f64::from(body.preferred_speed).max(0.05);
        Some(time).filter(|time| time.is_finite())
    }

    fn density(&self, at: DVec2) -> f64 {
        self.cells.count(at, NEAR) as f64 / (std::f64::consts::PI * NEAR * NEAR)
    }
}

/// What the model of a group is called in scene files.
pub fn model_name(group: &Group) -> Option<String> {
    let said = serde_json::to_value(group.local_model()).ok()?;
    said.as_object()?.keys().next().cloned()
}

/// The number of each group's model among those that the scene has, and what those are called.
fn models(shown: &Shown) -> (Vec<usize>, Vec<String>) {
    let mut known: Vec<String> = Vec::new();
    let number = |group| {
        let name = model_name(group).unwrap_or_default();
        known.iter().position(|other| *other == name).unwrap_or_else(|| {
            known.push(name);
            known.len() - 1
        })
    };
    (shown.scene.groups.iter().map(number).collect(), known)
}
