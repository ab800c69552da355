//! A picture in memory.

use crate::Color;
use glam::Vec2;

/// A picture: rows from the top, each pixel four bytes (red, green, blue, alpha). Pictures of worlds are opaque.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Image {
    width: u32,
    height: u32,
    data: Vec<u8>,
}

impl Image {
    /// Creates a picture in one colour.
    pub fn new(width: u32, height: u32, color: Color) -> Self {
        let data = [color.r, color.g, color.b, color.a].repeat(width as usize * height as usize);
        Self { width, height, data }
    }

    /// Creates a picture of its bytes: `width * height * 4`.
    pub(crate) fn of(width: u32, height: u32, data: Vec<u8>) -> Self {
        debug_assert_eq!(data.len(), width as usize * height as usize * 4, "four bytes a pixel");
        Self { width, height, data }
    }

    /// Returns the width, pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Returns the height, pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Returns the bytes: `width * height * 4`.
    pub fn data(&self) -> &[u8] {
        &self.data
    }

    /// Returns the bytes for drawing.
    pub fn data_mut(&mut self) -> &mut [u8] {
        &mut self.data
    }

    /// Returns the colour at column `x`, row `y`.
    ///
    /// # Panics
    /// The pixel is outside the picture.
    pub fn pixel(&self, x: u32, y: u32) -> Color {
        assert!(x < self.width && y < self.height, "pixel ({x}, {y}) of {} by {}", self.width, self.height);
        let p = (y as usize * self.width as usize + x as usize) * 4;
        Color { r: self.data[p], g: self.data[p + 1], b: self.data[p + 2], a: self.data[p + 3] }
    }

    /// Fills the picture with one colour.
    pub(crate) fn clear(&mut self, color: Color) {
        self.data.chunks_exact_mut(4).for_each(|pixel| pixel.copy_from_slice(&[color.r, color.g, color.b, color.a]));
    }

    /// Makes this a copy of `other` and reuses the memory.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        (self.width, self.height) = (other.width, other.height);
        self.data.clone_from(&other.data);
    }

    /// Copies `other` into this picture, with its first pixel at `corner` (column, row). Cuts off what does not fit.
    pub(crate) fn lay(&mut self, other: &Self, corner: (u32, u32)) {
        let width = other.width.min(self.width.saturating_sub(corner.0)) as usize * 4;
        let rows = self.data.chunks_exact_mut(self.width as usize * 4).skip(corner.1 as usize);
        for (row, from) in rows.zip(other.data.chunks_exact(other.width as usize * 4)) {
            let left = corner.0 as usize * 4;
            row[left..left + width].copy_from_slice(&from[..width]);
        }
    }
}

impl Image {
    /// Copies the rectangle from `low` to `high`, pixels, from `other`, which has the same size.
    pub(crate) fn copy_within(&mut self, other: &Self, low: Vec2, high: Vec2) {
        // The cast maps negative numbers to 0.
        let (left, right) = (low.x.round() as usize, (high.x.round() as usize).min(self.width as usize));
        let (top, bottom) = (low.y.round() as usize, (high.y.round() as usize).min(self.height as usize));
        for y in top..bottom {
            let row = |x: usize| (y * self.width as usize + x) * 4;
            if left < right {
                self.data[row(left)..row(right)].copy_from_slice(&other.data[row(left)..row(right)]);
            }
        }
    }
}

impl Image {
    /// Blends another picture of the same size over this opaque one.
    pub(crate) fn lay_over(&mut self, other: &Self) {
        for (pixel, over) in self.data.chunks_exact_mut(4).zip(other.data.chunks_exact(4)) {
            if over[3] > 0 {
                blend(&mut pixel[..3], [over[0], over[1], over[2]], (u32::from(over[3]) * 256 + 127) / 255);
            }
        }
    }
}

/// Blends `color` over an opaque pixel; `cover` is 0 to 256.
pub(crate) fn blend(pixel: &mut [u8], color: [u8; 3], cover: u32) {
    for (p, c) in pixel.iter_mut().zip(color) {
        let (from, to) = (u32::from(*p), u32::from(c));
        *p = ((from * (256 - cover) + to * cover + 128) >> 8) as u8;
    }
}
