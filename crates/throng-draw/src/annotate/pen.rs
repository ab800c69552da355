//! Thin lines in the world, however it is projected.

use crate::Color;
use crate::figure::arrow;
use crate::mark::{Mark, Stroke};
use crate::projector::Projector;
use glam::DVec3;

/// Arrows shorter than this are left out, in units of the layout.
const LEAST_ARROW: f32 = 4.0;

/// Draws in one colour and width.
#[derive(Debug)]
pub(super) struct Pen<'a> {
    pub projector: &'a Projector,
    pub unit: f32,
    pub color: Color,
    pub width: f32,
    pub dashed: bool,
    pub marks: &'a mut Vec<Mark>,
}

impl Pen<'_> {
    fn stroke(&self) -> Stroke {
        let dash = self.dashed.then_some(3.0 * self.unit);
        Stroke { width: self.width * self.unit, color: self.color, dash }
    }

    /// A line from point to point.
    pub fn line(&mut self, points: impl IntoIterator<Item = DVec3>) {
        let pixels: Vec<_> = points.into_iter().map(|point| self.projector.pixel(point)).collect();
        for part in pixels.split(|pixel| pixel.is_none()).filter(|part| part.len() > 1) {
            let points = part.iter().copied().flatten().collect();
            self.marks.push(Mark::Line { points, closed: false, stroke: self.stroke() });
        }
    }

    /// An arrow, if it is long enough to be seen.
    pub fn arrow(&mut self, from: DVec3, along: DVec3) {
        if let Some([from, to]) = self.projector.line(from, from + along)
            && from.distance(to) >= LEAST_ARROW * self.unit
        {
            arrow(from, to, self.stroke(), 0.7 * self.unit, self.marks);
        }
    }

    /// A ring of so many pixels, in units of the layout, round a point.
    pub fn ring(&mut self, center: DVec3, radius: f32) {
        if let Some(center) = self.projector.pixel(center) {
            let stroke = Stroke { dash: None, ..self.stroke() };
            self.marks.push(Mark::Ring { center, radius: radius * self.unit, stroke });
        }
    }

    /// A dot on a point.
    pub fn dot(&mut self, center: DVec3, radius: f32) {
        if let Some(center) = self.projector.pixel(center) {
            self.marks.push(Mark::Disc { center, radius: radius * self.unit, fill: self.color });
        }
    }
}
