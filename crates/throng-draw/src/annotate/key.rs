//! What the lines beside agents are.

use super::Annotation;
use crate::Style;
use crate::mark::{Anchor, Mark, Stroke};
use crate::text::Type;
use glam::Vec2;

/// How much of what is below the key it hides.
const PAPER: f32 = 0.82;

/// A line and a name for each of `kinds`, one below the other from `at` down; `size` is that of the type.
pub(crate) fn key(kinds: &[Annotation], style: &Style, at: Vec2, size: f32, typeface: &Type) -> Vec<Mark> {
    if kinds.is_empty() {
        return Vec::new();
    }
    let (length, gap, step) = (1.6 * size, 0.6 * size, 1.3 * size);
    let widest = kinds.iter().map(|kind| typeface.width(kind.says(), size)).fold(0.0, f32::max);
    let (low, high) = (at - size, at + Vec2::new(length + gap + widest + gap, (kinds.len() as f32 - 0.4) * step));
    let paper = vec![low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)];
    let paper = Mark::Area { rings: vec![paper], fill: style.theme.ground.alpha(PAPER) };
    let row = |(k, kind): (usize, &Annotation)| {
        let from = at + Vec2::new(0.0, k as f32 * step);
        let middle = from - Vec2::new(0.0, 0.32 * size);
        let (width, dash) = (0.11 * size * kind.width().max(1.0), kind.is_dashed().then_some(0.27 * size));
        let stroke = Stroke { width, color: kind.color(&style.theme), dash };
        let line = Mark::Line { points: vec![middle, middle + Vec2::new(length, 0.0)], closed: false, stroke };
        let at = from + Vec2::new(length + gap, 0.0);
        let color = style.theme.quiet;
        [line, Mark::Text { text: kind.says().into(), at, anchor: Anchor::Start, size, color }]
    };
    std::iter::once(paper).chain(kinds.iter().enumerate().flat_map(row)).collect()
}
