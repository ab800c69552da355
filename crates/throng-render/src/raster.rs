//! Covers cells of a grid of samples with triangles.

use crate::parallel;
use crate::view::SUB;
use glam::{IVec2, Vec2, Vec4};
use std::ops::{Add, Mul, Range};

/// The number of samples of a cell.
pub(crate) const SAMPLES: usize = 4;
/// The number of rows of cells that are covered as one piece of work.
pub(crate) const BAND: usize = 16;

/// A grid of cells with four samples each.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    /// The number of cells in a row, and the number of rows.
    pub size: [usize; 2],
    /// The size of a cell, in subdivisions.
    cell: [i32; 2],
    /// The places of the samples in a cell, in subdivisions.
    samples: [[i32; 2]; SAMPLES],
}

impl Grid {
    /// Returns the grid of a picture: a cell is a pixel, and no two samples share a row or a column.
    pub fn picture([width, height]: [u32; 2]) -> Self {
        let samples = [[6, 2], [14, 6], [2, 10], [10, 14]];
        Self { size: [width as usize, height as usize], cell: [SUB, SUB], samples }
    }

    /// Returns the grid of a square map with a sample in the middle of each of its `side * side` points; `side` is a
    /// multiple of 4.
    pub fn map(side: usize) -> Self {
        let samples = [0, 1, 2, 3].map(|k| [SUB / 2 + k * SUB, SUB / 2]);
        Self { size: [side / SAMPLES, side], cell: [SUB * SAMPLES as i32, SUB], samples }
    }

    /// Returns the number of cells.
    pub fn cells(&self) -> usize {
        self.size[0] * self.size[1]
    }

    /// Returns the values of a plane at all samples.
    pub fn lanes(&self, plane: Plane) -> Lanes {
        let first = self.samples.map(|[x, y]| plane.value(Vec2::new(x as f32, y as f32) / SUB as f32));
        let cell = Vec2::new(self.cell[0] as f32, self.cell[1] as f32) / SUB as f32;
        Lanes { first: Vec4::from_array(first), step: cell * plane.step }
    }
}

/// A function that is linear in the picture: its value at the upper left corner, and its change a pixel to the right and
/// down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plane {
    pub at: f32,
    pub step: Vec2,
}

impl Plane {
    pub fn value(&self, at: Vec2) -> f32 {
        self.at + self.step.dot(at)
    }
}

/// The values of a plane at the samples of the first cell, and their change from cell to cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes {
    first: Vec4,
    step: Vec2,
}

impl Lanes {
    /// Returns the values at the samples of a cell.
    pub fn at(&self, column: usize, row: usize) -> Vec4 {
        self.first + (column as f32 * self.step.x + row as f32 * self.step.y)
    }
}

/// A triangle in the picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cover {
    /// The corners in subdivisions, clockwise in the picture (its axis y is down).
    corners: [IVec2; 3],
    /// What samples keep the greatest of: the nearness.
    near: Plane,
    /// The limits of the nearness.
    limits: [f32; 2],
    /// What it is a part of.
    pub id: u32,
}

impl Cover {
    /// Creates a triangle of corners in either direction; `None` if it has no area.
    pub fn new(corners: [IVec2; 3], near: Plane, limits: [f32; 2], id: u32) -> Option<Self> {
        let area = area(corners);
        let [a, b, c] = corners;
        let corners = if area < 0 { [a, c, b] } else { corners };
        (area != 0).then_some(Self { corners, near, limits, id })
    }

    /// Whether it is between the rows, or between the columns, of samples in the middle of squares of `side`
    /// subdivisions: then it covers none.
    pub fn between(&self, side: i32) -> bool {
        let [a, b, c] = self.corners;
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let next = |from: i32| (from - side / 2).div_euclid(side);
        let beyond = |low: i32, high: i32| next(low - 1) == next(high);
        beyond(low.x, high.x) || beyond(low.y, high.y)
    }

    /// Returns the rows of cells that it may cover.
    fn rows(&self, grid: &Grid) -> Range<usize> {
        let [a, b, c] = self.corners.map(|corner| corner.y);
        let (low, high) = (a.min(b).min(c).div_euclid(grid.cell[1]), a.max(b).max(c).div_euclid(grid.cell[1]) + 1);
        let most = grid.size[1] as i32;
        low.clamp(0, most) as usize..high.clamp(0, most) as usize
    }

