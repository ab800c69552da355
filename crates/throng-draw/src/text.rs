//! Type: a font, drawn from cached glyphs.

use crate::Color;
use crate::Error;
use crate::image::{Image, blend};
use ab_glyph::{Font, FontArc, GlyphId, ScaleFont, point};
use glam::Vec2;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

/// The number of horizontal glyph positions per pixel.
const STEPS: f32 = 4.0;

/// The key of a glyph: its id, size and fraction of a pixel.
type Key = (u16, u32, u8);

/// The typeface of pictures. Typefaces with the same name are equal. The default is Ubuntu Light, which the library
/// includes; without the feature `typeface`, there is no default and no lettering.
///
/// ```
/// use throng_draw::{Style, Typeface};
///
/// assert!(Typeface::new("mine", vec![1, 2, 3]).is_err());
/// assert_eq!(Style::default().typeface, Typeface::default());
/// ```
#[derive(Clone)]
pub struct Typeface {
    name: Arc<str>,
    font: Option<FontArc>,
}

impl Typeface {
    /// Creates a typeface from a TrueType or OpenType font.
    ///
    /// # Errors
    /// [`Error::Typeface`] if the bytes are not a font.
    pub fn new(name: &str, bytes: Vec<u8>) -> Result<Self, Error> {
        let font = FontArc::try_from_vec(bytes).map_err(|_| Error::Typeface { name: name.into() })?;
        Ok(Self { name: name.into(), font: Some(font) })
    }
}

impl Default for Typeface {
    fn default() -> Self {
        #[cfg(feature = "typeface")]
        let font = FontArc::try_from_slice(epaint_default_fonts::UBUNTU_LIGHT).ok();
        #[cfg(not(feature = "typeface"))]
        let font = None;
        Self { name: "".into(), font }
    }
}

impl PartialEq for Typeface {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl fmt::Debug for Typeface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Typeface").field(&self.name).finish()
    }
}

/// A typeface with its cached glyphs.
#[derive(Debug)]
pub(crate) struct Type {
    font: Option<FontArc>,
    glyphs: BTreeMap<Key, Bitmap>,
}

#[derive(Debug, Default)]
struct Bitmap {
    /// The offset of its upper left corner from the pen.
    left: i32,
    top: i32,
    width: usize,
    cover: Vec<u8>,
}

impl Type {
    pub(crate) fn of(typeface: &Typeface) -> Self {
        Self { font: typeface.font.clone(), glyphs: BTreeMap::new() }
    }

    /// Returns the width of a line of text, pixels; `size` is the size of an em.
    pub(crate) fn width(&self, text: &str, size: f32) -> f32 {
        self.pens(text, size).1
    }

    /// Returns `text`, shortened with an ellipsis if it is wider than `room`.
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

    /// Returns `text` in lines, broken at spaces: the first line is at most `rooms.0` wide, the other lines `rooms.1`. A
    /// word that is wider is shortened.
    pub(crate) fn wrap(&self, text: &str, size: f32, rooms: (f32, f32)) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        let mut room = rooms.0;
        for word in text.split_whitespace() {
            if let Some(last) = lines.last_mut() {
                let longer = format!("{last} {word}");
                if self.width(&longer, size) <= room {
                    *last = longer;
                    continue;
                }
                room = rooms.1;
            }
            lines.push(self.clip(word, size, room));
        }
        lines
    }

    /// Returns the font's own measure of size (from line to line) for an em size in pixels.
    fn scale(font: &FontArc, size: f32) -> f32 {
        size * font.height_unscaled() / font.units_per_em().unwrap_or(1000.0)
    }

    /// Returns the position of each glyph, and the width of the line.
    fn pens(&self, text: &str, size: f32) -> (Vec<(GlyphId, f32)>, f32) {
        let Some(font) = &self.font else { return (Vec::new(), 0.0) };
        let font = font.as_scaled(Self::scale(font, size));
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

    /// Draws a line of text. Its baseline begins at `at`.
    pub(crate) fn draw(&mut self, image: &mut Image, text: &str, at: Vec2, size: f32, color: Color) {
        let (width, height) = (image.width() as i32, image.height() as i32);
        let y = at.y.round() as i32;
        let Some(font) = self.font.clone() else { return };
        let scale = Self::scale(&font, size);
        for (id, pen) in self.pens(text, size).0 {
            let x = ((at.x + pen) * STEPS).round() / STEPS;
            let step = ((x - x.floor()) * STEPS) as u8;
            let bitmap = self
                .glyphs
                .entry((id.0, size.to_bits(), step))
                .or_insert_with(|| Bitmap::new(&font, id, scale, f32::from(step) / STEPS));
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
    fn new(font: &FontArc, id: GlyphId, size: f32, shift: f32) -> Self {
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
        let typeface = Type::of(&Typeface::default());
        let cut = typeface.clip(&"long ".repeat(50), 13.0, 200.0);
        assert!(cut.ends_with('…') && typeface.width(&cut, 13.0) <= 200.0, "{cut}");
        assert_eq!(typeface.clip("short", 13.0, 200.0), "short");
    }

    #[test]
    fn a_long_name_goes_on_in_the_next_lines() {
        let typeface = Type::of(&Typeface::default());
        let name = "a name of many words that goes on in the next lines";
        let lines = typeface.wrap(name, 13.0, (90.0, 130.0));
        assert!(lines.len() > 2 && lines.join(" ") == name, "{lines:?}");
        let rooms = [90.0, 130.0, 130.0, 130.0, 130.0, 130.0];
        assert!(lines.iter().zip(rooms).all(|(line, room)| typeface.width(line, 13.0) <= room), "{lines:?}");
        let next = format!("{} {}", lines[1], lines[2].split(' ').next().unwrap());
        assert!(typeface.width(&next, 13.0) > 130.0, "no line ends early: {lines:?}");
        assert!(typeface.wrap("", 13.0, (90.0, 130.0)).is_empty());
        assert!(typeface.wrap(&"w".repeat(99), 13.0, (90.0, 130.0))[0].ends_with('…'));
    }
}
