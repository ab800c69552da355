//! Colours of neighbours and walls, and badges with numbers.

use super::sheet::FigureLayout;
use crate::Color;
use crate::color::{PALETTE, palette};
use crate::primitive::{Anchor, Primitive};
use glam::Vec2;
use throng::avoid::Cause;

/// The colour of the explained agent: the last of the palette, which neighbours never have.
pub(super) const ACCENT: Color = PALETTE[PALETTE.len() - 1];

/// Returns the colour of a neighbour.
pub(super) fn neighbour(index: usize) -> Color {
    let own = PALETTE.len() - 1;
    palette(index / own * PALETTE.len() + index % own)
}

/// Returns the colour of the region that a cause forbids.
pub(super) fn cause(cause: Cause, sheet: &FigureLayout) -> Color {
    let theme = &sheet.style.theme;
    match cause {
        Cause::Neighbour(index) => neighbour(index),
        Cause::Edge(_) | Cause::Disc(_) => theme.edge,
        Cause::Body => theme.goal,
    }
}

/// Returns the radius of a badge.
pub(super) fn badge_radius(sheet: &FigureLayout) -> f32 {
    9.5 * sheet.unit
}

/// Draws a disc with a number.
pub(super) fn badge(number: u32, color: Color, center: Vec2, sheet: &FigureLayout, marks: &mut Vec<Primitive>) {
    let radius = badge_radius(sheet);
    marks.push(Primitive::Disc { center, radius: radius + 1.2 * sheet.unit, fill: sheet.style.theme.ground });
    marks.push(Primitive::Disc { center, radius, fill: color });
    marks.push(inscribed(number, color, center, radius, sheet));
}

/// Returns a number inside a disc of this colour and radius.
pub(super) fn inscribed(number: u32, color: Color, center: Vec2, radius: f32, sheet: &FigureLayout) -> Primitive {
    let text = number.to_string();
    let size = (1.25 * radius).min(1.15 * sheet.size);
    let size = size * (1.6 * radius / sheet.typeface.width(&text, size)).min(1.0);
    let light = 0.30 * f32::from(color.r) + 0.59 * f32::from(color.g) + 0.11 * f32::from(color.b);
    let color = if light > 140.0 { Color::rgb(0x1c2026) } else { Color::rgb(0xffffff) };
    Primitive::Text { text, at: center + Vec2::new(0.0, 0.36 * size), anchor: Anchor::Middle, size, color }
}
