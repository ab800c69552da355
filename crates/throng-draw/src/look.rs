//! The look of agents: colours by group, speed or goal, modified by status.

use crate::cells::Cells;
use crate::color::{ramp, wheel};
use crate::{AgentShape, Color, ColorBy, Shape, Style, Theme};
use glam::DVec2;
use throng::{Goal, Status};
use throng_record::{Body, Frame, Setting};

/// The radius within which agents count for the density, metres.
const NEAR: f64 = 1.5;
/// The density at the end of the ramp, people per square metre; people hardly move at this density.
const DENSE: f32 = 4.0;

/// The colours of agents.
#[derive(Clone, Debug)]
pub struct Look {
    by: ColorBy,
    theme: Theme,
    fastest: f32,
    highest: f32,
    /// The colours of groups that have their own.
    groups: Vec<Option<Color>>,
    /// The forms of groups.
    forms: Vec<AgentShape>,
    /// The colour and the position of each goal.
    goals: Vec<(Color, DVec2)>,
    /// The longest time to a goal at the first moment, seconds.
    longest: f32,
    /// The positions at the current moment; only used for colours by density.
    cells: Cells,
}

/// The colours of one agent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coat {
    /// The colour of the inside.
    pub fill: Color,
    /// The colour of the edge.
    pub rim: Color,
}

impl Look {
    /// Returns the look in a style, for a recording that begins with `first`.
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
            theme: style.theme.clone(),
            fastest,
            highest,
            groups: style.groups.clone(),
            forms: style.forms.clone(),
            goals: goal_colors(&setting.goals, &style.theme).into_iter().zip(middles).collect(),
            longest: 1.0,
            cells: Cells::default(),
        };
        look.longest = first.bodies.iter().filter_map(|body| look.time_to_goal(body)).fold(1e-3, f32::max);
        look.see(first);
        look
    }

    /// Updates the density for a moment.
    pub fn see(&mut self, frame: &Frame) {
        if self.by == ColorBy::Density {
            self.cells = Cells::new(frame.bodies.iter().map(|body| body.position), NEAR);
        }
    }

    /// Returns the density around a position, people per square metre.
    fn density(&self, at: DVec2) -> f32 {
        (self.cells.count(at, NEAR) as f64 / (std::f64::consts::PI * NEAR * NEAR)) as f32
    }

    /// Returns the time to the goal on a straight line at the preferred speed, seconds.
    fn time_to_goal(&self, body: &Body) -> Option<f32> {
        let (_, goal) = self.goals.get(body.goal? as usize)?;
        let time = goal.distance(body.position) / f64::from(body.preferred_speed).max(0.05);
        Some(time as f32).filter(|time| time.is_finite())
    }

    /// Returns the form of an agent.
    pub fn form(&self, body: &Body) -> AgentShape {
        self.forms.get(body.group as usize).copied().unwrap_or_default()
    }

    /// Whether any group has this form.
    pub(crate) fn has(&self, form: AgentShape) -> bool {
        self.forms.contains(&form)
    }

    /// Returns the shape of an agent, if it has one.
    pub(crate) fn shape(&self, body: &Body) -> Option<Shape> {
        match self.form(body) {
            AgentShape::Shaped(shape) => Some(shape),
            _ => None,
        }
    }

    /// Whether any group has a shape.
    pub(crate) fn has_shapes(&self) -> bool {
        self.forms.iter().any(|form| matches!(form, AgentShape::Shaped(_)))
    }

    /// Returns the colours of everything but the agents.
    pub fn theme(&self) -> &Theme {
        &self.theme
    }

    /// Returns the colour of a group.
    pub fn group(&self, index: usize) -> Color {
        self.groups.get(index).copied().flatten().unwrap_or_else(|| self.theme.group(index))
    }

    /// Returns the value at the end of the ramp and its unit, if colours are a ramp.
    pub fn most(&self) -> Option<(f32, &'static str)> {
        match self.by {
            ColorBy::Speed { .. } => Some((self.fastest, "m/s")),
            ColorBy::Altitude => Some((self.highest, "m")),
            ColorBy::Density => Some((DENSE, "/m²")),
            ColorBy::TimeToGoal => Some((self.longest, "s")),
            ColorBy::Group | ColorBy::Goal => None,
        }
    }

    /// Returns the colour of an agent by the style's [`ColorBy`].
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

    /// Returns the colours of an agent. Agents that have arrived are pale; agents that cannot reach their goals are
    /// hollow.
    pub fn coat(&self, body: &Body) -> Coat {
        self.coat_of(self.color(body), body.status)
    }

    /// Returns the colours of an agent for a given colour and status.
    pub fn coat_of(&self, color: Color, status: Status) -> Coat {
        // The outline is darker than the inside on light ground, and lighter on dark ground.
        let rim = self.theme.ink(color.mix(self.theme.text, 0.42));
        let ground = self.theme.ground;
        match status {
            Status::Arrived => Coat { fill: color.mix(ground, 0.55), rim: rim.mix(ground, 0.45) },
            Status::Stranded => Coat { fill: ground, rim: self.theme.ink(color) },
            Status::Walking | Status::Waiting => Coat { fill: color, rim },
        }
    }

    /// Returns the colour of lines of an agent, such as its trail: its colour, with a contrast with the ground.
    pub fn ink(&self, body: &Body) -> Color {
        self.theme.ink(self.color(body))
    }
}

/// Returns a colour for each goal. If the palette has too few colours, goals are coloured by their direction from the
/// middle.
fn goal_colors(goals: &[Goal], theme: &Theme) -> Vec<Color> {
    if goals.len() <= theme.palette.len() {
        return (0..goals.len()).map(|index| theme.group(index)).collect();
    }
    let middles: Vec<DVec2> = goals.iter().map(Goal::middle).collect();
    let center = middles.iter().filter(|m| m.is_finite()).sum::<DVec2>() / goals.len() as f64;
    middles.iter().map(|m| wheel(((m.y - center.y).atan2(m.x - center.x) / std::f64::consts::TAU) as f32)).collect()
}
