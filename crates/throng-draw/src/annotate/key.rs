//! The key: the meanings of the lines beside agents and of what is drawn on the ground.

use super::Annotation;
use crate::Style;
use crate::primitive::{Anchor, Primitive, Stroke};
use crate::text::Type;
use glam::Vec2;

/// The opacity of the key's background.
const PAPER: f32 = 0.82;

/// A row of the key: a sample and its meaning.
pub(crate) struct Row<'a> {
    /// The width of the sample, pixels.
    pub length: f32,
    pub says: String,
    /// Draws the sample to the right of a point, centred vertically on it.
    pub draw: Box<dyn Fn(Vec2) -> Vec<Primitive> + 'a>,
}

/// Returns a row for each kind that is drawn beside agents. `size` is the size of the type.
pub(crate) fn rows<'a>(kinds: &[Annotation], style: &'a Style, size: f32) -> Vec<Row<'a>> {
    let length = 1.6 * size;
    let row = |&kind: &Annotation| {
        let (width, dash) = (0.11 * size * kind.width().max(1.0), kind.is_dashed().then_some(0.27 * size));
        let stroke = Stroke { width, color: kind.color(&style.theme), dash };
        let draw = move |at| vec![Primitive::Line { points: vec![at, at + Vec2::X * length], closed: false, stroke }];
        Row { length, says: kind.says().into(), draw: Box::new(draw) }
    };
    kinds.iter().map(row).collect()
}

/// Returns the rows below each other, from `at` down. `size` is the size of the type.
pub(crate) fn key(rows: &[Row<'_>], style: &Style, at: Vec2, size: f32, typeface: &Type) -> Vec<Primitive> {
    if rows.is_empty() {
        return Vec::new();
    }
    let (gap, step) = (0.6 * size, 1.3 * size);
    let widest = rows.iter().map(|row| row.length + gap + typeface.width(&row.says, size)).fold(0.0, f32::max);
    let (low, high) = (at - size, at + Vec2::new(widest + gap, (rows.len() as f32 - 0.4) * step));
    let paper = vec![low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)];
    let paper = Primitive::Area { rings: vec![paper], fill: style.theme.ground.alpha(PAPER) };
    let row = |(k, row): (usize, &Row<'_>)| {
        let from = at + Vec2::new(0.0, k as f32 * step);
        let at = from + Vec2::new(row.length + gap, 0.0);
        let color = style.theme.quiet;
        let mut marks = (row.draw)(from - Vec2::new(0.0, 0.32 * size));
        marks.push(Primitive::Text { text: row.says.clone(), at, anchor: Anchor::Start, size, color });
        marks
    };
    std::iter::once(paper).chain(rows.iter().enumerate().flat_map(row)).collect()
}
