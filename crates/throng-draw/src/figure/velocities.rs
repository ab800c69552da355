//! The velocity space of the agent: forbidden and permitted velocities, candidates, and the result.

use super::arrow::{self, Quantity};
use super::labels::{Labels, beside};
use super::sheet::{FigureLayout, Rect};
use super::{region, tint};
use crate::color::ramp;
use crate::primitive::{Anchor, Primitive, Stroke};
use crate::{Camera, Color, WorldBox, legend};
use glam::{DVec2, Vec2};
use throng::Explanation;
use throng::avoid::{AvoidanceReason, Cause};

/// The range of the plot over the greatest speed.
const AROUND: f32 = 1.28;
/// The opacity of the region of a single reason.
const SHADE: f32 = 0.28;

/// An entry of the key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Entry {
    Velocity(Quantity),
    Neighbour,
    Wall,
    Left,
    Speed,
    Push,
    Candidate,
    Refused,
}

/// Returns the entries of the key that this figure needs.
pub(super) fn key(why: &Explanation) -> Vec<Entry> {
    let has = |test: fn(Cause) -> bool| {
        why.reasons.iter().any(|reason| reason.depth(Vec2::ZERO).is_some_and(|(c, _)| test(c)))
    };
    let mut key: Vec<Entry> = Quantity::ALL.map(Entry::Velocity).to_vec();
    let others = [
        (has(|cause| matches!(cause, Cause::Neighbour(_))), Entry::Neighbour),
        (has(|cause| matches!(cause, Cause::Edge(_) | Cause::Disc(_))), Entry::Wall),
        (left(why).is_some(), Entry::Left),
        (true, Entry::Speed),
        (pushes(why).next().is_some(), Entry::Push),
        (candidates(why).any(|(_, cost)| cost.is_finite()), Entry::Candidate),
        (candidates(why).any(|(_, cost)| !cost.is_finite()), Entry::Refused),
    ];
    key.extend(others.into_iter().filter(|(there, _)| *there).map(|(_, entry)| entry));
    key
}

impl Entry {
    pub(super) fn says(self) -> &'static str {
        match self {
            Self::Velocity(quantity) => quantity.says(),
            Self::Neighbour => "forbidden by a neighbour",
            Self::Wall => "forbidden by a wall",
            Self::Left => "permitted by all constraints",
            Self::Speed => "within the maximum speed",
            Self::Push => "push of a neighbour or a wall",
            Self::Candidate => "tried: costly to cheap",
            Self::Refused => "tried: forbidden",
        }
    }

    /// Draws a sample between two points.
    pub(super) fn sample(self, from: Vec2, to: Vec2, sheet: &FigureLayout, marks: &mut Vec<Primitive>) {
        let (theme, unit) = (&sheet.style.theme, sheet.unit);
        let half = Vec2::new(0.0, 7.0 * unit);
        let area = vec![from - half, to - half, to + half, from + half];
        match self {
            Self::Velocity(quantity @ (Quantity::Limited | Quantity::Guarded)) => {
                quantity.draw(from, from.midpoint(to), sheet, marks);
            }
            Self::Velocity(quantity) => quantity.draw(from, to, sheet, marks),
            Self::Neighbour => shade(area, tint::neighbour(0), 0.2, sheet, marks),
            Self::Wall => shade(area, tint::cause(Cause::Edge(0), sheet), 0.2, sheet, marks),
            Self::Left => outline_left(area, sheet, marks),
            Self::Speed => {
                let (center, radius) = (from.midpoint(to), 8.0 * unit);
                let stroke = Stroke { width: 1.2 * unit, color: theme.quiet, dash: Some(3.0 * unit) };
                marks.push(Primitive::Disc { center, radius, fill: theme.notch.alpha(0.75) });
                marks.push(Primitive::Ring { center, radius, stroke });
            }
            Self::Push => arrow::thin(from, to, tint::neighbour(0), unit, marks),
            Self::Candidate => {
                for t in [0.0, 0.25, 0.5, 0.75, 1.0] {
                    candidate(from.lerp(to, t), Some(t), sheet, marks);
                }
            }
            Self::Refused => candidate(from.midpoint(to), None, sheet, marks),
        }
    }
}

