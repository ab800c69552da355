//! What the colour of an agent says.

use crate::play::Shown;
use glam::{DVec2, IVec2};
use std::collections::HashMap;
use throng_draw::{Coat, ColorBy, Look, Style, Theme, palette, ramp};
use throng_record::{Body, Frame};

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
/// The density at the end of the ramp: one hardly moves any more, people a square metre.
const DENSE: f64 = 4.0;

/// The colours of the agents of one moment.
pub struct Colors {
    look: Look,
    by: Coloring,
    /// How many are in each cell [`NEAR`] wide, where that is asked for.
    cells: HashMap<IVec2, Vec<DVec2>>,
    /// The model of each group, as the number of its colour.
    models: Vec<usize>,
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
        let mut colors = Self {
            look: Look::new(&shown.setting, &style, &shown.first),
            by,
            cells: HashMap::new(),
            models: models(shown),
            goals: shown.setting.goals.iter().map(throng::Goal::middle).collect(),
            longest: 1.0,
        };
        match by {
            Coloring::Density => colors.cells = cells(&shown.frame),
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

    /// The colours of an agent.
    pub fn coat(&self, body: &Body) -> Coat {
        let color = match self.by {
            Coloring::Density => ramp((self.density(body.position) / DENSE) as f32),
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
        let middle = cell(at);
        let around = (-1..=1).flat_map(|x| (-1..=1).map(move |y| middle + IVec2::new(x, y)));
        let near = around.filter_map(|cell| self.cells.get(&cell)).flatten().filter(|other| other.distance(at) <= NEAR);
        near.count() as f64 / (std::f64::consts::PI * NEAR * NEAR)
    }
}

fn cell(at: DVec2) -> IVec2 {
    (at / NEAR).floor().as_ivec2()
}

fn cells(frame: &Frame) -> HashMap<IVec2, Vec<DVec2>> {
    let mut cells: HashMap<IVec2, Vec<DVec2>> = HashMap::new();
    frame.bodies.iter().for_each(|body| cells.entry(cell(body.position)).or_default().push(body.position));
    cells
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
