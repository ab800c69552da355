//! The legend of a picture: title, time, counts, the key of colours, a scale bar.

use crate::annotate::{self, Row};
use crate::color::ramp;
use crate::look::Look;
use crate::primitive::{Anchor, Primitive, Stroke};
use crate::text::Type;
use crate::{ColorBy, Style};
use glam::Vec2;
use throng_record::{Frame, Setting};

/// The sizes of the legend, pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layout {
    width: f32,
    height: f32,
    /// The scale of everything: 1 for a picture 640 pixels wide, smaller for very low pictures.
    pub unit: f32,
    /// The size of the type.
    size: f32,
    margin: f32,
}

/// The scale that the legend shows.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Scale {
    /// A bar, for this number of pixels per metre.
    Bar(f64),
    /// A grid of cells of this width, metres.
    Grid(f64),
    /// None.
    None,
}

impl Layout {
    pub(crate) fn new(style: &Style) -> Self {
        let (width, height) = (style.width as f32, style.height as f32);
        let unit = (width / 640.0).min(height / 300.0).clamp(0.75, 4.0);
        Self { width, height, unit, size: 13.0 * unit, margin: 14.0 * unit }
    }

    /// Returns the part of the picture left for the world: its least and greatest corner.
    pub(crate) fn room(&self, legend: bool) -> (Vec2, Vec2) {
        let strip = if legend { self.margin + 1.7 * self.size } else { self.margin };
        let low = Vec2::new(self.margin, strip);
        (low, Vec2::new(self.width, self.height) - low)
    }

    fn top(&self) -> f32 {
        self.margin + 0.75 * self.size
    }

    fn bottom(&self) -> f32 {
        self.height - self.margin
    }

    /// Returns the constant part of the legend.
    pub(crate) fn fixed(
        &self,
        setting: &Setting,
        style: &Style,
        look: &Look,
        scale: Scale,
        typeface: &Type,
    ) -> Vec<Primitive> {
        let mut marks = Vec::new();
        let bar = match scale {
            Scale::Bar(scale) => self.scale_bar(style, scale, &mut marks),
            Scale::Grid(metres) => self.grid_key(style, metres, typeface, &mut marks),
            Scale::None => 0.0,
        };
        let room = self.width - 2.0 * self.margin - bar - 2.0 * self.size;
        match (look.most(), style.color_by) {
            (Some(most), _) => self.ramp_key(style, most, &mut marks),
            (None, ColorBy::Group) if setting.groups.len() > 1 => {
                self.group_key(setting, style, look, typeface, room, &mut marks);
            }
            _ => {}
        }
        let title = typeface.clip(&setting.title, 1.15 * self.size, 0.6 * self.width);
        let at = Vec2::new(self.margin, self.top());
        marks.push(self.text(title, at, Anchor::Start, 1.15 * self.size, style.theme.text));
        marks.retain(|mark| !matches!(mark, Primitive::Text { text, .. } if text.is_empty()));
        marks
    }

    /// Returns the part of the legend that changes with each moment.
    pub(crate) fn moment(&self, frame: &Frame, style: &Style, typeface: &Type) -> Vec<Primitive> {
        let at = Vec2::new(self.width - self.margin, self.top());
        let time = format!("{:.1} s", frame.time);
        // The counts keep their position for any width of the time.
        let column = typeface.width("0000.0 s", self.size).max(typeface.width(&time, self.size) + self.size);
        let mut marks = vec![self.text(time, at, Anchor::End, self.size, style.theme.text)];
        // In a game, the score replaces the counts.
        let counts = match (frame.standing.is_empty(), frame.total) {
            (false, _) => frame.standing.clone(),
            // Agents without goals do not arrive.
            (true, _) if frame.arrived == 0 && frame.bodies.iter().all(|body| body.goal.is_none()) => String::new(),
            (true, total) => format!("{} of {total} arrived", frame.arrived),
        };
        if !counts.is_empty() {
            let at = at - Vec2::new(column, 0.0);
            marks.push(self.text(counts, at, Anchor::End, self.size, style.theme.quiet));
        }
        marks
    }

    /// Returns the size of the type of the key.
    pub(crate) fn key_size(&self) -> f32 {
        0.85 * self.size
    }

