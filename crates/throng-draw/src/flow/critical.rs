//! Symbols of critical points: isolated zeros of a field, by their kind.

use super::blade::{blade, head};
use super::{Lay, Vec2};
use crate::primitive::{Primitive, Stroke};
use crate::{Color, Theme};
use std::f32::consts::{FRAC_PI_2, TAU};
use throng_field::Critical;

/// The radius of a symbol, in units of the layout.
pub(super) const RADIUS: f32 = 8.5;
/// The colour of points that trap agents, on light and on dark ground.
pub(super) const WARNING: [Color; 2] = [Color::rgb(0xc8372d), Color::rgb(0xf0705f)];
/// The maximum number of symbols: a field of noise has more.
const MOST: usize = 300;
/// The distance at which the surrounding field is tested, in units of the layout. Without flow there, the point is not
/// shown.
const ROUND: f32 = 26.0;

/// The symbol of a critical point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Symbol {
    kind: Critical,
    /// Whether the flow goes to or from the point in a spiral.
    spiral: bool,
    /// 1: clockwise in the picture; -1: counter-clockwise.
    sense: f32,
    /// For a saddle, the directions of outflow and inflow in the picture.
    axes: [Vec2; 2],
}

/// Returns the visible critical points.
pub(super) fn symbols(lay: &Lay<'_>) -> Vec<(Vec2, Symbol)> {
    let flows = |at: &Vec2| {
        let round = (0..8).filter(|&k| {
            let out = Vec2::from_angle(k as f32 * TAU / 8.0) * (ROUND * lay.canvas.unit);
            lay.grid.at(*at + out).length() > Lay::STILL * lay.fastest
        });
        round.count() >= 4
    };
    let points = lay.grid.sampled.critical_points();
    let points = points.iter().map(|point| (lay.canvas.pixel(point.place), point.kind));
    let shown = points.filter(|(at, _)| lay.canvas.free.at(*at) && flows(at));
    shown.take(MOST).map(|(at, kind)| (at, Symbol::new(kind, lay.grid.slope(at)))).collect()
}

impl Symbol {
    /// Returns the symbol of a kind. `with_x` and `with_y` are the derivatives of the flow by x and y of the picture.
    fn new(kind: Critical, [with_x, with_y]: [Vec2; 2]) -> Self {
        let (curl, divergence) = (with_x.y - with_y.x, with_x.x + with_y.y);
        let root = 0.25 * divergence * divergence - with_x.perp_dot(with_y);
        let along = |value: f32| {
            // An eigenvector of the derivative, perpendicular to a row of the derivative minus the eigenvalue.
            let rows = [Vec2::new(with_x.x - value, with_y.x), Vec2::new(with_x.y, with_y.y - value)];
            let row = if rows[0].length() > rows[1].length() { rows[0] } else { rows[1] };
            row.perp().normalize_or(Vec2::X)
        };
        let (half, part) = (0.5 * divergence, root.max(0.0).sqrt());
        Self { kind, spiral: root < 0.0, sense: 1f32.copysign(curl), axes: [along(half + part), along(half - part)] }
    }

    /// Returns the symbol of a kind for the key.
    fn plain(kind: Critical, spiral: bool) -> Self {
        Self { kind, spiral, sense: -1.0, axes: [Vec2::X, Vec2::Y] }
    }

    /// Returns every symbol that the key can show.
    pub fn all() -> impl Iterator<Item = Self> {
        let kinds = [
            (Critical::Sink, false),
            (Critical::Sink, true),
            (Critical::Center, false),
            (Critical::Source, false),
            (Critical::Source, true),
            (Critical::Saddle, false),
        ];
        kinds.into_iter().map(|(kind, spiral)| Self::plain(kind, spiral))
    }

    /// Whether two symbols have the same entry in the key.
    pub fn is_like(&self, other: &Self) -> bool {
        self.says() == other.says()
    }

