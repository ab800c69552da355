//! A field at the pixels of a picture.

use super::{Canvas, Lay};
use glam::{DVec2, Vec2};
use throng::field::Sampled;
use throng_record::Flow;

/// Width of the cells in which a field is sampled, in units of the layout.
const CELL: f32 = 2.0;
/// No speed is greater than this, m/s, that the squares of all are finite.
const FASTEST: f32 = 1e12;
/// Which speed counts as the fastest: what part of the picture's is slower.
const MOST: f64 = 0.98;

/// A field at one moment, on a grid that covers the picture.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Grid {
    /// Relative to the world's origin.
    pub sampled: Sampled,
    /// The pixel of the first corner, and the width of cells, pixels.
    low: Vec2,
    cell: f32,
    columns: usize,
    rows: usize,
    /// m/s along the rows and down the columns of the picture, row by row from the top.
    flows: Vec<Vec2>,
}

impl Grid {
    /// The field at a time; `None` if the picture does not show a part of the world.
    pub fn of(flow: &Flow, canvas: &Canvas, time: f64) -> Option<Self> {
        let cell = (CELL * canvas.unit).max(1.0);
        let metres = f64::from(cell) / canvas.camera.scale;
        // its corners are no round numbers, where fields are zero more often than elsewhere
        let low = Vec2::splat(-0.637 * cell);
        let high = canvas.size + 0.363 * cell;
        let place = |pixel: Vec2| {
            let offset = (pixel - canvas.camera.anchor).as_dvec2() / canvas.camera.scale;
            canvas.camera.center + DVec2::new(offset.x, -offset.y) - canvas.origin
        };
        let [left, right] = [Vec2::new(low.x, high.y), Vec2::new(high.x, low.y)].map(place);
        let sampled = Sampled::of(&*flow.field, left, right, metres, time).ok()?;
        let (columns, rows) = (sampled.columns(), sampled.rows());
        let flip = |v: &Vec2| Vec2::new(v.x, -v.y).clamp(Vec2::splat(-FASTEST), Vec2::splat(FASTEST));
        let flows = sampled.velocities().chunks_exact(columns).rev().flatten().map(flip).collect();
        let low = Vec2::new(low.x, high.y - (rows - 1) as f32 * cell);
        Some(Self { sampled, low, cell, columns, rows, flows })
    }

    /// The flow at a pixel, between the corners by bilinear interpolation; zero beyond the rim.
    pub fn at(&self, pixel: Vec2) -> Vec2 {
        let at = (pixel - self.low) / self.cell;
        let (column, row) = (at.x as usize, at.y as usize);
        if !(at.x >= 0.0 && at.y >= 0.0 && column + 1 < self.columns && row + 1 < self.rows) {
            return Vec2::ZERO;
        }
        let (part, first) = (at.fract(), row * self.columns + column);
        let along = |first: usize| self.flows[first].lerp(self.flows[first + 1], part.x);
        along(first).lerp(along(first + self.columns), part.y)
    }

    /// How the flow changes at a pixel with x and with y, per pixel.
    pub fn slope(&self, pixel: Vec2) -> [Vec2; 2] {
        let step = 0.5 * self.cell;
        [Vec2::X, Vec2::Y].map(|axis| (self.at(pixel + axis * step) - self.at(pixel - axis * step)) / (2.0 * step))
    }

    /// The corners: pixels and flows, row by row from the top.
    pub fn corners(&self) -> impl Iterator<Item = (Vec2, Vec2)> {
        let pixel = |index: usize| Vec2::new((index % self.columns) as f32, (index / self.columns) as f32);
        self.flows.iter().enumerate().map(move |(index, &flow)| (self.low + pixel(index) * self.cell, flow))
    }
}

/// The speed that some fields exceed where they flow in a fiftieth of the picture at most, m/s; `None` if they flow nowhere.
pub(super) fn fastest<'a>(grids: impl Iterator<Item = &'a Grid>, canvas: &Canvas) -> Option<f32> {
    let free = |&(pixel, flow): &(Vec2, Vec2)| flow != Vec2::ZERO && canvas.free.at(pixel);
    let mut speeds: Vec<f32> = grids.flat_map(Grid::corners).filter(free).map(|(_, flow)| flow.length()).collect();
    speeds.sort_unstable_by(f32::total_cmp);
    let top = *speeds.last()?;
    // most of the picture may be all but still: it does not count
    let moving = &speeds[speeds.partition_point(|&speed| speed < Lay::STILL * top)..];
    Some(moving[((moving.len() - 1) as f64 * MOST) as usize])
}
