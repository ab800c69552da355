//! The content of the key of colours and lines.

use super::colors::models;
use super::heat::Heat;
use super::layers::Ground;
use super::streams::Streams;
use super::{Coloring, ViewOptions};
use crate::play::RunMoment;
use crate::settings::Settings;
use throng_draw::{Annotation, Annotations, Color, FlowStyle, Look, Theme, ramp};

/// The most rows of one kind.
const MOST: usize = 8;

/// The symbol of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sign {
    /// Agents of one colour.
    Spot(Color),
    /// Agents on a colour scale.
    Ramp,
    /// Ground on the colour scale of a heat map. `true` on dark ground.
    Heat(Heat, bool),
    /// Ground on the colour scale of the speed of a field. `true` on dark ground.
    Tone(bool),
    /// A line. `true` if dashed.
    Line(Color, bool),
    /// Text only.
    None,
}

impl Sign {
    /// Returns the colour of a share of the maximum, 0 to 1, of a colour scale.
    pub fn color(self, part: f32) -> Option<Color> {
        match self {
            Self::Ramp => Some(ramp(part)),
            Self::Heat(heat, dark) => Some(heat.color(part, dark)),
            Self::Tone(dark) => Some(FlowStyle::tone(part, &if dark { Theme::dark() } else { Theme::light() })),
            _ => None,
        }
    }
}

/// A row of the key.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The symbol.
    pub sign: Sign,
    /// The meaning. For a colour scale, the quantity and its unit.
    pub says: String,
    /// The maximum of a colour scale.
    pub most: f32,
}

impl Row {
    fn new(sign: Sign, says: impl Into<String>) -> Self {
        Self { sign, says: says.into(), most: 0.0 }
    }

    fn to(most: f32, sign: Sign, says: &str) -> Self {
        Self { most, ..Self::new(sign, says) }
    }
}

/// Returns the rows of the agents' colours.
pub(super) fn of_agents(look: &Look, by: Coloring, shown: &RunMoment) -> Vec<Row> {
    let spots = |all: Vec<(Color, String)>| {
        // a single colour needs no key
        let told = if all.len() > 1 { all.len().min(MOST) } else { 0 };
        let more =
            (told < all.len() && told > 0).then(|| Row::new(Sign::None, format!("and {} more", all.len() - told)));
        all.into_iter().take(told).map(|(color, says)| Row::new(Sign::Spot(color), says)).chain(more).collect()
    };
    match by {
        Coloring::Group => {
            spots(shown.setting.groups.iter().enumerate().map(|(k, name)| (look.group(k), name.clone())).collect())
        }
        Coloring::Model => {
            spots(models(shown).1.into_iter().enumerate().map(|(k, name)| (look.theme().group(k), name)).collect())
        }
        Coloring::Goal => vec![Row::new(Sign::None, "a colour for each goal")],
        Coloring::Speed | Coloring::Altitude | Coloring::Density | Coloring::TimeToGoal => look
            .most()
            .map(|(most, unit)| Row::to(most, Sign::Ramp, &format!("{}, {unit}", by.label())))
            .into_iter()
            .collect(),
    }
}

/// Returns the rows of the ground's colours and lines.
fn of_ground(ground: &Ground, settings: &Settings, selected: bool) -> Vec<Row> {
    let (layers, theme) = (&settings.layers, settings.theme());
    let mut rows = Vec::new();
    let sign = Sign::Heat(layers.heat, settings.dark);
    let over = if layers.window > 0.0 { format!(", mean of {} s", layers.window) } else { String::new() };
    match layers.heat {
        Heat::None => {}
        Heat::Density => rows.push(Row::to(ground.most(layers.heat), sign, &format!("density, 1/m²{over}"))),
        Heat::Speed => rows.push(Row::to(ground.most(layers.heat), sign, &format!("speed of the crowd, m/s{over}"))),
    }
    if let Some(fastest) = ground.fastest() {
        let color = theme.goal.mix(theme.text, 0.45);
        if layers.stream_speed {
            rows.push(Row::to(fastest, Sign::Tone(settings.dark), "speed of the field, m/s"));
        }
        if layers.streams != Streams::None {
            rows.push(Row::new(Sign::Line(color, false), format!("field, up to {fastest:.2} m/s")));
        }
    }
    if layers.paths && selected {
        rows.push(Row::new(Sign::Line(theme.goal, false), "planned path"));
    }
    rows
}

/// Returns the rows of the annotations of the selected agent.
fn of_thoughts(shown: &RunMoment, settings: &Settings) -> Vec<Row> {
    let annotations = Annotations { kinds: settings.annotation_kinds(), agents: None };
    let theme = settings.theme();
    // the view draws its own trails
    let kinds = annotations.in_frame(&shown.frame).filter(|kind| *kind != Annotation::Trails);
    kinds.map(|kind| Row::new(Sign::Line(kind.color(&theme), kind.is_dashed()), kind.says())).collect()
}

impl ViewOptions {
    /// Returns the key of a moment, in sections.
    pub fn key(&self, shown: &RunMoment, settings: &Settings) -> [Vec<Row>; 3] {
        let thoughts =
            if self.selected.is_some() && settings.annotations { of_thoughts(shown, settings) } else { vec![] };
        [self.crowd.key().to_vec(), of_ground(&self.ground, settings, self.selected.is_some()), thoughts]
    }
}