    /// Calls `each` for the cells that it covers in `rows`: with the row and the column, with the samples that it covers
    /// as bits, and with their nearness.
    pub fn scan(&self, grid: &Grid, rows: Range<usize>, each: impl FnMut(usize, usize, u32, Vec4)) {
        let [a, b, c] = self.corners;
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let own = self.rows(grid);
        let rows = own.start.max(rows.start)..own.end.min(rows.end);
        let columns = [low.x, high.x].map(|x| x.div_euclid(grid.cell[0]));
        let columns = columns[0].max(0)..(columns[1] + 1).min(grid.size[0] as i32);
        if columns.is_empty() {
            return;
        }
        // Both kinds of numbers are exact.
        if (high - low).max_element() < SMALL {
            self.cells::<i32>(grid, rows, columns, each);
        } else {
            self.cells::<f64>(grid, rows, columns, each);
        }
    }

    fn cells<T: Number>(
        &self,
        grid: &Grid,
        rows: Range<usize>,
        columns: Range<i32>,
        mut each: impl FnMut(usize, usize, u32, Vec4),
    ) {
        let [a, b, c] = self.corners;
        let edges = [(a, b), (b, c), (c, a)].map(|(from, to)| Edge::new(from, to, grid));
        let steps = edges.map(|edge| T::of(edge.slope.x) * T::of(grid.cell[0]));
        let lanes = grid.lanes(self.near);
        let [low, high] = self.limits.map(Vec4::splat);
        for row in rows {
            let top = row as i32 * grid.cell[1];
            let mut span = columns.clone();
            if span.len() > WIDE {
                edges.iter().for_each(|edge| edge.narrow(&mut span, top, grid));
            }
            if span.is_empty() {
                continue;
            }
            let begin = span.start * grid.cell[0];
            let mut values = edges.map(|edge| grid.samples.map(|[x, y]| edge.value::<T>(begin + x, top + y)));
            for column in span {
                let mut bits = 0;
                let [first, second, third] = &values;
                for (sample, ((a, b), c)) in first.iter().zip(second).zip(third).enumerate() {
                    bits |= u32::from(T::none_negative([*a, *b, *c])) << sample;
                }
                if bits != 0 {
                    each(row, column as usize, bits, lanes.at(column as usize, row).max(low).min(high));
                }
                for (value, step) in values.iter_mut().zip(steps) {
                    value.iter_mut().for_each(|sample| *sample = *sample + step);
                }
            }
        }
    }
}

/// The largest triangle with products of lengths that fit 32 bits, with the cells about it: subdivisions.
const SMALL: i32 = 1 << 13;
/// The number of cells of a row from which those outside are skipped at once.
const WIDE: usize = 6;

/// Numbers in which edges are evaluated.
trait Number: Copy + Add<Output = Self> + Mul<Output = Self> {
    fn of(value: i32) -> Self;
    fn none_negative(values: [Self; 3]) -> bool;
}

impl Number for i32 {
    fn of(value: i32) -> Self {
        value
    }

    fn none_negative([a, b, c]: [Self; 3]) -> bool {
        (a | b | c) >= 0
    }
}

impl Number for f64 {
    fn of(value: i32) -> Self {
        value.into()
    }

    fn none_negative([a, b, c]: [Self; 3]) -> bool {
        a.min(b).min(c) >= 0.0
    }
}

/// An edge of a triangle. Its value is not negative at the samples that it does not exclude.
#[derive(Clone, Copy)]
struct Edge {
    from: IVec2,
    slope: IVec2,
    /// What is taken off: a sample on the line of two triangles belongs to the one below or to the right of it.
    less: i32,
    /// The sample of a cell with the greatest value.
    most: [i32; 2],
}

impl Edge {
    fn new(from: IVec2, to: IVec2, grid: &Grid) -> Self {
        let along = to - from;
        let own = along.y < 0 || (along.y == 0 && along.x > 0);
        let slope = IVec2::new(-along.y, along.x);
        let value = |[x, y]: &[i32; 2]| i64::from(slope.x) * i64::from(*x) + i64::from(slope.y) * i64::from(*y);
        let most = grid.samples.into_iter().max_by_key(value).unwrap_or_default();
        Self { from, slope, less: i32::from(!own), most }
    }

