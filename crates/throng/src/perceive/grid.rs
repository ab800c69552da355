//! The neighbour grid: points sorted into cells.

use super::block::{LEAF, Point, PointBlock, Points, divide};
use super::cells::bounds;
use super::nearest::Near;
use crate::parallel;
use crate::simd::LANES;
use fearless_simd::Level;
use glam::Vec2;

/// Maximum height of cells, relative to the mean distance of points.
const HEIGHT: f32 = 3.0;
/// Width of cells, relative to their height.
const WIDTH: f32 = 0.25;

/// A part of the points of a row of cells: the range from the first place to the second, or the block of a crowded
/// cell.
#[derive(Clone, Copy, Debug)]
pub(super) enum Run {
    Points(u32, u32),
    Crowd(u32),
}

/// A uniform grid over points, rebuilt by counting sort, for exact neighbour queries.
///
/// Cells are narrow columns in low rows. Points lie in memory in the order of cells, row by row, so a query reads one
/// contiguous range per row. Cells with many points are divided at medians, so a query stays cheap even if all points
/// are in one place.
///
/// Cost: building is linear (n log n within crowded cells). A query depends only on the points near it.
///
/// ```
/// use throng::perceive::Grid;
/// use glam::Vec2;
///
/// let points = [Vec2::ZERO, Vec2::X, Vec2::Y * 3.0];
/// let mut grid = Grid::default();
/// grid.rebuild(&points, &[0, 1, 2], 1.0);
/// let mut found = Vec::new();
/// grid.nearest(Vec2::ZERO, 2, 10.0, |near| near.row != 0, &mut found);
/// assert_eq!(found.iter().map(|near| near.row).collect::<Vec<_>>(), [1, 2]);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Grid {
    pub(super) low: Vec2,
    /// Cells per metre, along and across rows.
    pub(super) inverse: Vec2,
    pub(super) columns: usize,
    rows: usize,
    /// Greatest absolute value of a coordinate. It bounds rounding errors.
    extent: f32,
    /// Start of each cell's points, and the end of the last cell's.
    starts: Vec<u32>,
    /// Crowded cells, ascending, with their blocks.
    crowded: Vec<(u32, u32)>,
    blocks: Vec<PointBlock>,
    /// Points, numbers and rows in the order of cells.
    pub(super) x: Vec<f32>,
    pub(super) y: Vec<f32>,
    /// Heights of the points, for the [SIMD search](super::tile) in space; empty for a search in the plane.
    pub(super) z: Vec<f32>,
    numbers: Vec<u32>,
    pub(super) order: Vec<u32>,
    /// The place of each row.
    places: Vec<u32>,
    cell_of: Vec<u32>,
    part: Vec<Point>,
}

impl Grid {
    /// Sorts the points into cells at most `cell` metres high, and not much higher than the mean distance of points.
    /// Cells are higher if there would otherwise be many more cells than points. `numbers` break ties and must all
    /// differ.
    ///
    /// # Panics
    /// If the slices differ in length. Points must be finite.
    pub fn rebuild(&mut self, points: &[Vec2], numbers: &[u32], cell: f32) {
        assert_eq!(points.len(), numbers.len(), "one number per point is required");
        self.crowded.clear();
        self.blocks.clear();
        if points.is_empty() {
            (self.columns, self.rows) = (0, 0);
            self.numbers.clear();
            self.places.clear();
            return;
        }
        let level = Level::new();
        let (low, high) = bounds(level, points);
        let size = high - low;
        self.extent = low.abs().max(high.abs()).max_element();
        let most = (points.len() * 2 + 64) as f32;
        let count = points.len() as f32;
        let spacing = (size.x * size.y / count).sqrt().max(size.max_element() / count);
        let mut height = cell.min(HEIGHT * spacing).max(1e-6).max(size.max_element() / 1e6);
        while (size.x / (WIDTH * height) + 1.0) * (size.y / height + 1.0) > most {
            height *= 1.25;
        }
        self.low = low;
        self.inverse = Vec2::new(1.0 / (WIDTH * height), 1.0 / height);
        self.columns = (size.x * self.inverse.x) as usize + 1;
        self.rows = (size.y * self.inverse.y) as usize + 1;
        self.sort(level, points, numbers);
        let Self { x, y, numbers, order: rows, places, part, starts, blocks, .. } = self;
        for (cell, block) in &mut self.crowded {
            *block = blocks.len() as u32;
            let (start, end) = (starts[*cell as usize], starts[*cell as usize + 1]);
            divide(blocks, start, end, &mut Points { x, y, numbers, rows }, part);
            let range = start as usize..end as usize;
            (start..).zip(&rows[range]).for_each(|(place, &row)| places[row as usize] = place);
        }
    }