    /// Returns the key below the title.
    pub(crate) fn key(&self, rows: &[Row<'_>], style: &Style, typeface: &Type) -> Vec<Primitive> {
        let at = Vec2::new(self.margin, self.top() + 1.9 * self.size);
        annotate::key(rows, style, at, self.key_size(), typeface)
    }

    fn text(&self, text: String, at: Vec2, anchor: Anchor, size: f32, color: crate::Color) -> Primitive {
        Primitive::Text { text, at, anchor, size, color }
    }

    /// Draws a bar of a round number of metres, about a sixth of the picture. Returns its width.
    fn scale_bar(&self, style: &Style, scale: f64, marks: &mut Vec<Primitive>) -> f32 {
        let metres = round_length(f64::from(self.width) / 6.0 / scale);
        let length = (metres * scale) as f32;
        if !(length.is_finite() && length > 0.0) {
            return 0.0;
        }
        let label = length_label(metres);
        let right = Vec2::new(self.width - self.margin, self.bottom());
        let left = right - Vec2::new(length, 0.0);
        let tick = Vec2::new(0.0, 4.0 * self.unit);
        let stroke = Stroke::plain(1.2 * self.unit, style.theme.quiet);
        marks.push(Primitive::Line { points: vec![left - tick, left, right, right - tick], closed: false, stroke });
        let at = (left + right) * 0.5 - Vec2::new(0.0, 5.0 * self.unit);
        marks.push(self.text(label, at, Anchor::Middle, 0.92 * self.size, style.theme.quiet));
        length
    }

    /// Draws the label of the grid's cell width. Returns the width it occupies.
    fn grid_key(&self, style: &Style, metres: f64, typeface: &Type, marks: &mut Vec<Primitive>) -> f32 {
        let (label, size) = (format!("grid {}", length_label(metres)), 0.92 * self.size);
        let width = typeface.width(&label, size);
        let at = Vec2::new(self.width - self.margin, self.bottom());
        marks.push(self.text(label, at, Anchor::End, size, style.theme.quiet));
        // At least the usual width of a bar.
        width.max(self.width / 6.0)
    }

    fn group_key(
        &self,
        setting: &Setting,
        style: &Style,
        look: &Look,
        typeface: &Type,
        room: f32,
        marks: &mut Vec<Primitive>,
    ) {
        let radius = 0.34 * self.size;
        let mut at = Vec2::new(self.margin, self.bottom());
        for (k, name) in setting.groups.iter().enumerate() {
            let name = typeface.clip(name, self.size, 0.3 * self.width);
            let advance = 2.0 * radius + 0.5 * self.size + typeface.width(&name, self.size) + 1.3 * self.size;
            if at.x + advance - self.margin > room {
                let more = format!("+{} more", setting.groups.len() - k);
                marks.push(self.text(more, at, Anchor::Start, self.size, style.theme.quiet));
                return;
            }
            let center = at + Vec2::new(radius, -0.30 * self.size);
            marks.push(Primitive::Disc { center, radius, fill: look.group(k) });
            let from = at + Vec2::new(2.0 * radius + 0.5 * self.size, 0.0);
            marks.push(self.text(name, from, Anchor::Start, self.size, style.theme.quiet));
            at.x += advance;
        }
    }

    fn ramp_key(&self, style: &Style, (most, unit): (f32, &str), marks: &mut Vec<Primitive>) {
        const STEPS: usize = 48;
        let (length, thickness) = (110.0 * self.unit, 5.0 * self.unit);
        let corner = Vec2::new(self.margin, self.bottom() - thickness);
        for k in 0..STEPS {
            let edge = |k: usize| corner.x + (length * k as f32 / STEPS as f32).round();
            let (a, b) = (Vec2::new(edge(k), corner.y), Vec2::new(edge(k + 1), corner.y + thickness));
            let ring = vec![a, Vec2::new(b.x, a.y), b, Vec2::new(a.x, b.y)];
            marks.push(Primitive::Area { rings: vec![ring], fill: ramp((k as f32 + 0.5) / STEPS as f32) });
        }
        let (low, high) = (corner - Vec2::new(0.0, 4.0 * self.unit), corner.x + length);
        let size = 0.92 * self.size;
        marks.push(self.text("0".into(), low, Anchor::Start, size, style.theme.quiet));
        let most = format!("{} {unit}", (most * 100.0).round() / 100.0);
        marks.push(self.text(most, Vec2::new(high, low.y), Anchor::End, size, style.theme.quiet));
    }
}

/// Formats a length.
fn length_label(metres: f64) -> String {
    if metres >= 1000.0 { format!("{} km", metres / 1000.0) } else { format!("{metres} m") }
}

/// Returns the greatest of 1, 2 and 5 times a power of ten that is not above `most`.
pub(crate) fn round_length(most: f64) -> f64 {
    if !(most.is_finite() && most > 0.0) {
        return 1.0;
    }
    let power = most.log10().floor() as i32;
    // A quotient, because 1 / 10 is the nearest number to 0.1, while a power of 0.1 need not be.
    let ten = |p: i32| if p < 0 { 1.0 / 10f64.powi(-p) } else { 10f64.powi(p) };
    [5.0, 2.0, 1.0].map(|m| m * ten(power)).into_iter().find(|&m| m <= most).unwrap_or_else(|| ten(power))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scale_bars_have_round_lengths() {
        for (most, want) in [(7.3, 5.0), (19.9, 10.0), (20.0, 20.0), (0.35, 0.2), (0.12, 0.1), (1400.0, 1000.0)] {
            assert_eq!(round_length(most), want);
        }
        assert_eq!(round_length(f64::NAN), 1.0);
    }
}