/// Returns the primitives of the plot, which can extend beyond its edges, and the numbers outside.
pub(super) fn marks(why: &Explanation, sheet: &FigureLayout) -> [Vec<Primitive>; 2] {
    let mut plot = Plot::new(why, sheet);
    plot.regions();
    plot.candidates();
    plot.pushes();
    plot.quantities();
    plot.badges();
    let numbers = plot.numbers();
    [plot.marks, numbers]
}

/// Returns the velocities that all reasons permit, where the region is convex.
fn left(why: &Explanation) -> Option<Vec<Vec2>> {
    region::permitted(&why.reasons, why.max_speed).filter(|polygon| polygon.len() >= 3)
}

/// Returns the candidates and their costs.
fn candidates(why: &Explanation) -> impl Iterator<Item = (Vec2, f32)> {
    why.reasons.iter().filter_map(|reason| match *reason {
        AvoidanceReason::Candidate { velocity, cost } => Some((velocity, cost)),
        _ => None,
    })
}

/// Returns the pushes and their causes: accelerations, m/s^2, or shares of the direction.
fn pushes(why: &Explanation) -> impl Iterator<Item = (Cause, Vec2)> {
    why.reasons.iter().filter_map(|reason| match *reason {
        AvoidanceReason::Push(cause, push) => Some((cause, push)),
        _ => None,
    })
}

/// The least distance of two numbers of an axis, in sizes of letters.
const NUMBER: f32 = 2.8;

struct Plot<'a> {
    why: &'a Explanation,
    sheet: &'a FigureLayout<'a>,
    camera: Camera,
    /// The greatest coordinate of the plot, m/s.
    reach: f32,
    labels: Labels,
    marks: Vec<Primitive>,
}

impl<'a> Plot<'a> {
    fn new(why: &'a Explanation, sheet: &'a FigureLayout<'a>) -> Self {
        let most = Quantity::ALL.map(|quantity| quantity.of(why).abs().max_element());
        let most = most.into_iter().filter(|x| x.is_finite()).fold(why.max_speed, f32::max);
        let reach = if most > 0.0 { AROUND * most } else { 1.0 };
        let half = DVec2::splat(f64::from(reach));
        let camera = Camera::fit(WorldBox { min: -half, max: half }, sheet.plot.low, sheet.plot.high);
        Self { why, sheet, camera, reach, labels: Labels::new(sheet.plot.inset(3.0 * sheet.unit)), marks: Vec::new() }
    }

    fn pixel(&self, velocity: Vec2) -> Vec2 {
        self.camera.pixel(velocity.as_dvec2())
    }

    /// Returns round values along an axis, m/s. Their numbers have room beside each other.
    fn ticks(&self) -> impl Iterator<Item = f64> + use<> {
        let reach = f64::from(self.reach);
        let mut step = legend::round_length(reach / 2.4);
        while step < reach && self.camera.length(step) < NUMBER * self.sheet.size {
            step = legend::round_length(2.5 * step);
        }
        let most = (reach / step).floor() as i32;
        (-most..=most).map(move |k| f64::from(k) * step)
    }

    fn grid(&mut self) {
        let Rect { low, high } = self.sheet.plot;
        for value in self.ticks() {
            let at = self.camera.pixel(DVec2::splat(value));
            let opacity = if value == 0.0 { 0.9 } else { 0.3 };
            let stroke = Stroke::plain(self.sheet.unit, self.sheet.style.theme.edge.alpha(opacity));
            for ends in
                [[Vec2::new(at.x, low.y), Vec2::new(at.x, high.y)], [Vec2::new(low.x, at.y), Vec2::new(high.x, at.y)]]
            {
                self.marks.push(Primitive::Line { points: ends.to_vec(), closed: false, stroke });
            }
        }
    }

