//! Arrows and their ends: how each kind of velocity is drawn in the plot, near the agent and in the key.

use super::sheet::FigureLayout;
use super::tint::ACCENT;
use crate::Color;
use crate::primitive::{Primitive, Stroke};
use glam::Vec2;
use throng::Explanation;

/// A velocity of the explained agent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    /// The current velocity.
    Now,
    /// The preferred velocity.
    Preferred,
    /// The velocity that the model chooses.
    Chosen,
    /// The chosen velocity within the limits of the body.
    Limited,
    /// The velocity after the guard.
    Guarded,
}

impl Quantity {
    /// All quantities, in the order of the computation.
    pub(super) const ALL: [Self; 5] = [Self::Now, Self::Preferred, Self::Chosen, Self::Limited, Self::Guarded];

    pub(super) fn of(self, why: &Explanation) -> Vec2 {
        match self {
            Self::Now => why.velocity,
            Self::Preferred => why.preferred,
            Self::Chosen => why.chosen,
            Self::Limited => why.limited,
            Self::Guarded => why.guarded,
        }
    }

    /// Returns the label at the end of the arrow.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Now => "now",
            Self::Preferred => "preferred",
            Self::Chosen => "chosen",
            Self::Limited => "limited",
            Self::Guarded => "guarded",
        }
    }

    /// Returns the text of the key.
    pub(super) fn says(self) -> &'static str {
        match self {
            Self::Now => "current velocity",
            Self::Preferred => "preferred",
            Self::Chosen => "chosen by the model",
            Self::Limited => "limited by the body",
            Self::Guarded => "after the guard",
        }
    }

    /// Draws an arrow from `from` to `to` (pixels), or only the symbol at its end.
    pub(super) fn draw(self, from: Vec2, to: Vec2, sheet: &FigureLayout, marks: &mut Vec<Primitive>) {
        let (theme, unit) = (&sheet.style.theme, sheet.unit);
        match self {
            Self::Now => arrow(from, to, Stroke::plain(1.6 * unit, theme.quiet), unit, marks),
            Self::Preferred => {
                let stroke = Stroke { width: 1.8 * unit, color: theme.text, dash: Some(5.0 * unit) };
                arrow(from, to, stroke, unit, marks);
            }
            Self::Chosen => arrow(from, to, Stroke::plain(2.6 * unit, ACCENT), unit, marks),
            Self::Limited => {
                let half = 5.0 * unit;
                let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
                let points = corners.map(|corner| to + Vec2::from(corner) * half).to_vec();
                marks.push(Primitive::Line { points, closed: true, stroke: Stroke::plain(1.5 * unit, theme.text) });
            }
            Self::Guarded => {
                let stroke = Stroke::plain(1.5 * unit, theme.text);
                marks.push(Primitive::Ring { center: to, radius: 7.5 * unit, stroke });
            }
        }
    }
}

/// Draws a line with a filled head, or a dot if the line is too short for a head.
pub(crate) fn arrow(from: Vec2, to: Vec2, stroke: Stroke, unit: f32, marks: &mut Vec<Primitive>) {
    let (length, color) = (from.distance(to), stroke.color);
    let head = (4.0 * unit + 2.2 * stroke.width).min(length);
    if length < 2.0 * unit || !length.is_finite() {
        marks.push(Primitive::Disc { center: to, radius: 1.2 * stroke.width.max(1.5 * unit), fill: color });
        return;
    }
    let along = (to - from) / length;
    let (base, side) = (to - along * head, along.perp() * (0.38 * head));
    marks.push(Primitive::Line { points: vec![from, base], closed: false, stroke });
    marks.push(Primitive::Area { rings: vec![vec![to, base + side, base - side]], fill: color });
}

/// Draws the arrow of another agent's velocity.
pub(super) fn thin(from: Vec2, to: Vec2, color: Color, unit: f32, marks: &mut Vec<Primitive>) {
    if from.distance(to) >= 4.0 * unit {
        arrow(from, to, Stroke::plain(1.4 * unit, color), unit, marks);
    }
}
