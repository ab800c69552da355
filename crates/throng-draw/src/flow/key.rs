//! The key's entries for fields.

use super::blade::arrow;
use super::critical::{RADIUS, Symbol};
use super::{FlowLayer, FlowStyle, Vec2, anchors, speed};
use crate::annotate::Row;
use crate::primitive::Primitive;
use crate::{Color, Theme};

/// The number of steps of the ramp of speeds.
const STEPS: usize = 40;

/// The visible parts of fields, for the key.
#[derive(Clone, Debug)]
pub(super) struct Said<'a> {
    pub style: &'a FlowStyle,
    pub theme: &'a Theme,
    pub ink: Color,
    /// The speed drawn as the fastest, m/s.
    pub fastest: Option<f32>,
    pub has_anchors: bool,
    /// The number of fields.
    pub fields: usize,
    pub symbols: Vec<Symbol>,
}

impl<'a> Said<'a> {
    /// Returns a row for each visible part. `size` is the size of the type.
    pub fn rows(self, size: f32) -> Vec<Row<'a>> {
        let Self { style, theme, ink, .. } = self;
        let unit = size / 11.0;
        let mut rows = Vec::new();
        if let Some(fastest) = self.fastest {
            let most = format!("{} m/s", speed_label(fastest));
            if style.draws(FlowLayer::Speed) {
                let length = 6.0 * size;
                let draw = Box::new(move |at| ramp(at, length, 0.62 * size, theme));
                rows.push(Row { length, says: format!("0 to {most}"), draw });
            }
            if style.draws(FlowLayer::Arrows) {
                let length = 1.9 * size;
                let draw =
                    Box::new(move |at: Vec2| arrow(at, at + Vec2::X * length, 0.08 * size, ink).into_iter().collect());
                rows.push(Row { length, says: format!("field, {most}"), draw });
            }
        }
        if style.draws(FlowLayer::Anchors) && self.has_anchors {
            let color = anchors::color(ink, self.fields, theme);
            let dot =
                move |at: Vec2| anchors::dot(at + Vec2::X * 0.35 * size, Vec2::X * 1.4 * size, unit, (color, theme));
            let draw = Box::new(dot);
            rows.push(Row { length: 1.9 * size, says: "anchor and velocity".into(), draw });
        }
        for symbol in self.symbols {
            let radius = 0.85 * RADIUS * unit;
            let draw = Box::new(move |at: Vec2| symbol.marks(at + Vec2::X * radius, radius, theme));
            rows.push(Row { length: 1.9 * size, says: symbol.says().into(), draw });
        }
        rows
    }
}

/// Formats a speed with two significant digits.
fn speed_label(speed: f32) -> String {
    let ten = 10f32.powi(speed.log10().floor() as i32 - 1);
    if (0.1..1e5).contains(&speed) {
        format!("{}", (f64::from((speed / ten).round()) * f64::from(ten) * 1e3).round() / 1e3)
    } else {
        format!("{speed:.1e}")
    }
}

fn ramp(at: Vec2, length: f32, thickness: f32, theme: &Theme) -> Vec<Primitive> {
    let edge = |k: usize| (at.x + length * k as f32 / STEPS as f32).round();
    let (top, bottom) = (at.y - 0.5 * thickness, at.y + 0.5 * thickness);
    let step = |k: usize| {
        let (a, b) = (Vec2::new(edge(k), top), Vec2::new(edge(k + 1), bottom));
        let ring = vec![a, Vec2::new(b.x, a.y), b, Vec2::new(a.x, b.y)];
        Primitive::Area { rings: vec![ring], fill: speed::tone((k as f32 + 0.5) / STEPS as f32, theme) }
    };
    (0..STEPS).map(step).collect()
}