    fn numbers(&self) -> Vec<Primitive> {
        let (sheet, unit) = (self.sheet, self.sheet.unit);
        let Rect { low, high } = sheet.plot;
        let number = |value: f64| {
            let at = self.camera.pixel(DVec2::splat(value));
            // Rounding removes the error of multiples of a decimal step.
            let text = ((value * 1e6).round() / 1e6).to_string().replace('-', "−");
            let below = Vec2::new(at.x, high.y + 18.0 * unit);
            let beside = Vec2::new(low.x - 7.0 * unit, at.y + 0.34 * sheet.size);
            let quiet = sheet.style.theme.quiet;
            [sheet.text(text.clone(), below, Anchor::Middle, quiet), sheet.text(text, beside, Anchor::End, quiet)]
        };
        self.ticks().flat_map(number).collect()
    }

    fn regions(&mut self) {
        let (why, sheet) = (self.why, self.sheet);
        let (zero, radius) = (self.pixel(Vec2::ZERO), self.camera.length(f64::from(why.max_speed)));
        self.marks.push(Primitive::Disc { center: zero, radius, fill: sheet.style.theme.notch.alpha(0.75) });
        self.grid();
        // The polygons extend beyond the plot, so that its edge does not look like the edge of a region.
        let polygons = why.reasons.iter().filter_map(|reason| region::forbidden(reason, 1.5 * self.reach));
        let polygons: Vec<_> = polygons.collect();
        // With many overlapping regions, lower opacity keeps their colours distinct.
        let opacity = SHADE / (polygons.len() as f32).sqrt();
        for (cause, polygon) in polygons {
            let points = polygon.into_iter().map(|v| self.pixel(v)).collect();
            shade(points, tint::cause(cause, sheet), opacity, sheet, &mut self.marks);
        }
        if let Some(polygon) = left(why) {
            let points = polygon.into_iter().map(|v| self.pixel(v)).collect();
            outline_left(points, sheet, &mut self.marks);
        }
        let stroke = Stroke { width: 1.2 * sheet.unit, color: sheet.style.theme.quiet, dash: Some(3.0 * sheet.unit) };
        self.marks.push(Primitive::Ring { center: zero, radius, stroke });
    }

    fn candidates(&mut self) {
        let costs = || candidates(self.why).map(|(_, cost)| cost).filter(|cost| cost.is_finite());
        let (low, high) = (costs().fold(f32::INFINITY, f32::min), costs().fold(f32::NEG_INFINITY, f32::max));
        for (velocity, cost) in candidates(self.why) {
            // Costs of collisions grow without bound; the root separates the low costs.
            let part = ((cost - low) / (high - low).max(1e-6)).sqrt();
            candidate(self.pixel(velocity), cost.is_finite().then_some(1.0 - part), self.sheet, &mut self.marks);
        }
    }

    /// Draws pushes as the change of velocity in one second.
    fn pushes(&mut self) {
        let velocity = self.why.velocity;
        for (cause, push) in pushes(self.why) {
            let color = tint::cause(cause, self.sheet);
            let ends = [velocity, velocity + push.clamp_length_max(4.0 * self.reach)].map(|v| self.pixel(v));
            arrow::thin(ends[0], ends[1], color, self.sheet.unit, &mut self.marks);
        }
    }

    /// Draws the agent's velocities, with one label for coinciding ones.
    fn quantities(&mut self) {
        let (why, sheet, unit) = (self.why, self.sheet, self.sheet.unit);
        let zero = self.pixel(Vec2::ZERO);
        let mut ends: Vec<(Vec2, String)> = Vec::new();
        for quantity in Quantity::ALL {
            let end = self.pixel(quantity.of(why));
            quantity.draw(zero, end, sheet, &mut self.marks);
            self.labels.keep(end, 8.0 * unit);
            self.labels.keep_line(zero, end, 2.0 * unit);
            match ends.iter_mut().find(|(other, _)| other.distance(end) < 6.0 * unit) {
                // Later quantities that equal the chosen velocity need no label: their symbols show them.
                Some((_, names)) if names.ends_with(Quantity::Chosen.name()) => {}
                Some((_, names)) => *names += &format!(", {}", quantity.name()),
                None => ends.push((end, quantity.name().to_owned())),
            }
        }
        for (end, names) in ends {
            let half = sheet.half(&names);
            if let Some(center) = self.labels.place(half, beside(end, half, 9.0 * unit, end - zero)) {
                sheet.label(&names, center, &mut self.marks);
            }
        }
    }