    /// Sets the heights of the points, by row, for the SIMD search in space; `None` for a search in the plane.
    pub(crate) fn set_heights(&mut self, heights: Option<impl Fn(usize) -> f32>) {
        self.z.clear();
        if let Some(height) = heights {
            self.z.extend(self.order.iter().take(self.numbers.len()).map(|&row| height(row as usize)));
            self.z.resize(self.z.len() + LANES, 0.0);
        }
    }

    /// Returns the column of a coordinate, or the nearest column. The result is monotonic in the coordinate.
    pub(super) fn column(&self, x: f32) -> usize {
        // `as` saturates
        (((x - self.low.x) * self.inverse.x) as i32).clamp(0, self.columns as i32 - 1) as usize
    }

    /// Returns the row of cells of a coordinate, or the nearest row.
    pub(super) fn row(&self, y: f32) -> usize {
        (((y - self.low.y) * self.inverse.y) as i32).clamp(0, self.rows as i32 - 1) as usize
    }

    /// Returns slightly more than `range`: despite rounding, points within `range` of `from` have coordinates within
    /// this of those of `from`.
    pub(super) fn reach(&self, from: Vec2, range: f32) -> f32 {
        range * 1.0001 + self.extent.max(from.abs().max_element()) * 1e-6
    }

    /// Returns the place after the last point of the row of cells that holds the point at a place.
    pub(super) fn end_of_row(&self, place: usize) -> usize {
        self.starts[(self.row(self.y[place]) + 1) * self.columns] as usize
    }

    /// Returns the number of rows of cells.
    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    pub(super) fn blocks(&self) -> &[PointBlock] {
        &self.blocks
    }

    /// Returns the greatest coordinate of a point.
    pub(crate) fn extent(&self) -> f32 {
        self.extent
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.numbers.is_empty()
    }

    fn sort(&mut self, level: Level, points: &[Vec2], numbers: &[u32]) {
        let count = points.len();
        let mut cell_of = std::mem::take(&mut self.cell_of);
        cell_of.resize(count, 0);
        let grid = &*self;
        parallel::ranges(&mut cell_of[..], |rows, cells| grid.find_cells(level, &points[rows], cells));
        self.starts.clear();
        self.starts.resize(self.columns * self.rows + 1, 0);
        let mut most = 0;
        for &c in &cell_of {
            let held = &mut self.starts[c as usize];
            *held += 1;
            most = most.max(*held);
        }
        if most as usize > LEAF {
            let crowded = (0..).zip(&self.starts).filter(|&(_, &held)| held as usize > LEAF);
            self.crowded.extend(crowded.map(|(cell, _)| (cell, 0)));
        }
        // the end of each cell
        let mut sum = 0;
        for start in &mut self.starts {
            sum += *start;
            *start = sum;
        }
        // tiles read whole SIMD vectors
        self.order.resize(count + LANES, 0);
        self.places.resize(count, 0);
        // in descending order, so that the ends become starts
        for ((row, &c), place) in cell_of.iter().enumerate().zip(&mut self.places).rev() {
            let at = &mut self.starts[c as usize];
            *at -= 1;
            *place = *at;
            self.order[*at as usize] = row as u32;
        }
        self.cell_of = cell_of;
        let Self { x, y, numbers: sorted, order, .. } = self;
        x.resize(count + LANES, 0.0);
        y.resize(count + LANES, 0.0);
        sorted.resize(count, 0);
        parallel::ranges((&mut x[..count], &mut y[..count], &mut sorted[..]), |places, (x, y, sorted)| {
            for (((&row, x), y), number) in order[places].iter().zip(x).zip(y).zip(sorted) {
                (*x, *y, *number) = (points[row as usize].x, points[row as usize].y, numbers[row as usize]);
            }
        });
    }

