//! What is seen in the middle of each pixel, and what neighbouring pixels have in common.

use crate::parallel;
use glam::{Vec2, Vec3};

/// The radius of the blur that evens out comparisons with few places, pixels.
const BLUR: usize = 2;

/// What is seen in the middle of a pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Front {
    /// The nearness, 1/m; 0 for the sky.
    pub near: f32,
    /// The normal of the surface.
    pub normal: Vec3,
}

/// What is seen in the middle of all pixels, in rows.
pub(crate) struct Fronts {
    pub all: Vec<Front>,
    /// The number of pixels in a row.
    pub width: usize,
}

impl Fronts {
    /// Returns the mean of the values of the `cells` that see the same surface as `front`; `None` if none does.
    pub fn mean(&self, values: &[f32], cells: impl IntoIterator<Item = usize>, front: &Front) -> Option<f32> {
        let like = Like::new(front);
        let (mut sum, mut weights) = (0.0, 0.0);
        for cell in cells {
            let weight = like.share(&self.all[cell]);
            sum += weight * values[cell];
            weights += weight;
        }
        (weights > 0.0).then(|| sum / weights)
    }
}

impl Front {
    /// The sky.
    pub const SKY: Self = Self { near: 0.0, normal: Vec3::ZERO };
}

/// How certainly other pixels see the same surface as a pixel: it has about the same depth and direction.
pub(crate) struct Like {
    near: f32,
    normal: Vec3,
    /// How fast the share falls with the difference of nearness.
    fall: f32,
}

impl Like {
    pub fn new(front: &Front) -> Self {
        Self { near: front.near, normal: front.normal, fall: 25.0 / front.near }
    }

    /// Returns how certainly a pixel sees the same surface, 0 to 1.
    pub fn share(&self, other: &Front) -> f32 {
        let apart = (other.near - self.near).abs() * self.fall;
        (1.0 - apart).max(0.0) * (other.normal.dot(self.normal) * 4.0 - 3.0).max(0.0)
    }
}

/// A turn that differs between the pixels of a small square.
#[derive(Clone, Copy)]
pub(crate) struct Turn {
    /// The share of a full turn, 0 to 1.
    pub share: f32,
    /// The direction after the turn.
    pub direction: Vec2,
}

/// Returns the turn of a pixel (interleaved gradient noise: Jimenez, 2014).
pub(crate) fn turn(column: usize, row: usize) -> Turn {
    let value = 52.982_918 * (0.067_110_56 * column as f32 + 0.005_837_15 * row as f32).fract();
    let share = value.fract();
    // A square of side 1 about the middle is turned instead of a circle: the direction needs no sine.
    let quarter = share * 4.0;
    let part = quarter.fract() - 0.5;
    let side = Vec2::new(1.0, 2.0 * part).normalize();
    let direction = match quarter as u32 {
        0 => side,
        1 => side.perp(),
        2 => -side,
        _ => -side.perp(),
    };
    Turn { share, direction }
}

/// Returns the mean of the values of neighbours that belong to the same surface, along rows and then along columns.
pub(crate) fn blurred(values: &[f32], fronts: &Fronts) -> Vec<f32> {
    blurred_along(&blurred_along(values, fronts, false), fronts, true)
}

/// The number of pixels of a row that are left as they are at once where nothing differs.
const BLOCK: usize = 8;

fn blurred_along(values: &[f32], fronts: &Fronts, vertical: bool) -> Vec<f32> {
    let width = fronts.width;
    let height = values.len() / width;
    let around = |at: usize, count: usize, most: usize| at.saturating_sub(BLUR)..(at + count + BLUR).min(most);
    let mut out = vec![1.0; values.len()];
    parallel::chunks(&mut out, width, |row, out| {
        for (block, out) in out.chunks_mut(BLOCK).enumerate() {
            let first = block * BLOCK;
            let (rows, columns) = match vertical {
                true => (around(row, 1, height), first..first + out.len()),
                false => (row..row + 1, around(first, out.len(), width)),
            };
            let own = values[row * width + first];
            let differs = rows.fold(0, |bits, row| {
                let values = values[row * width..][columns.clone()].iter();
                values.fold(bits, |bits, value| bits | (value.to_bits() ^ own.to_bits()))
            });
            if differs == 0 {
                out.fill(own);
                continue;
            }
            for (k, out) in out.iter_mut().enumerate() {
                let column = first + k;
                let here = row * width + column;
                let (span, stride) = match vertical {
                    true => (around(row, 1, height), width),
                    false => (around(column, 1, width), 1),
                };
                let low = if vertical { span.start * width + column } else { row * width + span.start };
                let cells = (0..span.len()).map(|k| low + k * stride);
                *out = values[here];
                if cells.clone().all(|cell| values[cell] == *out) {
                    continue;
                }
                *out = fronts.mean(values, cells, &fronts.all[here]).unwrap_or(*out);
            }
        }
    });
    out
}