    /// Draws the numbers of neighbours, each where its region is least covered by other regions.
    fn badges(&mut self) {
        let (why, sheet) = (self.why, self.sheet);
        let half = tint::badge_radius(sheet);
        let inset = sheet.plot.inset(1.5 * half);
        let steps = ((inset.high - inset.low) / (0.8 * half)).floor().max(Vec2::ONE).min(Vec2::splat(200.0));
        let spots = |x: u32, y: u32| inset.low + (inset.high - inset.low) * Vec2::new(x as f32, y as f32) / steps;
        let spots: Vec<(Vec2, Vec2)> = (0..=steps.y as u32)
            .flat_map(|y| (0..=steps.x as u32).map(move |x| spots(x, y)))
            .map(|at| (at, self.velocity(at)))
            .collect();
        let needed = f64::from(1.3 * half) / self.camera.scale;
        for (index, other) in why.neighbours.iter().enumerate() {
            let depth =
                |reason: &AvoidanceReason, v: Vec2| reason.depth(v).map_or(f32::NEG_INFINITY, |(_, depth)| depth);
            let own =
                |reason: &&AvoidanceReason| reason.depth(Vec2::ZERO).is_some_and(|(c, _)| c == Cause::Neighbour(index));
            let Some(reason) = why.reasons.iter().find(own) else { continue };
            let mut good: Vec<(f32, Vec2)> = Vec::new();
            for &(at, v) in &spots {
                let deep = depth(reason, v);
                if f64::from(deep) >= needed {
                    let covered = why.reasons.iter().filter(|other| depth(other, v) > 0.0).count();
                    good.push((covered as f32 + 2.0 * deep / self.reach, at));
                }
            }
            good.sort_by(|a, b| a.0.total_cmp(&b.0));
            if let Some(center) = self.labels.place(Vec2::splat(half), good.into_iter().map(|(_, at)| at)) {
                tint::badge(other.number, tint::neighbour(index), center, sheet, &mut self.marks);
            }
        }
    }

    fn velocity(&self, at: Vec2) -> Vec2 {
        let offset = (at - self.camera.anchor) / self.camera.scale as f32;
        Vec2::new(offset.x, -offset.y)
    }
}

/// Draws a forbidden region.
fn shade(points: Vec<Vec2>, color: Color, opacity: f32, sheet: &FigureLayout, marks: &mut Vec<Primitive>) {
    marks.push(Primitive::Area { rings: vec![points.clone()], fill: color.alpha(opacity) });
    let stroke = Stroke::plain(1.3 * sheet.unit, color.mix(sheet.style.theme.text, 0.15));
    marks.push(Primitive::Line { points, closed: true, stroke });
}

/// Draws the permitted region.
fn outline_left(points: Vec<Vec2>, sheet: &FigureLayout, marks: &mut Vec<Primitive>) {
    let theme = &sheet.style.theme;
    marks.push(Primitive::Area { rings: vec![points.clone()], fill: theme.notch.alpha(0.75) });
    marks.push(Primitive::Line { points, closed: true, stroke: Stroke::plain(2.0 * sheet.unit, theme.text) });
}

/// Draws a candidate: `good` is 0 to 1, `None` for a forbidden one.
fn candidate(center: Vec2, good: Option<f32>, sheet: &FigureLayout, marks: &mut Vec<Primitive>) {
    let radius = 2.2 * sheet.unit;
    marks.push(match good {
        Some(good) => Primitive::Disc { center, radius, fill: ramp(good) },
        None => Primitive::Ring { center, radius, stroke: Stroke::plain(0.8 * sheet.unit, sheet.style.theme.quiet) },
    });
}