    fn value<T: Number>(&self, x: i32, y: i32) -> T {
        T::of(self.slope.x) * T::of(x - self.from.x) + T::of(self.slope.y) * T::of(y - self.from.y) + T::of(-self.less)
    }

    /// Leaves out the cells of a row with no sample at which it is not negative.
    fn narrow(&self, span: &mut Range<i32>, top: i32, grid: &Grid) {
        let most: f64 = self.value(self.most[0], top + self.most[1]);
        let step = f64::from(self.slope.x) * f64::from(grid.cell[0]);
        if step > 0.0 {
            span.start = span.start.max(limited((-most / step).floor()));
        } else if step < 0.0 {
            span.end = span.end.min(limited((most / -step).floor()).saturating_add(1));
        } else if most < 0.0 {
            span.end = span.start;
        }
    }
}

fn limited(value: f64) -> i32 {
    value.clamp(-1e9, 1e9) as i32
}

/// Returns twice the area of a triangle, positive if it is clockwise in a picture (its axis y is down).
pub(crate) fn area([a, b, c]: [IVec2; 3]) -> i64 {
    let (u, v) = ((b - a).as_i64vec2(), (c - a).as_i64vec2());
    u.x * v.y - u.y * v.x
}

/// The triangles of each band of a grid, in order.
pub(crate) struct Bands(Vec<Vec<Cover>>);

impl Bands {
    pub fn new<'a>(grid: &Grid, covers: impl IntoIterator<Item = &'a Cover>) -> Self {
        let mut bands: Vec<Vec<Cover>> = vec![Vec::new(); grid.size[1].div_ceil(BAND)];
        for cover in covers {
            let rows = cover.rows(grid);
            if !rows.is_empty() {
                bands[rows.start / BAND..=(rows.end - 1) / BAND].iter_mut().for_each(|band| band.push(*cover));
            }
        }
        Self(bands)
    }

    pub fn of(&self, band: usize) -> &[Cover] {
        &self.0[band]
    }
}

/// The rows of a band.
pub(crate) fn rows_of(band: usize) -> Range<usize> {
    band * BAND..(band + 1) * BAND
}

/// Keeps the nearest triangle of each sample. Of two that are equally near, the later one is kept.
pub(crate) fn cover(grid: &Grid, bands: &Bands, near: &mut [Vec4], ids: &mut [[u32; SAMPLES]]) {
    let width = grid.size[0];
    parallel::pairs(near, ids, width * BAND, |band, near, ids| {
        let first = band * BAND;
        for cover in bands.of(band) {
            cover.scan(grid, rows_of(band), |row, column, bits, found| {
                let cell = (row - first) * width + column;
                let kept = found.cmpge(near[cell]).bitmask() & bits;
                for sample in 0..SAMPLES {
                    if kept >> sample & 1 == 1 {
                        near[cell][sample] = found[sample];
                        ids[cell][sample] = cover.id;
                    }
                }
            });
        }
    });
}

/// Keeps the greatest nearness of each sample, in the order of [`place_in_bands`].
pub(crate) fn cover_depth(grid: &Grid, bands: &Bands, near: &mut [Vec4]) {
    let width = grid.size[0];
    parallel::chunks(near, width * BAND, |band, near| {
        let first = band * BAND;
        for cover in bands.of(band) {
            cover.scan(grid, rows_of(band), |row, column, bits, found| {
                let cell = &mut near[column * BAND + row - first];
                let most = cell.max(found);
                for sample in 0..SAMPLES {
                    if bits >> sample & 1 == 1 {
                        cell[sample] = most[sample];
                    }
                }
            });
        }
    });
}

/// Returns the place of a cell of a grid of `width` columns in an order in which cells above one another are side by side:
/// band by band, column by column. The number of rows is a multiple of [`BAND`].
pub(crate) fn place_in_bands(width: usize, [column, row]: [usize; 2]) -> usize {
    (row / BAND * width + column) * BAND + row % BAND
}
