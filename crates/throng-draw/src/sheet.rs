//! Several recordings side by side in one picture, on one clock. A single recording is a sheet of one panel.

use crate::primitive::{Anchor, Primitive};
use crate::text::Type;
use crate::{Color, Error, Image, Painter, Style, raster};
use glam::Vec2;
use throng_record::{Frame, Setting};

/// The contents of a sheet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheet {
    /// A title over all panels; empty for none.
    pub title: String,
    /// The place and the title of each panel, row by row.
    pub panels: Vec<Setting>,
    /// The number of panels side by side, at least 1; see [`columns`].
    pub columns: usize,
}

impl From<&Setting> for Sheet {
    /// Creates a sheet with one recording that fills the picture.
    fn from(setting: &Setting) -> Self {
        Self { title: String::new(), panels: vec![setting.clone()], columns: 1 }
    }
}

/// Returns the number of columns for `count` panels with the aspect ratio `panel` in a picture with the aspect ratio
/// `picture`, so that panels are as large as possible. Of arrangements with panels of the same size, the one with the
/// fewest empty places wins.
///
/// ```
/// let side_by_side: Vec<usize> = (1..=9).map(|count| throng_draw::columns(count, 4.0 / 3.0, 2.0)).collect();
/// assert_eq!(side_by_side, [1, 2, 3, 2, 3, 3, 4, 4, 3]);
/// assert_eq!(throng_draw::columns(3, 4.0, 2.0), 1);
/// ```
pub fn columns(count: usize, panel: f64, picture: f64) -> usize {
    let size = |columns: usize| {
        let rows = count.div_ceil(columns);
        ((picture / (columns as f64 * panel)).min(1.0 / rows as f64), rows * columns - count)
    };
    let better = |best: usize, next: usize| {
        let ((a, empty), (b, fewer)) = (size(best), size(next));
        let larger = b > a * (1.0 + 1e-6);
        if larger || (b >= a * (1.0 - 1e-6) && fewer < empty) { next } else { best }
    };
    (1..=count).reduce(better).unwrap_or(1)
}

/// Returns the height of the title for a sheet of this width, pixels.
pub fn title_height(width: u32) -> u32 {
    (34.0 * unit(width)) as u32 / 2 * 2
}

/// Returns the scale of the title.
fn unit(width: u32) -> f32 {
    (width as f32 / 1280.0).clamp(0.6, 4.0)
}

/// The gap between panels, pixels.
const GAP: u32 = 2;

/// Paints the moments of all panels of a sheet.
#[derive(Debug)]
pub(crate) struct SheetPainter {
    size: (u32, u32),
    panels: Vec<Panel>,
    paper: Color,
    title: Vec<Primitive>,
    /// Whether one panel fills the picture.
    whole: bool,
    /// All panels in place.
    image: Image,
}

#[derive(Debug)]
struct Panel {
    painter: Painter,
    /// The column and row of its first pixel.
    corner: (u32, u32),
}