    /// Returns the text of the key.
    pub fn says(&self) -> &'static str {
        match (self.kind, self.spiral) {
            (Critical::Sink, false) => "sink: a trap",
            (Critical::Sink, true) => "spiral sink: a trap",
            (Critical::Center, _) => "centre: a trap",
            (Critical::Source, false) => "source",
            (Critical::Source, true) => "spiral source",
            (Critical::Saddle, _) => "saddle",
        }
    }

    /// Returns the symbol around a pixel.
    pub fn marks(&self, at: Vec2, radius: f32, theme: &Theme) -> Vec<Primitive> {
        let color = if self.kind.traps() { WARNING[usize::from(theme.is_dark())] } else { theme.text };
        let mut pen = SymbolPen { at, radius, color, marks: Vec::new() };
        pen.marks.push(Primitive::Disc { center: at, radius: 1.22 * radius, fill: theme.ground.alpha(0.88) });
        let quarters = || (0..4).map(|k| Vec2::from_angle((k as f32 + 0.5) * FRAC_PI_2));
        match (self.kind, self.spiral) {
            (Critical::Sink, false) => {
                pen.dot(0.3);
                quarters().for_each(|out| pen.ray(out, 1.0, 0.4));
            }
            (Critical::Source, false) => {
                pen.ring(0.3);
                quarters().for_each(|out| pen.ray(out, 0.42, 1.05));
            }
            (Critical::Saddle, _) => {
                let [away, towards] = self.axes;
                [away, -away].into_iter().for_each(|out| pen.ray(out, 0.12, 1.05));
                [towards, -towards].into_iter().for_each(|out| pen.ray(out, 1.05, 0.22));
            }
            (Critical::Center, _) => {
                pen.dot(0.26);
                [0.0, 0.5].into_iter().for_each(|turn| pen.arm(turn, self.sense, [0.85, 0.85]));
            }
            (kind, true) => {
                let inwards = kind == Critical::Sink;
                if inwards {
                    pen.dot(0.26)
                } else {
                    pen.ring(0.26)
                }
                let radii = if inwards { [1.05, 0.5] } else { [0.45, 1.0] };
                [0.0, 0.5].into_iter().for_each(|turn| pen.arm(turn, self.sense, radii));
            }
        }
        pen.marks
    }
}

/// Draws a symbol in one colour; lengths are in radii of the symbol.
struct SymbolPen {
    at: Vec2,
    radius: f32,
    color: Color,
    marks: Vec<Primitive>,
}

impl SymbolPen {
    /// Half the width of lines, and the length of heads.
    const HALF: f32 = 0.075;
    const HEAD: f32 = 0.48;

    fn dot(&mut self, radius: f32) {
        self.marks.push(Primitive::Disc { center: self.at, radius: radius * self.radius, fill: self.color });
    }

    fn ring(&mut self, radius: f32) {
        let stroke = Stroke::plain(2.0 * Self::HALF * self.radius, self.color);
        self.marks.push(Primitive::Ring { center: self.at, radius: (radius - Self::HALF) * self.radius, stroke });
    }

    /// Draws an arrow along a direction from the middle, from one distance to another.
    fn ray(&mut self, out: Vec2, from: f32, to: f32) {
        let along = out * (to - from).signum();
        self.path(&[out * from, out * to], along);
    }

    /// Draws an arm of 0.36 turns with a head, from one distance to another.
    fn arm(&mut self, turn: f32, sense: f32, [from, to]: [f32; 2]) {
        const STEPS: usize = 14;
        let point = |k: usize| {
            let part = k as f32 / STEPS as f32;
            Vec2::from_angle(sense * TAU * (turn + 0.36 * part)) * (from + (to - from) * part)
        };
        let points: Vec<Vec2> = (0..=STEPS).map(point).collect();
        // The head points along the continuation of the arm.
        let along = (points[STEPS] - points[STEPS - 3]).normalize_or_zero();
        self.path(&points, along);
    }

    fn path(&mut self, points: &[Vec2], along: Vec2) {
        let half = |k: usize| Self::HALF * (0.6 + 0.4 * k as f32 / points.len() as f32) * self.radius;
        let place = |point: Vec2| self.at + point * self.radius;
        let line: Vec<(Vec2, f32)> = (0..).zip(points).map(|(k, &point)| (place(point), half(k))).collect();
        self.marks.extend(blade(&line, self.color));
        let tip = place(points[points.len() - 1]) + along * (0.3 * Self::HEAD * self.radius);
        self.marks.push(Primitive::Area { rings: vec![head(tip, along, Self::HEAD * self.radius)], fill: self.color });
    }
}
