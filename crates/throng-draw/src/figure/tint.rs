//! One colour for each neighbour, one tone for all walls, and badges with numbers on them.

use super::sheet::Sheet;
use crate::Color;
use crate::color::{PALETTE, palette};
use crate::mark::{Anchor, Mark};
use glam::Vec2;
use throng::avoid::Cause;

/// The colour of the agent that is explained: the palette's last, which no neighbour has.
pub(super) const ACCENT: Color = PALETTE[PALETTE.len() - 1];

/// The colour of a neighbour.
pub(super) fn neighbour(index: usize) -> Color {
    let own = PALETTE.len() - 1;
    palette(index / own * PALETTE.len() + index % own)
}

/// The colour of what a cause forbids.
pub(super) fn cause(cause: Cause, sheet: &Sheet) -> Color {
    let theme = &sheet.style.theme;
    match cause {
        Cause::Neighbour(index) => neighbour(index),
        Cause::Edge(_) | Cause::Disc(_) => theme.edge,
        Cause::Body => theme.goal,
    }
}

/// The radius of a badge.
pub(super) fn badge_radius(sheet: &Sheet) -> f32 {
    9.5 * sheet.unit
}

/// A disc with a number on it.
pub(super) fn badge(number: u32, color: Color, center: Vec2, sheet: &Sheet, marks: &mut Vec<Mark>) {
    let radius = badge_radius(sheet);
    marks.push(Mark::Disc { center, radius: radius + 1.2 * sheet.unit, fill: sheet.style.theme.ground });
    marks.push(Mark::Disc { center, radius, fill: color });
    marks.push(inscribed(number, color, center, radius, sheet));
}

/// A number within a disc of this colour and radius.
pub(super) fn inscribed(number: u32, color: Color, center: Vec2, radius: f32, sheet: &Sheet) -> Mark {
    let text = number.to_string();
    let size = (1.25 * radius).min(1.15 * sheet.size);
    let size = size * (1.6 * radius / sheet.typeface.width(&text, size)).min(1.0);
    let light = 0.30 * f32::from(color.r) + 0.59 * f32::from(color.g) + 0.11 * f32::from(color.b);
    let color = if light > 140.0 { Color::rgb(0x1c2026) } else { Color::rgb(0xffffff) };
    Mark::Text { text, at: center + Vec2::new(0.0, 0.36 * size), anchor: Anchor::Middle, size, color }
}
