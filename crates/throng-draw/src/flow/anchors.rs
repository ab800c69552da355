//! What a field was sketched by: dots, with the velocities wanted there.

use super::blade::arrow;
use super::{Lay, Vec2};
use crate::mark::{Mark, Stroke};
use crate::{Color, Theme};
use throng::field::Anchor;

/// The colour of anchors: nothing else in a field has it.
pub(super) const ACCENT: Color = Color::rgb(0xd9741a);
/// Radius of dots; length of the arrow of the fastest, and half the width of its shaft. In units of the layout.
const RADIUS: f32 = 2.5;
const LONGEST: f32 = 22.0;
const HALF: f32 = 0.85;

/// The anchors that are to be seen.
pub(super) fn anchors(lay: &Lay<'_>, anchors: &[Anchor]) -> Vec<Mark> {
    let pixel = |anchor: &Anchor| (lay.canvas.pixel(anchor.place), anchor.velocity.as_vec2());
    let shown = anchors.iter().map(pixel).filter(|(at, velocity)| lay.canvas.shows(*at) && velocity.is_finite());
    let one = |(at, velocity): (Vec2, Vec2)| {
        let flow = Vec2::new(velocity.x, -velocity.y);
        dot(at, flow.normalize_or_zero() * lay.part(flow).sqrt(), lay.canvas.unit, lay.theme)
    };
    shown.flat_map(one).collect()
}

/// An anchor with its velocity, over the fastest; one without is hollow.
pub(super) fn dot(at: Vec2, part: Vec2, unit: f32, theme: &Theme) -> Vec<Mark> {
    let (radius, reach) = (RADIUS * unit, part * (LONGEST * unit));
    let mut marks = vec![Mark::Disc { center: at, radius: radius + 0.9 * unit, fill: theme.ground.alpha(0.85) }];
    if reach.length() > radius {
        marks.extend(arrow(at, at + reach, HALF * unit, ACCENT));
        marks.push(Mark::Disc { center: at, radius, fill: ACCENT });
    } else {
        let stroke = Stroke::plain(1.1 * unit, ACCENT);
        marks.push(Mark::Ring { center: at, radius: radius - 0.3 * unit, stroke });
    }
    marks
}
