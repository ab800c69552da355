//! What each agent looks like: the colour that says its group, speed or goal, and what its status makes of it.

use crate::cells::Cells;
use crate::color::{PALETTE, palette, ramp, wheel};
use crate::{Color, ColorBy, Form, Shape, Style};
use glam::DVec2;
use throng::{Goal, Status};
use throng_record::{Body, Frame, Setting};

/// Who is nearer than this counts for the density, metres.
const NEAR: f64 = 1.5;
/// The density at the end of the ramp: one hardly moves any more, people a square metre.
const DENSE: f32 = 4.0;

/// The colours of agents.
#[derive(Clone, Debug)]
pub struct Look {
    by: ColorBy,
    ground: Color,
    /// What edges go towards: dark on light ground, light on dark.
    rim: Color,
    fastest: f32,
    highest: f32,
    /// The colours of groups that have their own.
    groups: Vec<Option<Color>>,
    /// What those of groups look like, where that is said.
    forms: Vec<Form>,
    /// The colour of each goal, and where it is.
    goals: Vec<(Color, DVec2)>,
    /// The longest way at first, seconds.
    longest: f32,
    /// Who was where at the moment that was seen, where that is asked for.
    cells: Cells,
}

/// The colours of one agent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coat {
    /// Of the inside.
    pub fill: Color,
    /// Of the edge.
    pub rim: Color,
}

impl Look {
    /// The colours that a style asks for, of a recording that begins with `first`.
    pub fn new(setting: &Setting, style: &Style, first: &Frame) -> Self {
        let preferred = first.bodies.iter().map(|b| b.preferred_speed).filter(|s| s.is_finite()).fold(0.0, f32::max);
        let fastest = match style.color_by {
            ColorBy::Speed { max: Some(max) } if max > 0.0 => max,
            _ if preferred > 0.0 => preferred,
            _ => 1.5,
        };
        let starts = first.bodies.iter().map(|body| body.altitude);
        let goals = setting.goals.iter().filter_map(|goal| Some(goal.altitude()? as f32));
        let highest = starts.chain(goals).filter(|z| z.is_finite()).fold(0.0, f32::max);
        let highest = if highest > 0.0 { highest } else { 1.0 };
        let middles = setting.goals.iter().map(Goal::middle);
        let mut look = Self {
            by: style.color_by,
            ground: style.theme.ground,
            rim: style.theme.text,
            fastest,
            highest,
            groups: style.groups.clone(),
            forms: style.forms.clone(),
            goals: goal_colors(&setting.goals).into_iter().zip(middles).collect(),
            longest: 1.0,
            cells: Cells::default(),
        };
        look.longest = first.bodies.iter().filter_map(|body| look.time_to_goal(body)).fold(1e-3, f32::max);
        look.see(first);
        look
    }

    /// Looks at a moment, for the colours that say how dense it is.
    pub fn see(&mut self, frame: &Frame) {
        if self.by == ColorBy::Density {
            self.cells = Cells::new(frame.bodies.iter().map(|body| body.position), NEAR);
        }
    }

    /// How many there are round a place at the moment that was seen, people a square metre.
    fn density(&self, at: DVec2) -> f32 {
        (self.cells.count(at, NEAR) as f64 / (std::f64::consts::PI * NEAR * NEAR)) as f32
    }

    /// How long it would take on a straight line, seconds.
    fn time_to_goal(&self, body: &Body) -> Option<f32> {
        let (_, goal) = self.goals.get(body.goal? as usize)?;
        let time = goal.distance(body.position) / f64::from(body.preferred_speed).max(0.05);
        Some(time as f32).filter(|time| time.is_finite())
    }

    /// What somebody looks like.
    pub fn form(&self, body: &Body) -> Form {
        self.forms.get(body.group as usize).copied().unwrap_or_default()
    }

    /// Whether there are some that look so.
    pub(crate) fn has(&self, form: Form) -> bool {
        self.forms.contains(&form)
    }

    /// The shape of somebody, where it has one.
    pub(crate) fn shape(&self, body: &Body) -> Option<Shape> {
        match self.form(body) {
            Form::Shaped(shape) => Some(shape),
            _ => None,
        }
    }

    /// Whether there are some that have shapes.
    pub(crate) fn has_shapes(&self) -> bool {
        self.forms.iter().any(|form| matches!(form, Form::Shaped(_)))
    }

    /// The colour of a group.
    pub fn group(&self, index: usize) -> Color {
        self.groups.get(index).copied().flatten().unwrap_or_else(|| palette(index))
    }

    /// What the end of the ramp says, where there is one, and its unit.
    pub fn most(&self) -> Option<(f32, &'static str)> {
        match self.by {
            ColorBy::Speed { .. } => Some((self.fastest, "m/s")),
            ColorBy::Altitude => Some((self.highest, "m")),
            ColorBy::Density => Some((DENSE, "/m²")),
            ColorBy::TimeToGoal => Some((self.longest, "s")),
            ColorBy::Group | ColorBy::Goal => None,
        }
    }

    /// The colour that says what [`ColorBy`] asks for.
    pub fn color(&self, body: &Body) -> Color {
        match self.by {
            ColorBy::Group => self.group(body.group as usize),
            ColorBy::Altitude => ramp(body.altitude / self.highest),
            ColorBy::Speed { .. } => ramp(body.speed() / self.fastest),
            ColorBy::Density => ramp(self.density(body.position) / DENSE),
            ColorBy::TimeToGoal => ramp(self.time_to_goal(body).unwrap_or_default() / self.longest),
            ColorBy::Goal => {
                let goal = body.goal.and_then(|goal| self.goals.get(goal as usize));
                goal.map_or(Color::rgb(0x8a9099), |(color, _)| *color)
            }
        }
    }

    /// The colours of an agent: those who have arrived step back, those who cannot reach their goal are hollow.
    pub fn coat(&self, body: &Body) -> Coat {
        self.coat_of(self.color(body), body.status)
    }

    /// The colours of an agent whose colour says something else than the style asks for.
    pub fn coat_of(&self, color: Color, status: Status) -> Coat {
        let rim = color.mix(self.rim, 0.42);
        match status {
            Status::Arrived => Coat { fill: color.mix(self.ground, 0.55), rim: rim.mix(self.ground, 0.45) },
            Status::Stranded => Coat { fill: self.ground, rim: color },
            Status::Walking | Status::Waiting => Coat { fill: color, rim },
        }
    }
}

/// A colour for each goal; more goals than the palette holds are coloured by their direction from the middle.
fn goal_colors(goals: &[Goal]) -> Vec<Color> {
    if goals.len() <= PALETTE.len() {
        return (0..goals.len()).map(palette).collect();
    }
    let middles: Vec<DVec2> = goals.iter().map(Goal::middle).collect();
    let center = middles.iter().filter(|m| m.is_finite()).sum::<DVec2>() / goals.len() as f64;
    middles.iter().map(|m| wheel(((m.y - center.y).atan2(m.x - center.x) / std::f64::consts::TAU) as f32)).collect()
}
