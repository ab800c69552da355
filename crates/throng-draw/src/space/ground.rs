//! The ground: walkable areas, a fading grid, and goals.

use super::extent::Extent;
use super::light::light_of;
use super::{Lens, lamps};
use crate::legend::round_length;
use crate::place::{LINE, spots_to_go};
use crate::ribbon::Ribbon;
use crate::trail::AgentTrail;
use crate::{Color, Style};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;
use throng::Goal;
use throng_record::{Frame, Setting};
use throng_render::{Area, Line, LineEnd, Material, Pattern};

/// The approximate number of grid cells across the extent of the scene.
const CELLS: f64 = 8.0;
/// The radius of the grid, relative to the reach of the scene.
const GRID: f64 = 2.6;
/// The opacity of the grid's lines in the middle.
const OPACITY: f32 = 0.45;
/// With more point goals than this they are drawn faint.
const MANY_GOALS: usize = 40;
/// The number of corners of a ring.
const ROUND: usize = 28;
/// The least width of a trail, pixels.
const LEAST_TRAIL: f32 = 1.2;
/// The strength of the grain of the ground.
const GRAIN: f32 = 0.07;

/// The drawings on the ground, and the goals above it. Goals on the ground lie flat; goals in the air face the
/// viewpoint.
#[derive(Clone, Debug)]
pub(super) struct Ground {
    /// The ground without end; `None` if things are below it, or a set stands in its place.
    pub plane: Option<Material>,
    pub areas: Vec<Area>,
    lines: Vec<Line>,
    /// The point goals, and their tolerances.
    spots: Vec<(DVec3, f64)>,
    goal: Color,
    /// The width of the grid's cells, metres; `None` without a grid.
    pub cell: Option<f64>,
    unit: f32,
}

impl Ground {
    pub fn new(setting: &Setting, style: &Style, extent: &Extent, first: &Frame, unit: f32) -> Self {
        let theme = &style.theme;
        let plain = |color: Color| Material {
            opacity: f32::from(color.a) / 255.0,
            pattern: Pattern::Grain { strength: GRAIN },
            ..Material::plain(light_of(color))
        };
        let below = first.bodies.iter().any(|body| body.altitude < 0.0);
        let around = if setting.walkable.is_empty() { theme.ground } else { theme.outside };
        let (mut areas, mut lines) = (Vec::new(), Vec::new());
        let replaced = setting.is_replaced();
        for area in setting.walkable.iter().filter(|_| !replaced) {
            let rings: Vec<Vec<DVec2>> = std::iter::once(&area.outer).chain(&area.holes).cloned().collect();
            lines.push(line(rings[0].iter().map(|p| p.extend(0.0)), true, (1.2 * unit, theme.edge)));
            areas.push(Area::new(&rings, plain(theme.ground)));
        }
        for ribbon in setting.paths.iter().map(|path| Ribbon::new(path, setting.origin)) {
            let rings = ribbon.areas.iter().map(|ring| ring.iter().map(|corner| corner.truncate()).collect());
            areas.extend(rings.map(|ring| Area::new(&[ring], plain(Ribbon::tone(theme)))));
            let stroke = Ribbon::stroke(theme, unit);
            lines.push(line(ribbon.spine.into_iter(), false, (stroke.width, stroke.color)));
        }
        let marking = (LINE * unit, theme.edge);
        lines.extend(style.lines.iter().map(|points| line(points.iter().map(|p| p.extend(0.0)), false, marking)));
        let goals = &setting.goals[..if style.goals { setting.goals.len() } else { 0 }];
        for goal in goals {
            let (corners, tint) = match goal {
                Goal::Point { .. } | Goal::Air { .. } => continue,
                Goal::Area { corners } => (corners, 0.16),
                Goal::Exit { corners } => (corners, 0.32),
            };
            areas.push(Area::new(std::slice::from_ref(corners), plain(theme.goal.alpha(tint))));
            let edge = (1.1 * unit, theme.goal.alpha(0.8));
            lines.push(line(corners.iter().map(|corner| corner.extend(0.0)), true, edge));
        }
        areas.extend(lamps::pools(&style.lamps));
        let spots = spots_to_go(setting, first).filter(|(at, near)| style.goals && at.is_finite() && near.is_finite());
        let reach = GRID * extent.reach();
        let cell = (!replaced).then_some(round_length(2.0 * extent.reach() / CELLS));
        if let Some(cell) = cell {
            lines.splice(0..0, grid(extent.middle().truncate(), reach, cell, (0.9 * unit, theme.edge)));
        }
        let spots: Vec<(DVec3, f64)> = spots.collect();
        let faint = if spots.len() > MANY_GOALS { 0.35 } else { 0.9 };
        let plane = (!below && !replaced).then(|| plain(around));
        Self { plane, areas, lines, spots, goal: theme.goal.alpha(faint), cell, unit }
    }

