//! Thin lines in the world, for any projection.

use crate::Color;
use crate::figure::arrow;
use crate::primitive::{Primitive, Stroke};
use crate::projector::Projector;
use glam::{DVec3, Vec2};
use std::f64::consts::TAU;

/// The number of segments of a circle.
pub(super) const ROUND: usize = 64;
/// The least length of arrows, in units of the layout; shorter arrows are left out.
const LEAST_ARROW: f32 = 2.5;

/// A pen with one colour and width.
#[derive(Debug)]
pub(super) struct AnnotationPen<'a> {
    pub projector: &'a Projector,
    pub unit: f32,
    pub color: Color,
    pub width: f32,
    pub dashed: bool,
    pub marks: &'a mut Vec<Primitive>,
}

impl AnnotationPen<'_> {
    fn stroke(&self) -> Stroke {
        let dash = self.dashed.then_some(3.0 * self.unit);
        Stroke { width: self.width * self.unit, color: self.color, dash }
    }

    /// Draws a line through points.
    pub fn line(&mut self, points: impl IntoIterator<Item = DVec3>) {
        let pixels: Vec<_> = points.into_iter().map(|point| self.projector.pixel(point)).collect();
        for part in pixels.split(|pixel| pixel.is_none()).filter(|part| part.len() > 1) {
            let points = part.iter().copied().flatten().collect();
            self.marks.push(Primitive::Line { points, closed: false, stroke: self.stroke() });
        }
    }

    /// Fills a polygon with the colour, at `shade` of its opacity; nothing if a corner is behind the viewpoint.
    pub fn area(&mut self, corners: &[DVec3], shade: f32) {
        let ring: Option<Vec<_>> = corners.iter().map(|&corner| self.projector.pixel(corner)).collect();
        if let Some(ring) = ring {
            self.marks.push(Primitive::Area { rings: vec![ring], fill: self.color.faded(shade) });
        }
    }

    /// Draws a line through points, back to the first.
    pub fn outline(&mut self, points: &[DVec3]) {
        self.line(points.iter().chain(points.first()).copied());
    }

    /// Draws a circle about an axis of length 1. `radius` is in metres.
    pub fn circle(&mut self, center: DVec3, axis: DVec3, radius: f64) {
        let (x, y) = axis.any_orthonormal_pair();
        self.line((0..=ROUND).map(|k| {
            let (sin, cos) = (TAU * k as f64 / ROUND as f64).sin_cos();
            center + (x * cos + y * sin) * radius
        }));
    }

    /// Draws a diagonal cross on a point. `radius` is in units of the layout.
    pub fn cross(&mut self, center: DVec3, radius: f32) {
        if let Some(center) = self.projector.pixel(center) {
            for arm in [Vec2::new(1.0, 1.0), Vec2::new(1.0, -1.0)] {
                let arm = arm * (radius * self.unit);
                let stroke = Stroke { dash: None, ..self.stroke() };
                self.marks.push(Primitive::Line { points: vec![center - arm, center + arm], closed: false, stroke });
            }
        }
    }

    /// Draws an arrow, if it is long enough.
    pub fn arrow(&mut self, from: DVec3, along: DVec3) {
        if let Some([from, to]) = self.projector.line(from, from + along)
            && from.distance(to) >= LEAST_ARROW * self.unit
        {
            arrow(from, to, self.stroke(), 0.7 * self.unit, self.marks);
        }
    }

    /// Draws a ring around a point. `radius` is in units of the layout.
    pub fn ring(&mut self, center: DVec3, radius: f32) {
        if let Some(center) = self.projector.pixel(center) {
            let stroke = Stroke { dash: None, ..self.stroke() };
            self.marks.push(Primitive::Ring { center, radius: radius * self.unit, stroke });
        }
    }

    /// Draws a dot on a point. `radius` is in units of the layout.
    pub fn dot(&mut self, center: DVec3, radius: f32) {
        if let Some(center) = self.projector.pixel(center) {
            self.marks.push(Primitive::Disc { center, radius: radius * self.unit, fill: self.color });
        }
    }
}