impl SheetPainter {
    /// Creates a painter for recordings that begin with `firsts`. The style's width and height are the size of the
    /// sheet.
    pub(crate) fn new(sheet: &Sheet, style: &Style, firsts: &[&Frame]) -> Result<Self, Error> {
        let (width, height) = (style.width, style.height);
        let strip = if sheet.title.is_empty() { 0 } else { title_height(width) };
        let columns = sheet.columns.clamp(1, sheet.panels.len().max(1)) as u32;
        let rows = (sheet.panels.len() as u32).div_ceil(columns).max(1);
        let share = |all: u32, parts: u32| all.saturating_sub(GAP * (parts - 1)) / parts;
        let (w, h) = (share(width, columns), share(height.saturating_sub(strip), rows));
        let cell = Style { width: w, height: h, ..style.clone() };
        let mut panels = Vec::new();
        for (k, (setting, first)) in (0u32..).zip(sheet.panels.iter().zip(firsts)) {
            let corner = ((k % columns) * (w + GAP), strip + (k / columns) * (h + GAP));
            panels.push(Panel { painter: Painter::new(setting, &cell, first)?, corner });
        }
        let (paper, size) = (style.theme.outside, 17.0 * unit(width));
        let at = Vec2::new(14.0 * unit(width), strip as f32 * 0.5 + 0.36 * size);
        let text = |text: String| Primitive::Text { text, at, anchor: Anchor::Start, size, color: style.theme.text };
        let mut typeface = Type::of(&style.typeface);
        let room = width as f32 - 2.0 * at.x;
        let title: Vec<Primitive> =
            (strip > 0).then(|| text(typeface.clip(&sheet.title, size, room))).into_iter().collect();
        let whole = title.is_empty() && panels.len() == 1;
        let mut image = if whole { Image::new(0, 0, paper) } else { Image::new(width, height, paper) };
        raster::draw(&mut image, &mut typeface, &title);
        Ok(Self { size: (width, height), panels, paper, title, whole, image })
    }

    /// Adds the positions of a moment to the trails, without painting.
    pub(crate) fn follow(&mut self, frames: &[&Frame]) {
        self.panels.iter_mut().zip(frames).for_each(|(panel, frame)| panel.painter.follow(frame));
    }

    /// Paints a moment of each panel.
    pub(crate) fn paint(&mut self, frames: &[&Frame]) -> &Image {
        for (Panel { painter, corner }, frame) in self.panels.iter_mut().zip(frames) {
            let picture = painter.paint(frame);
            if !self.whole {
                self.image.lay(picture, *corner);
            }
        }
        self.painted()
    }

    /// Exposes the picture of each panel to a moment.
    pub(crate) fn expose(&mut self, frames: &[Frame]) {
        self.panels.iter_mut().zip(frames).for_each(|(panel, frame)| panel.painter.expose(frame));
    }

    /// Paints the mean of the moments to which the pictures of the panels have been exposed.
    pub(crate) fn develop(&mut self, frames: &[Frame]) -> &Image {
        for (Panel { painter, corner }, frame) in self.panels.iter_mut().zip(frames) {
            let picture = painter.develop(frame);
            if !self.whole {
                self.image.lay(picture, *corner);
            }
        }
        self.painted()
    }

    fn painted(&self) -> &Image {
        match self.panels.first() {
            Some(panel) if self.whole => panel.painter.image(),
            _ => &self.image,
        }
    }

    /// Returns a moment of each panel as an SVG document.
    pub(crate) fn svg(&mut self, frames: &[&Frame]) -> String {
        self.follow(frames);
        self.panels.iter_mut().zip(frames).for_each(|(panel, frame)| panel.painter.settle(frame));
        if let ([panel], [frame], true) = (&mut self.panels[..], frames, self.whole) {
            return panel.painter.svg(frame);
        }
        let panels = self.panels.iter().zip(frames).map(|(panel, frame)| (&panel.painter, *frame, panel.corner));
        crate::svg::sheet(self.size, self.paper, &self.title, panels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_lie_side_by_side_and_do_not_touch() {
        let panels: Vec<Setting> = (0..5).map(|k| Setting { title: format!("{k}"), ..Setting::default() }).collect();
        let sheet = Sheet { title: "All".into(), panels, columns: 3 };
        let style = Style { width: 400, height: 301, ..Style::default() };
        let empty = Frame::default();
        let painter = SheetPainter::new(&sheet, &style, &[&empty; 5]).unwrap();
        let (w, h) = ((400 - 4) / 3, (301 - title_height(400) - 2) / 2);
        let corners: Vec<_> = painter.panels.iter().map(|panel| panel.corner).collect();
        let top = title_height(400);
        let next = top + h + 2;
        assert_eq!(corners, [(0, top), (w + 2, top), (2 * w + 4, top), (0, next), (w + 2, next)]);
        assert_eq!((painter.image.width(), painter.image.height()), (400, 301));
    }
}
