//! A field sampled at the pixels of a picture.

use super::{Canvas, Lay};
use glam::{DVec2, Vec2};
use throng::field::Field;
use throng_field::Sampled;

/// The width of the sampling cells, in units of the layout.
const CELL: f32 = 2.0;
/// The limit of speeds, m/s, which keeps their squares finite.
const FASTEST: f32 = 1e12;
/// The quantile of the speeds in the picture that counts as the fastest.
const MOST: f64 = 0.98;

/// A field at one moment, on a grid that covers the picture.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Grid {
    /// The samples; positions are relative to the world's origin.
    pub sampled: Sampled,
    /// The pixel of the first corner, and the width of cells, pixels.
    low: Vec2,
    cell: f32,
    columns: usize,
    rows: usize,
    /// The flow in m/s along the rows and down the columns of the picture, row by row from the top.
    flows: Vec<Vec2>,
}

impl Grid {
    /// Samples the field at a time; `None` if the picture does not show a part of the world.
    pub fn of(field: &dyn Field, canvas: &Canvas, time: f64) -> Option<Self> {
        let cell = (CELL * canvas.unit).max(1.0);
        let metres = f64::from(cell) / canvas.camera.scale;
        // The corners avoid round coordinates, where fields are more often exactly zero.
        let low = Vec2::splat(-0.637 * cell);
        let high = canvas.size + 0.363 * cell;
        let place = |pixel: Vec2| {
            let offset = (pixel - canvas.camera.anchor).as_dvec2() / canvas.camera.scale;
            canvas.camera.center + DVec2::new(offset.x, -offset.y) - canvas.origin
        };
        let [left, right] = [Vec2::new(low.x, high.y), Vec2::new(high.x, low.y)].map(place);
        let sampled = Sampled::of(field, left, right, metres, time).ok()?;
        let (columns, rows) = (sampled.columns(), sampled.rows());
        let flip = |v: &Vec2| Vec2::new(v.x, -v.y).clamp(Vec2::splat(-FASTEST), Vec2::splat(FASTEST));
        let flows = sampled.velocities().chunks_exact(columns).rev().flatten().map(flip).collect();
        let low = Vec2::new(low.x, high.y - (rows - 1) as f32 * cell);
        Some(Self { sampled, low, cell, columns, rows, flows })
    }

    /// Returns the flow at a pixel by bilinear interpolation; zero outside the grid.
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

    /// Returns the derivatives of the flow at a pixel by x and y, per pixel.
    pub fn slope(&self, pixel: Vec2) -> [Vec2; 2] {
        let step = 0.5 * self.cell;
        [Vec2::X, Vec2::Y].map(|axis| (self.at(pixel + axis * step) - self.at(pixel - axis * step)) / (2.0 * step))
    }

    /// Returns the corners: pixels and flows, row by row from the top.
    pub fn corners(&self) -> impl Iterator<Item = (Vec2, Vec2)> {
        let pixel = |index: usize| Vec2::new((index % self.columns) as f32, (index / self.columns) as f32);
        self.flows.iter().enumerate().map(move |(index, &flow)| (self.low + pixel(index) * self.cell, flow))
    }
}

/// Returns the speed that fields exceed in at most 2 % of the picture where they flow, m/s; `None` if they flow
/// nowhere.
pub(super) fn fastest<'a>(grids: impl Iterator<Item = &'a Grid>, canvas: &Canvas) -> Option<f32> {
    let free = |&(pixel, flow): &(Vec2, Vec2)| flow != Vec2::ZERO && canvas.free.at(pixel);
    let mut speeds: Vec<f32> = grids.flat_map(Grid::corners).filter(free).map(|(_, flow)| flow.length()).collect();
    speeds.sort_unstable_by(f32::total_cmp);
    let top = *speeds.last()?;
    // A nearly still part of the picture does not count.
    let moving = &speeds[speeds.partition_point(|&speed| speed < Lay::STILL * top)..];
    Some(moving[((moving.len() - 1) as f64 * MOST) as usize])
}