    /// Returns the lines as a viewpoint shows them.
    pub fn lines(&self, lens: &Lens) -> Vec<Line> {
        let spot = |&(at, near): &(DVec3, f64)| {
            // The ring keeps a visible size.
            let radius = near.max(3.0 * f64::from(self.unit) / lens.scale(at));
            let [aside, above] = if at.z > 0.0 { lens.axes() } else { [DVec3::X, DVec3::Y] };
            let angles = (0..ROUND).map(|k| DVec2::from_angle(k as f64 * TAU / ROUND as f64) * radius);
            let ring = angles.map(|out| at + aside * out.x + above * out.y);
            line(ring, true, (1.1 * self.unit, self.goal))
        };
        self.lines.iter().cloned().chain(self.spots.iter().map(spot)).collect()
    }
}

/// Returns a line through points, of a width in pixels; those on the ground lie flat.
fn line(points: impl Iterator<Item = DVec3>, closed: bool, (width, color): (f32, Color)) -> Line {
    let opacity = f32::from(color.a) / 255.0;
    let mut ends: Vec<LineEnd> = points.map(|at| LineEnd { at, width, opacity }).collect();
    if closed {
        ends.extend(ends.first().copied());
    }
    let flat = ends.iter().all(|end| end.at.z == 0.0);
    Line { ends, color: light_of(color), flat }
}

/// Returns lines in both directions that fade towards the rim of the grid.
fn grid(middle: DVec2, reach: f64, cell: f64, (width, color): (f32, Color)) -> Vec<Line> {
    let count = (reach / cell).ceil();
    let origin = (middle / cell).round() * cell;
    let steps = || (0..=2 * count as usize).map(move |k| (k as f64 - count) * cell);
    let end = |offset: DVec2| {
        let at = origin + offset;
        let fresh = 1.0 - (at.distance(middle) / reach).min(1.0) as f32;
        LineEnd { at: at.extend(0.0), width, opacity: OPACITY * fresh }
    };
    let line = |ends: Vec<LineEnd>| Line { ends, color: light_of(color), flat: true };
    let both = steps().flat_map(|across| {
        let along =
            |turn: fn(DVec2) -> DVec2| line(steps().map(|along| end(turn(DVec2::new(along, across)))).collect());
        [along(|p| p), along(DVec2::perp)]
    });
    both.collect()
}

/// Returns the trail of an agent as it looks at a time if it fades within `seconds`.
pub(super) fn trail(track: &AgentTrail, usual: Color, lens: &Lens, (now, seconds): (f64, f64)) -> Line {
    let end = |(at, half, opacity): (DVec3, f32, f32)| {
        let width = (2.0 * half * lens.scale(at) as f32).max(LEAST_TRAIL);
        LineEnd { at, width, opacity }
    };
    let ends: Vec<LineEnd> = track.fading(now, seconds).map(end).collect();
    let flat = ends.iter().all(|end| end.at.z == 0.0);
    Line { ends, color: light_of(track.color.unwrap_or(usual)), flat }
}