    /// Returns the rows of the slice that the grid was built from, in the order of cells.
    pub fn order(&self) -> &[u32] {
        &self.order[..self.numbers.len()]
    }

    /// Records that the rows of the slice have been sorted into the order of cells.
    pub(crate) fn rows_are_in_order(&mut self) {
        for column in [&mut self.order[..self.numbers.len()], &mut self.places[..]] {
            column.iter_mut().zip(0..).for_each(|(entry, index)| *entry = index);
        }
    }

    /// Returns the place of each row in the order of cells.
    pub(super) fn places(&self) -> &[u32] {
        &self.places
    }

    /// Calls `visit` for every point within `range` of `from` (inclusive), in no particular order.
    pub fn within(&self, from: Vec2, range: f32, mut visit: impl FnMut(Near)) {
        if self.is_empty() {
            return;
        }
        let reach = self.reach(from, range);
        let enters = |block: &PointBlock| block.distance_squared(from) <= range * range;
        for row in self.row(from.y - reach)..=self.row(from.y + reach) {
            self.runs(row, from.x - reach, from.x + reach, |run| {
                self.leaves(run, &enters, &mut |start, end| {
                    for at in start as usize..end as usize {
                        let near = self.near(from, at);
                        if near.distance_squared <= range * range {
                            visit(near);
                        }
                    }
                });
            });
        }
    }

    pub(super) fn near(&self, from: Vec2, at: usize) -> Near {
        let d = Vec2::new(self.x[at], self.y[at]) - from;
        Near { row: self.order[at], number: self.numbers[at], distance_squared: d.x * d.x + d.y * d.y }
    }

    /// Calls `visit` for the points of a row of cells between two coordinates, and some slightly beyond.
    pub(super) fn runs(&self, row: usize, left: f32, right: f32, mut visit: impl FnMut(Run)) {
        let (first, last) = (row * self.columns + self.column(left), row * self.columns + self.column(right));
        let (mut start, end) = (self.starts[first], self.starts[last + 1]);
        if !self.crowded.is_empty() {
            let crowded = self.crowded.partition_point(|&(cell, _)| (cell as usize) < first);
            for &(cell, block) in self.crowded[crowded..].iter().take_while(|&&(cell, _)| cell as usize <= last) {
                visit(Run::Points(start, self.starts[cell as usize]));
                visit(Run::Crowd(block));
                start = self.starts[cell as usize + 1];
            }
        }
        visit(Run::Points(start, end));
    }

    /// Adds to `found` the runs of points that may be within a radius of a box.
    pub(super) fn runs_near(&self, low: Vec2, high: Vec2, radius_squared: f32, found: &mut Vec<(u32, u32)>) {
        let reach = self.reach(low.abs().max(high.abs()), radius_squared.sqrt());
        let enters = |block: &PointBlock| {
            let d = (block.low - high).max(low - block.high).max(Vec2::ZERO);
            d.x * d.x + d.y * d.y <= radius_squared
        };
        for row in self.row(low.y - reach)..=self.row(high.y + reach) {
            self.runs(row, low.x - reach, high.x + reach, |run| {
                self.leaves(run, &enters, &mut |start, end| found.push((start, end)));
            });
        }
    }

    /// Calls `visit` for the points of a run, without the blocks that `enters` refuses.
    pub(super) fn leaves(&self, run: Run, enters: &impl Fn(&PointBlock) -> bool, visit: &mut impl FnMut(u32, u32)) {
        let block = match run {
            Run::Points(start, end) => return visit(start, end),
            Run::Crowd(block) => &self.blocks[block as usize],
        };
        if !enters(block) {
        } else if block.halves == 0 {
            visit(block.start, block.end);
        } else {
            self.leaves(Run::Crowd(block.halves), enters, visit);
            self.leaves(Run::Crowd(block.halves + 1), enters, visit);
        }
    }
}
