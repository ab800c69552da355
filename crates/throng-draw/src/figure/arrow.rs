//! Arrows and the ends of arrows: how each kind of velocity is drawn, in the plot, near the agent and in the key.

use super::sheet::Sheet;
use super::tint::ACCENT;
use crate::Color;
use crate::mark::{Mark, Stroke};
use glam::Vec2;
use throng::Explanation;

/// A velocity of the agent that is explained.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    /// It has it.
    Now,
    /// It would like it.
    Preferred,
    /// The model chooses it.
    Chosen,
    /// The body can do it.
    Limited,
    /// The guard leaves it.
    Guarded,
}

impl Quantity {
    /// All of them, in the order in which one leads to the next.
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

    /// Beside its end.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Now => "now",
            Self::Preferred => "preferred",
            Self::Chosen => "chosen",
            Self::Limited => "limited",
            Self::Guarded => "guarded",
        }
    }

    /// In the key.
    pub(super) fn says(self) -> &'static str {
        match self {
            Self::Now => "its velocity now",
            Self::Preferred => "preferred",
            Self::Chosen => "chosen by the model",
            Self::Limited => "limited by the body",
            Self::Guarded => "left by the guard",
        }
    }

    /// From `from` to `to`, pixels: an arrow, or only what stands at its end.
    pub(super) fn draw(self, from: Vec2, to: Vec2, sheet: &Sheet, marks: &mut Vec<Mark>) {
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
                marks.push(Mark::Line { points, closed: true, stroke: Stroke::plain(1.5 * unit, theme.text) });
            }
            Self::Guarded => {
                let stroke = Stroke::plain(1.5 * unit, theme.text);
                marks.push(Mark::Ring { center: to, radius: 7.5 * unit, stroke });
            }
        }
    }
}

/// A line with a filled head; what is too short for a head is a dot.
pub(crate) fn arrow(from: Vec2, to: Vec2, stroke: Stroke, unit: f32, marks: &mut Vec<Mark>) {
    let (length, color) = (from.distance(to), stroke.color);
    let head = (4.0 * unit + 2.2 * stroke.width).min(length);
    if length < 2.0 * unit || !length.is_finite() {
        marks.push(Mark::Disc { center: to, radius: 1.2 * stroke.width.max(1.5 * unit), fill: color });
        return;
    }
    let along = (to - from) / length;
    let (base, side) = (to - along * head, along.perp() * (0.38 * head));
    marks.push(Mark::Line { points: vec![from, base], closed: false, stroke });
    marks.push(Mark::Area { rings: vec![vec![to, base + side, base - side]], fill: color });
}

/// The arrow of somebody else's velocity.
pub(super) fn thin(from: Vec2, to: Vec2, color: Color, unit: f32, marks: &mut Vec<Mark>) {
    if from.distance(to) >= 4.0 * unit {
        arrow(from, to, Stroke::plain(1.4 * unit, color), unit, marks);
    }
}
