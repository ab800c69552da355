//! The ground: walkable areas, a fading grid, and goals.

use super::Lens;
use super::viewpoint::Extent;
use crate::Style;
use crate::legend::round_length;
use crate::place::{LINE, spots_to_go};
use crate::primitive::{Primitive, Stroke};
use crate::ribbon::Ribbon;
use crate::style::Theme;
use crate::trail::{End, Trail};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;
use throng::{Goal, Walkable};
use throng_record::{Frame, Setting};

/// The approximate number of grid cells across the extent of the scene.
const CELLS: f64 = 8.0;
/// The radius of the grid, relative to the reach of the scene.
const GRID: f64 = 2.6;
/// The opacity of the grid's lines in the middle.
const OPACITY: f32 = 0.55;
/// With more point goals than this they are drawn faint.
const MANY_GOALS: usize = 40;
/// The number of corners of a ring.
const ROUND: usize = 28;

/// The drawings on the ground, and the goals above it. Goals on the ground lie flat; goals in the air face the
/// viewpoint.
#[derive(Clone, Debug)]
pub(super) struct Ground {
    walkable: Vec<Walkable>,
    /// The markings.
    lines: Vec<Vec<DVec2>>,
    /// The goal areas, and the opacity of their fill.
    areas: Vec<(Vec<DVec2>, f32)>,
    /// The point goals, and their tolerances.
    spots: Vec<(DVec3, f64)>,
    /// The paths of behaviours.
    paths: Vec<Ribbon>,
    theme: Theme,
    middle: DVec2,
    /// The radius of the grid, metres.
    reach: f64,
    /// The width of the grid's cells, metres.
    pub cell: f64,
}

impl Ground {
    pub fn new(setting: &Setting, style: &Style, extent: &Extent, first: &Frame) -> Self {
        let shown = |goal: &Goal| match goal {
            Goal::Point { .. } | Goal::Air { .. } => None,
            Goal::Area { corners } => Some((corners.clone(), 0.10)),
            Goal::Exit { corners } => Some((corners.clone(), 0.24)),
        };
        let goals = &setting.goals[..if style.goals { setting.goals.len() } else { 0 }];
        let spots = spots_to_go(setting, first).filter(|(at, near)| style.goals && at.is_finite() && near.is_finite());
        Self {
            walkable: setting.walkable.clone(),
            lines: style.lines.clone(),
            areas: goals.iter().filter_map(shown).collect(),
            spots: spots.collect(),
            paths: setting.paths.iter().map(|path| Ribbon::new(path, setting.origin)).collect(),
            theme: style.theme.clone(),
            middle: extent.middle().truncate(),
            reach: GRID * extent.reach(),
            cell: round_length(2.0 * extent.reach() / CELLS),
        }
    }

    pub fn marks(&self, lens: &Lens, unit: f32) -> Vec<Primitive> {
        let theme = &self.theme;
        let flat = |ring: &[DVec2]| lens.area(ring.iter().filter(|corner| corner.is_finite()).map(|p| p.extend(0.0)));
        let mut marks = Vec::new();
        for area in &self.walkable {
            let rings: Vec<_> = std::iter::once(&area.outer).chain(&area.holes).map(|ring| flat(ring)).collect();
            let edge = Primitive::Line {
                points: rings[0].clone(),
                closed: true,
                stroke: Stroke::plain(1.2 * unit, theme.edge),
            };
            marks.extend([Primitive::Area { rings, fill: theme.ground }, edge]);
        }
        let ribbons = self.paths.iter().flat_map(|path| &path.areas).map(|area| lens.area(area.iter().copied()));
        marks.extend(ribbons.map(|ring| Primitive::Area { rings: vec![ring], fill: Ribbon::tone(theme) }));
        marks.push(Primitive::Trails(self.grid(lens, unit)));
        for line in &self.lines {
            let stroke = Stroke::plain(LINE * unit, theme.edge);
            let ends = line
                .windows(2)
                .filter_map(|ends| Some((lens.pixel(ends[0].extend(0.0))?, lens.pixel(ends[1].extend(0.0))?)));
            marks.extend(ends.map(|(a, b)| Primitive::Line { points: vec![a, b], closed: false, stroke }));
        }
        let spines = self.paths.iter().flat_map(|path| path.spine.windows(2));
        marks.extend(spines.filter_map(|ends| {
            let points = lens.line(ends[0], ends[1])?.to_vec();
            Some(Primitive::Line { points, closed: false, stroke: Ribbon::stroke(theme, unit) })
        }));
        for (corners, tint) in &self.areas {
            let points = flat(corners);
            marks.push(Primitive::Area { rings: vec![points.clone()], fill: theme.goal.alpha(*tint) });
            let stroke = Stroke { width: 1.1 * unit, color: theme.goal.alpha(0.8), dash: Some(4.0 * unit) };
            marks.push(Primitive::Line { points, closed: true, stroke });
        }
        let faint = if self.spots.len() > MANY_GOALS { 0.35 } else { 0.9 };
        for &(at, near) in &self.spots {
            // The ring keeps a visible size.
            let radius = near.max(3.0 * f64::from(unit) / lens.scale(at));
            let stroke = Stroke::plain(1.1 * unit, theme.goal.alpha(faint * (1.0 - lens.haze(at))));
            if at.z > 0.0 {
                let ring = |center| Primitive::Ring { center, radius: (radius * lens.scale(at)) as f32, stroke };
                marks.extend(lens.pixel(at).map(ring));
            } else {
                let around = (0..ROUND).map(|k| DVec2::from_angle(k as f64 * TAU / ROUND as f64) * radius);
                let points = lens.area(around.map(|out| at + out.extend(0.0)));
                marks.push(Primitive::Line { points, closed: true, stroke });
            }
        }
        marks
    }

    /// Returns lines in both directions that fade towards the rim of the grid.
    fn grid(&self, lens: &Lens, unit: f32) -> Vec<Trail> {
        let (cell, count) = (self.cell, (self.reach / self.cell).ceil());
        let origin = (self.middle / cell).round() * cell;
        let steps = || (0..=2 * count as usize).map(move |k| (k as f64 - count) * cell);
        let end = |point: DVec2| {
            let spot = point.extend(0.0);
            let fresh = 1.0 - (point.distance(self.middle) / self.reach).min(1.0) as f32;
            Some(End { at: lens.pixel(spot)?, half: 0.45 * unit, opacity: OPACITY * fresh, away: 0.0 })
        };
        let lines = steps().flat_map(|across| {
            let line = move |turn: fn(DVec2) -> DVec2| steps().map(move |along| turn(DVec2::new(along, across)));
            [line(|p| p).collect::<Vec<_>>(), line(DVec2::perp).collect()]
        });
        lines
            .flat_map(|line| Trail::parts(line.into_iter().map(|offset| end(origin + offset)), self.theme.edge))
            .collect()
    }
}
