//! The anchors of sketched fields: dots with their velocities.

use super::blade::arrow;
use super::{Lay, Vec2};
use crate::primitive::{Primitive, Stroke};
use crate::{Color, Theme};
use throng_field::Anchor;

/// The colour of the anchors of a single field, which nothing else in a field has.
const ACCENT: Color = Color::rgb(0xd9741a);
/// The radius of dots, the least and the greatest length of the arrow of the fastest anchor, and half the width of its
/// shaft, in units of the layout.
const RADIUS: f32 = 2.4;
const LEAST: f32 = 8.0;
const LONGEST: f32 = 22.0;
const HALF: f32 = 0.85;

/// Returns the colour of anchors; those of several fields have the colours of their fields.
pub(super) fn color(ink: Color, fields: usize, theme: &Theme) -> Color {
    theme.ink(if fields > 1 { ink } else { ACCENT })
}

/// Returns the visible anchors.
pub(super) fn anchors(lay: &Lay<'_>, anchors: &[Anchor]) -> Vec<Primitive> {
    let unit = lay.canvas.unit;
    let color = color(lay.ink, lay.turn.1, lay.theme);
    let pixel = |anchor: &Anchor| (lay.canvas.pixel(anchor.place), anchor.velocity.as_vec2());
    let shown: Vec<(Vec2, Vec2)> =
        anchors.iter().map(pixel).filter(|(at, velocity)| lay.canvas.shows(*at) && velocity.is_finite()).collect();
    // Arrows along a stroke do not reach its next dot.
    let longest = (0.78 * apart(&shown)).clamp(LEAST * unit, LONGEST * unit);
    let draw = |&(at, velocity): &(Vec2, Vec2)| {
        let flow = Vec2::new(velocity.x, -velocity.y);
        dot(at, flow.normalize_or_zero() * (lay.part(flow).sqrt() * longest), unit, (color, lay.theme))
    };
    shown.iter().flat_map(draw).collect()
}

/// Returns the median distance from an anchor to the nearest other anchor, pixels.
fn apart(shown: &[(Vec2, Vec2)]) -> f32 {
    // A sample of about 200 anchors is enough.
    let few = shown.iter().step_by(shown.len() / 200 + 1);
    let next = |&(at, _): &(Vec2, Vec2)| {
        let others = shown.iter().map(|other| other.0.distance_squared(at)).filter(|&distance| distance > 0.0);
        others.fold(f32::INFINITY, f32::min).sqrt()
    };
    let mut all: Vec<f32> = few.map(next).collect();
    all.sort_unstable_by(f32::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(f32::INFINITY)
}

/// Returns an anchor as a dot with an arrow for its velocity. An anchor without velocity is hollow.
pub(super) fn dot(at: Vec2, reach: Vec2, unit: f32, (color, theme): (Color, &Theme)) -> Vec<Primitive> {
    let radius = RADIUS * unit;
    let mut marks = vec![Primitive::Disc { center: at, radius: radius + 0.9 * unit, fill: theme.ground.alpha(0.85) }];
    if reach.length() > radius {
        marks.extend(arrow(at, at + reach, HALF * unit, color));
        marks.push(Primitive::Disc { center: at, radius, fill: color });
    } else {
        let stroke = Stroke::plain(1.1 * unit, color);
        marks.push(Primitive::Ring { center: at, radius: radius - 0.3 * unit, stroke });
    }
    marks
}
