//! Line integral convolution: noise smeared along a field.

use super::speed::is_dark;
use super::{Lay, lot};
use crate::mark::Mark;
use crate::{Color, Image};
use glam::Vec2;
use std::f32::consts::PI;

/// Width of the grains of the noise, in units of the layout.
const GRAIN: f32 = 1.0;
/// How far a grain is smeared to either side, in grains.
const REACH: usize = 13;
/// How dark the darkest is.
const DEPTH: f32 = 0.34;

/// A grid of grains, each one with the direction of the field in its middle; zero where it is not drawn.
struct Grains {
    size: f32,
    columns: usize,
    rows: usize,
    ways: Vec<Vec2>,
}

/// The texture of all pixels.
pub(super) fn texture(lay: &Lay<'_>) -> Mark {
    let grains = Grains::of(lay);
    let tones = grains.tones(lay.turn.0 as u32);
    let ink = if is_dark(lay.theme) { Color::rgb(0xff_ffff) } else { lay.ink.mix(lay.theme.text, 0.35) };
    let depth = 255.0 * (DEPTH * lay.style.strength()).min(1.0);
    let (width, height) = (lay.canvas.size.x as u32, lay.canvas.size.y as u32);
    let mut image = Image::new(width, height, ink.alpha(0.0));
    for (y, row) in image.data_mut().chunks_exact_mut(4 * width as usize).enumerate() {
        for (x, pixel) in row.chunks_exact_mut(4).enumerate() {
            let at = Vec2::new(x as f32, y as f32) + 0.5;
            if lay.canvas.free.at(at) {
                pixel[3] = (depth * grains.between(&tones, at)) as u8;
            }
        }
    }
    Mark::Pixels(image)
}

impl Grains {
    fn of(lay: &Lay<'_>) -> Self {
        let size = (GRAIN * lay.canvas.unit).max(1.0);
        let [columns, rows] = (lay.canvas.size / size).ceil().to_array().map(|count| count as usize);
        let way = |index: usize| {
            let middle = (Vec2::new((index % columns) as f32, (index / columns) as f32) + 0.5) * size;
            let flow = lay.grid.at(middle.min(lay.canvas.size - 0.5));
            // walls are of the mask, which is as fine as the picture: grains go on under their rims
            flow.normalize_or_zero() * lay.presence(flow)
        };
        Self { size, columns, rows, ways: (0..columns * rows).map(way).collect() }
    }

    fn index(&self, at: Vec2) -> Option<usize> {
        let (x, y) = (at.x as usize, at.y as usize);
        (at.x >= 0.0 && at.y >= 0.0 && x < self.columns && y < self.rows).then(|| y * self.columns + x)
    }

    /// How dark each grain is, 0 to 1, fading where the field does: a mean of the noise along the line through its middle, by
    /// weights that fall to zero at its ends.
    fn tones(&self, lot_of: u32) -> Vec<f32> {
        let noise: Vec<f32> = (0..self.ways.len())
            .map(|index| lot((index % self.columns) as u32, (index / self.columns) as u32 ^ (lot_of << 20)) - 0.5)
            .collect();
        let weights: Vec<f32> =
            (0..=REACH).map(|k| 0.5 + 0.5 * (PI * k as f32 / (REACH + 1) as f32).cos()).collect();
        // the noise has a variance of 1/12
        let (sum, squares) =
            weights[1..].iter().fold((1.0, 1.0), |(sum, squares), w| (sum + 2.0 * w, squares + 2.0 * w * w));
        let deviation = (squares / 12.0_f32).sqrt() / sum;
        let units: Vec<Vec2> = self.ways.iter().map(|way| way.normalize_or_zero()).collect();
        let tone = |index: usize| {
            let way = self.ways[index];
            if way == Vec2::ZERO {
                return 0.0;
            }
            let middle = Vec2::new((index % self.columns) as f32, (index / self.columns) as f32) + 0.5;
            let (mut mean, mut total) = (noise[index], 1.0);
            for sense in [1.0, -1.0] {
                let mut at = middle;
                for weight in &weights[1..] {
                    // the midpoint rule, a grain a step
                    let Some(first) = self.index(at) else { break };
                    let Some(half) = self.index(at + units[first] * (0.5 * sense)) else { break };
                    at += units[half] * sense;
                    let Some(here) = self.index(at).filter(|&here| units[here] != Vec2::ZERO) else { break };
                    mean += weight * noise[here];
                    total += weight;
                }
            }
            (0.5 + mean / (total * 4.0 * deviation)).clamp(0.0, 1.0) * way.length()
        };
        (0..self.ways.len()).map(tone).collect()
    }

    /// A value between the middles of grains.
    fn between(&self, values: &[f32], pixel: Vec2) -> f32 {
        let last = Vec2::new((self.columns - 1) as f32, (self.rows - 1) as f32);
        let at = (pixel / self.size - 0.5).clamp(Vec2::ZERO, last);
        let (column, row) = (at.x as usize, at.y as usize);
        let (right, below) = (usize::from(column + 1 < self.columns), usize::from(row + 1 < self.rows));
        let (part, first) = (at - Vec2::new(column as f32, row as f32), row * self.columns + column);
        let along = |first: usize| values[first] + (values[first + right] - values[first]) * part.x;
        let (upper, lower) = (along(first), along(first + below * self.columns));
        upper + (lower - upper) * part.y
    }
}
