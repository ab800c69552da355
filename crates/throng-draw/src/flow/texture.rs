//! Line integral convolution: noise smeared along a field.

use super::{Lay, lot};
use crate::primitive::Primitive;
use crate::{Color, Image};
use glam::Vec2;
use std::f32::consts::PI;

/// The width of the grains of the noise, in units of the layout.
const GRAIN: f32 = 1.0;
/// The distance to which a grain is smeared on either side, in grains.
const REACH: usize = 16;
/// The greatest opacity of the texture, on light and on dark ground.
const DEPTH: [f32; 2] = [0.27, 0.2];

/// A grid of grains. Each has the direction of the field in its middle, scaled by the field's opacity; zero where the
/// field is not drawn, and in a border around the picture.
struct Grains {
    size: f32,
    columns: usize,
    rows: usize,
    ways: Vec<Vec2>,
}

/// The step from a grain along the field, and the noise of the grain.
#[derive(Clone, Copy)]
struct Stone {
    step: Vec2,
    noise: f32,
}

/// Returns the texture of all pixels.
pub(super) fn texture(lay: &Lay<'_>) -> Primitive {
    let grains = Grains::of(lay);
    let tones = grains.tones(lay.turn.0 as u32);
    let dark = lay.theme.is_dark();
    let ink = if dark { lay.ink.mix(Color::rgb(0xff_ffff), 0.5) } else { lay.ink.mix(lay.theme.text, 0.35) };
    let depth = 255.0 * (DEPTH[usize::from(dark)] * lay.style.strength()).min(1.0);
    let (width, height) = (lay.canvas.size.x as u32, lay.canvas.size.y as u32);
    let mut image = Image::new(width, height, ink.alpha(0.0));
    for (y, row) in image.data_mut().chunks_exact_mut(4 * width as usize).enumerate() {
        for (x, pixel) in row.chunks_exact_mut(4).enumerate() {
            let at = Vec2::new(x as f32, y as f32) + 0.5;
            if lay.canvas.free.fills(at) {
                pixel[3] = (depth * grains.between(&tones, at)) as u8;
            }
        }
    }
    Primitive::Pixels(image)
}

impl Grains {
    fn of(lay: &Lay<'_>) -> Self {
        let size = (GRAIN * lay.canvas.unit).max(1.0);
        let [columns, rows] = (lay.canvas.size / size).ceil().to_array().map(|count| count as usize + 2);
        let way = |index: usize| {
            let (column, row) = (index % columns, index / columns);
            if column == 0 || row == 0 || column + 1 == columns || row + 1 == rows {
                return Vec2::ZERO;
            }
            let middle = (Vec2::new(column as f32, row as f32) - 0.5) * size;
            // The mask is ignored: the texture continues below the rims of solids.
            let flow = lay.grid.at(middle.min(lay.canvas.size - 0.5));
            flow.normalize_or_zero() * lay.presence(flow)
        };
        Self { size, columns, rows, ways: (0..columns * rows).map(way).collect() }
    }

    /// Returns the grain at a position, given in grains, in the picture or its border.
    fn index(&self, at: Vec2) -> usize {
        at.y as i32 as usize * self.columns + at.x as i32 as usize
    }

    fn middle(&self, index: usize) -> Vec2 {
        Vec2::new((index % self.columns) as f32, (index / self.columns) as f32) + 0.5
    }

    /// Returns the step from each grain with the flow or against it, one grain long, by the midpoint rule.
    fn stones(&self, sense: f32, noise: &[f32]) -> Vec<Stone> {
        let step = |index: usize| {
            let Some(way) = self.ways[index].try_normalize() else { return Vec2::ZERO };
            // Slightly less than a grain, so that rounding does not lead beyond the border.
            self.ways[self.index(self.middle(index) + way * (0.5 * sense))].normalize_or_zero() * (0.999 * sense)
        };
        (0..self.ways.len()).map(|index| Stone { step: step(index), noise: noise[index] }).collect()
    }

    /// Returns the darkness of each grain, 0 to 1, fading with the field: the weighted mean of the noise along the line
    /// through its middle. The weights fall to zero at the ends of the line.
    fn tones(&self, lot_of: u32) -> Vec<f32> {
        let cell = |index: usize| lot((index % self.columns) as u32, (index / self.columns) as u32 ^ (lot_of << 20));
        let noise: Vec<f32> = (0..self.ways.len()).map(|index| cell(index) - 0.5).collect();
        let weights: [f32; REACH] =
            std::array::from_fn(|k| 0.5 + 0.5 * (PI * (k + 1) as f32 / (REACH + 1) as f32).cos());
        // The noise has a variance of 1/12.
        let (sum, squares) =
            weights.iter().fold((1.0, 1.0), |(sum, squares), w| (sum + 2.0 * w, squares + 2.0 * w * w));
        let deviation = (squares / 12.0_f32).sqrt() / sum;
        let ways = [1.0, -1.0].map(|sense| self.stones(sense, &noise));
        let tone = |index: usize| {
            let way = self.ways[index];
            if way == Vec2::ZERO {
                return 0.0;
            }
            let (mut mean, mut total) = (noise[index], 1.0);
            for stones in &ways {
                let (mut at, mut step) = (self.middle(index), stones[index].step);
                for weight in weights {
                    at += step;
                    let stone = stones[self.index(at)];
                    if stone.step == Vec2::ZERO {
                        break;
                    }
                    mean += weight * stone.noise;
                    total += weight;
                    step = stone.step;
                }
            }
            (0.5 + mean / (total * 4.0 * deviation)).clamp(0.0, 1.0) * way.length()
        };
        (0..self.ways.len()).map(tone).collect()
    }

    /// Interpolates values between the middles of grains.
    fn between(&self, values: &[f32], pixel: Vec2) -> f32 {
        // The first and the last grain belong to the border.
        let last = Vec2::new((self.columns - 2) as f32, (self.rows - 2) as f32);
        let at = (pixel / self.size + 0.5).clamp(Vec2::ONE, last - 0.001);
        let (part, first) = (at.fract(), self.index(at));
        let along = |first: usize| values[first] + (values[first + 1] - values[first]) * part.x;
        let (upper, lower) = (along(first), along(first + self.columns));
        upper + (lower - upper) * part.y
    }
}
