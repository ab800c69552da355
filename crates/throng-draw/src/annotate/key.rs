//! What the lines beside agents are.

use super::Annotation;
use crate::Style;
use crate::mark::{Anchor, Mark, Stroke};
use glam::Vec2;

/// A line and a name for each of `kinds`, one below the other from `at` down; `size` is that of the type.
pub(crate) fn key(kinds: &[Annotation], style: &Style, at: Vec2, size: f32, unit: f32) -> Vec<Mark> {
    let (length, step) = (18.0 * unit, 1.3 * size);
    let row = |(k, kind): (usize, &Annotation)| {
        let from = at + Vec2::new(0.0, k as f32 * step);
        let stroke = Stroke {
            width: kind.width().max(1.0) * unit,
            color: kind.color(&style.theme),
            dash: kind.is_dashed().then_some(3.0 * unit),
        };
        let middle = from - Vec2::new(0.0, 0.32 * size);
        let line = Mark::Line { points: vec![middle, middle + Vec2::new(length, 0.0)], closed: false, stroke };
        let text = Mark::Text {
            text: kind.says().into(),
            at: from + Vec2::new(length + 0.6 * size, 0.0),
            anchor: Anchor::Start,
            size,
            color: style.theme.quiet,
        };
        [line, text]
    };
    kinds.iter().enumerate().flat_map(row).collect()
}
