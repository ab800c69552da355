//! Type: the embedded font, drawn glyph by glyph from a cache.

use crate::Color;
use crate::image::{Image, blend};
use ab_glyph::{Font, FontRef, GlyphId, ScaleFont, point};
use glam::Vec2;
use std::collections::BTreeMap;

/// Glyphs are drawn at a quarter of a pixel.
const STEPS: f32 = 4.0;

/// A glyph, size and quarter of a pixel.
type Key = (u16, u32, u8);

/// The typeface, and the glyphs it has been asked for.
#[derive(Debug)]
pub(crate) struct Type {
    font: FontRef<'static>,
    glyphs: BTreeMap<Key, Bitmap>,
}

#[derive(Debug, Default)]
struct Bitmap {
    /// Of its top left corner from the pen.
    left: i32,
    top: i32,
    width: usize,
    cover: Vec<u8>,
}

impl Type {
    pub(crate) fn new() -> Self {
        let font = FontRef::try_from_slice(epaint_default_fonts::UBUNTU_LIGHT).expect("the embedded font is sound");
        Self { font, glyphs: BTreeMap::new() }
    }

    /// Width of a line of text, pixels; `size` is that of an em.
    pub(crate) fn width(&self, text: &str, size: f32) -> f32 {
        self.pens(text, size).1
    }

    /// `text`, cut off with an ellipsis where it is wider than `room`.
    pub(crate) fn clip(&self, text: &str, size: f32, room: f32) -> String {
        let line: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        if self.width(&line, size) <= room {
            return line;
        }
        let mut cut = line;
        while cut.pop().is_some() {
            let shorter = format!("{}…", cut.trim_end());
            if self.width(&shorter, size) <= room {
                return shorter;
            }
        }
        cut
    }

    /// The font's own measure of size, from line to line, for a size of an em in pixels.
    fn scale(&self, size: f32) -> f32 {
        size * self.font.height_unscaled() / self.font.units_per_em().unwrap_or(1000.0)
    }

    /// Where each glyph goes, and the width of the line.
    fn pens(&self, text: &str, size: f32) -> (Vec<(GlyphId, f32)>, f32) {
        let font = self.font.as_scaled(self.scale(size));
        let (mut x, mut last, mut pens) = (0.0, None, Vec::with_capacity(text.len()));
        for c in text.chars() {
            let id = font.glyph_id(c);
            if let Some(last) = last {
                x += font.kern(last, id);
            }
            pens.push((id, x));
            x += font.h_advance(id);
            last = Some(id);
        }
        (pens, x)
    }

    /// Draws a line of text whose baseline begins at `at`.
    pub(crate) fn draw(&mut self, image: &mut Image, text: &str, at: Vec2, size: f32, color: Color) {
        let (width, height) = (image.width() as i32, image.height() as i32);
        let y = at.y.round() as i32;
        let scale = self.scale(size);
        for (id, pen) in self.pens(text, size).0 {
            let x = ((at.x + pen) * STEPS).round() / STEPS;
            let step = ((x - x.floor()) * STEPS) as u8;
            let font = &self.font;
            let bitmap = self
                .glyphs
                .entry((id.0, size.to_bits(), step))
                .or_insert_with(|| Bitmap::new(font, id, scale, f32::from(step) / STEPS));
            let left = x.floor() as i32 + bitmap.left;
            for (row, cover) in bitmap.cover.chunks_exact(bitmap.width.max(1)).enumerate() {
                let py = y + bitmap.top + row as i32;
                if !(0..height).contains(&py) {
                    continue;
                }
                for (k, &cover) in cover.iter().enumerate().filter(|(_, cover)| **cover > 0) {
                    let px = left + k as i32;
                    if (0..width).contains(&px) {
                        let p = (py * width + px) as usize * 4;
                        let cover = u32::from(cover) * u32::from(color.a) * 256 / (255 * 255);
                        blend(&mut image.data_mut()[p..p + 4], [color.r, color.g, color.b], cover);
                    }
                }
            }
        }
    }
}

impl Bitmap {
    fn new(font: &FontRef<'static>, id: GlyphId, size: f32, shift: f32) -> Self {
        let glyph = id.with_scale_and_position(size, point(shift, 0.0));
        let Some(outline) = font.outline_glyph(glyph) else { return Self::default() };
        let bounds = outline.px_bounds();
        let (width, height) = (bounds.width().ceil() as usize, bounds.height().ceil() as usize);
        let mut cover = vec![0; width * height];
        outline.draw(|x, y, c| {
            if let Some(cell) = cover.get_mut(y as usize * width + x as usize) {
                *cell = (c.clamp(0.0, 1.0) * 255.0).round() as u8;
            }
        });
        Self { left: bounds.min.x as i32, top: bounds.min.y as i32, width, cover }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_title_is_cut_off() {
        let typeface = Type::new();
        let cut = typeface.clip(&"long ".repeat(50), 13.0, 200.0);
        assert!(cut.ends_with('…') && typeface.width(&cut, 13.0) <= 200.0, "{cut}");
        assert_eq!(typeface.clip("short", 13.0, 200.0), "short");
    }
}
