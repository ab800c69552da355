//! A neighbour grid in space: points sorted into cells.

use crate::parallel;
use crate::simd::LANES;
use glam::{UVec3, Vec3};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Maximum height of cells and of layers, relative to the mean distance of points. With this value the points of one
/// SIMD vector occupy a region about as high as it is long.
const HEIGHT: f32 = 2.5;
/// Width of cells, relative to their height.
const WIDTH: f32 = 0.25;
/// Maximum number of cells per point.
const CELLS: f32 = 4.0;

/// A uniform grid over points in space, rebuilt by counting sort, for queries that visit all points within a range.
///
/// Reynolds, Interaction with groups of autonomous characters, GDC 2000, "bin lattice". Cells are rows of narrow
/// columns, one layer above the other. Points lie in memory in the order of cells, so a query reads one contiguous
/// range per row of cells. Within a cell points are sorted by coordinates, then by number. So the *place* of a point
/// does not depend on its row, and a traversal in ascending places has an order that depends on the positions only.
///
/// The cells follow from the extent of points: the box around them, and their number. It may be that of more points than
/// are sorted: then the cells are those of all points, and only the block of cells around the sorted points is stored.
#[derive(Clone, Debug, Default)]
pub struct CellLattice {
    low: Vec3,
    /// Cells per metre.
    inverse: Vec3,
    /// The first cell of the block, among all cells.
    first: Vec3,
    /// Numbers of columns, rows and layers of the block, and its last cell.
    cells: UVec3,
    last: UVec3,
    /// Greatest absolute value of a coordinate. It bounds rounding errors.
    extent: f32,
    /// Start of each cell's points, and the end of the last cell's.
    starts: Vec<u32>,
    /// Coordinates by place, padded with zeros for whole SIMD vectors.
    x: Vec<f32>,
    y: Vec<f32>,
    z: Vec<f32>,
    /// Row of each place.
    order: Vec<u32>,
    /// Place of each row.
    places: Vec<u32>,
    cell_of: Vec<u32>,
    /// Number of points.
    len: usize,
}

/// The box around points, and their number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Extent {
    low: Vec3,
    high: Vec3,
    count: u64,
}

impl Extent {
    /// Returns the extent of a number of points; `None` without points.
    pub fn of(count: usize, point: impl Fn(usize) -> Vec3) -> Option<Self> {
        let first = (count > 0).then(|| point(0))?;
        let (low, high) = (1..count).map(point).fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
        Some(Self { low, high, count: count as u64 })
    }

    /// Returns the extent of these points and others.
    pub fn merged(&self, other: &Self) -> Self {
        let Self { low, high, count } = *self;
        Self { low: low.min(other.low), high: high.max(other.high), count: count + other.count }
    }
}

impl CellLattice {
    /// Sorts points into cells at most twice `reach` (metres) high. Cells are higher if there would otherwise be many
    /// more cells than points. `numbers` break ties and must all differ.
    pub fn rebuild(&mut self, point: impl Fn(usize) -> Vec3 + Sync, numbers: &[u32], reach: f32) {
        self.rebuild_within(None, point, numbers, reach);
    }

    /// As [`rebuild`](Self::rebuild), with the cells of points with another extent, among which these points are.
    pub(crate) fn rebuild_within(
        &mut self,
        all: Option<Extent>,
        point: impl Fn(usize) -> Vec3 + Sync,
        numbers: &[u32],
        reach: f32,
    ) {
        self.len = numbers.len();
        let Some(own) = Extent::of(self.len, &point) else { return };
        let Extent { low, high, count } = all.unwrap_or(own);
        let size = high - low;
        self.extent = low.abs().max(high.abs()).max_element();
        let count = count as f32;
        let longest = size.max_element();
        let area = (size.x * size.y).max(size.y * size.z).max(size.z * size.x);
        let spacing = (size.element_product() / count).cbrt().max((area / count).sqrt()).max(longest / count);
        let mut height = (2.0 * reach).min(HEIGHT * spacing).max(1e-6).max(longest / 1e6);
        let across = |height: f32| Vec3::new(1.0 / (WIDTH * height), 1.0 / height, 1.0 / height);
        while (size * across(height) + 1.0).element_product() > CELLS * count + 64.0 {
            height *= 1.25;
        }
        (self.low, self.inverse) = (low, across(height));
        let cell = |point: Vec3| ((point - low) * self.inverse).as_uvec3();
        let first = cell(own.low);
        (self.first, self.last) = (first.as_vec3(), cell(own.high) - first);
        self.cells = self.last + 1;
        self.sort(&point, numbers);
    }

    fn sort(&mut self, point: &(impl Fn(usize) -> Vec3 + Sync), numbers: &[u32]) {
        let mut cell_of = std::mem::take(&mut self.cell_of);
        cell_of.resize(self.len, 0);
        let lattice = &*self;
        parallel::ranges(&mut cell_of[..], |rows, cells| {
            rows.zip(cells).for_each(|(row, cell)| *cell = lattice.start_of(lattice.cell(point(row))) as u32);
        });
        let cells = self.cells.element_product() as usize;
        self.starts.clear();
        self.starts.resize(cells + 1, 0);
        cell_of.iter().for_each(|&cell| self.starts[cell as usize + 1] += 1);
        let mut sum = 0;
        for start in &mut self.starts {
            sum += *start;
            *start = sum;
        }
        // readers load whole SIMD vectors
        self.order.resize(self.len + LANES, 0);
        for (row, &cell) in (0..).zip(&cell_of) {
            let at = &mut self.starts[cell as usize];
            self.order[*at as usize] = row;
            *at += 1;
        }
        // filling moved every start to the next cell's: shift back
        self.starts.copy_within(..cells, 1);
        self.starts[0] = 0;
        self.cell_of = cell_of;
        self.order_cells(point, numbers);
        let Self { x, y, z, order, places, len, .. } = self;
        for all in [&mut *x, &mut *y, &mut *z] {
            all.resize(*len + LANES, 0.0);
        }
        parallel::ranges((&mut x[..*len], &mut y[..*len], &mut z[..*len]), |range, (x, y, z)| {
            for (((&row, x), y), z) in order[range].iter().zip(x).zip(y).zip(z) {
                [*x, *y, *z] = point(row as usize).to_array();
            }
        });
        places.resize(*len, 0);
        order[..*len].iter().zip(0..).for_each(|(&row, place)| places[row as usize] = place);
    }

    /// Sorts the points of every cell by their coordinates, then by number.
    fn order_cells(&mut self, point: &impl Fn(usize) -> Vec3, numbers: &[u32]) {
        let key = |row: u32| (point(row as usize), numbers[row as usize]);
        let after = |a: (Vec3, u32), b: (Vec3, u32)| {
            let ((p, n), (q, m)) = (a, b);
            (p.x.total_cmp(&q.x)).then(p.y.total_cmp(&q.y)).then(p.z.total_cmp(&q.z)).then(n.cmp(&m)).is_gt()
        };
        let Self { starts, order, .. } = self;
        let mut start = 0;
        for &end in &starts[1..] {
            let cell = &mut order[start..end as usize];
            start = end as usize;
            if cell.len() > 32 {
                cell.sort_unstable_by(|&a, &b| {
                    if after(key(a), key(b)) { std::cmp::Ordering::Greater } else { std::cmp::Ordering::Less }
                });
                continue;
            }
            for at in 1..cell.len() {
                let (row, own) = (cell[at], key(cell[at]));
                let mut to = at;
                while to > 0 && after(key(cell[to - 1]), own) {
                    cell[to] = cell[to - 1];
                    to -= 1;
                }
                cell[to] = row;
            }
        }
    }

    /// Returns the cell of a point, or the nearest cell of the block. Each component is monotonic in the coordinate.
    #[inline]
    fn cell(&self, point: Vec3) -> UVec3 {
        // `as` saturates; the difference is exact, because there are fewer than 2^24 cells along each axis
        ((point - self.low) * self.inverse - self.first).as_uvec3().min(self.last)
    }

    #[inline]
    fn start_of(&self, cell: UVec3) -> usize {
        ((cell.z * self.cells.y + cell.y) * self.cells.x + cell.x) as usize
    }

    /// Returns the row of each place.
    #[inline]
    pub fn order(&self) -> &[u32] {
        &self.order[..self.len]
    }

    /// Returns the place of each row.
    #[inline]
    pub fn places(&self) -> &[u32] {
        &self.places[..self.len]
    }

    /// Records that the rows have been sorted into the order of places.
    pub(crate) fn rows_are_in_order(&mut self) {
        self.order[..self.len].iter_mut().zip(0..).for_each(|(row, place)| *row = place);
        self.places.iter_mut().zip(0..).for_each(|(place, row)| *place = row);
    }

    /// Returns the coordinates by place, padded by the length of a SIMD vector.
    #[inline]
    pub fn coordinates(&self) -> [&[f32]; 3] {
        [&self.x, &self.y, &self.z]
    }

    /// Returns the height of cells, metres.
    #[inline]
    pub fn height(&self) -> f32 {
        1.0 / self.inverse.y
    }

    /// Returns the place after the last point of the row of cells that holds the point at a place.
    #[inline]
    pub fn end_of_row(&self, place: usize) -> usize {
        let cell = self.cell(Vec3::new(self.x[place], self.y[place], self.z[place]));
        self.starts[self.start_of(cell.with_x(0)) + self.cells.x as usize] as usize
    }

    /// Calls `visit` for runs of places, ascending, that together hold all points within a distance of a box, and other
    /// points.
    #[inline(always)]
    pub fn runs_near(&self, low: Vec3, high: Vec3, distance: f32, mut visit: impl FnMut(Range<usize>)) {
        // despite rounding, points within the distance have coordinates within this of the box
        let largest = low.abs().max(high.abs()).max_element().max(self.extent);
        let reach = distance * 1.0001 + largest * 1e-6;
        let (first, last) = (self.cell(low - reach), self.cell(high + reach));
        for layer in first.z..=last.z {
            for row in first.y..=last.y {
                let start = self.starts[self.start_of(UVec3::new(first.x, row, layer))];
                let end = self.starts[self.start_of(UVec3::new(last.x, row, layer)) + 1];
                if start < end {
                    visit(start as usize..end as usize);
                }
            }
        }
    }

    /// Calls `visit` for every point within `range` of `from` (inclusive), with its place and its offset, in ascending
    /// places.
    pub fn within(&self, from: Vec3, range: f32, mut visit: impl FnMut(usize, Vec3)) {
        if self.len == 0 {
            return;
        }
        self.runs_near(from, from, range, |run| {
            for place in run {
                let offset = Vec3::new(self.x[place], self.y[place], self.z[place]) - from;
                if offset.length_squared() <= range * range {
                    visit(place, offset);
                }
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn build(points: &[Vec3], numbers: &[u32], reach: f32) -> CellLattice {
        let mut lattice = CellLattice::default();
        lattice.rebuild(|row| points[row], numbers, reach);
        lattice
    }

    proptest! {
        #[test]
        fn points_within_range_are_found_in_any_order_of_rows(
            points in prop::collection::vec((-20.0f32..20.0, -20.0f32..20.0, -20.0f32..20.0), 1..300),
            flat: bool, coarse: bool, far in prop_oneof![Just(0.0f32), Just(1e4)],
            reach in 0.1f32..30.0, range in 0.1f32..30.0, turn in 0usize..300,
        ) {
            let place = |&(x, y, z): &(f32, f32, f32)| {
                let p = Vec3::new(x + far, y, if flat { 0.0 } else { z });
                if coarse { p.round() } else { p }
            };
            let points: Vec<Vec3> = points.iter().map(place).collect();
            let numbers: Vec<u32> = (0..points.len() as u32).collect();
            let lattice = build(&points, &numbers, reach);
            let (mut turned, mut others) = (points.clone(), numbers.clone());
            turned.rotate_left(turn % points.len());
            others.rotate_left(turn % points.len());
            let same = build(&turned, &others, reach);
            for &from in points.iter().take(20) {
                let found = |lattice: &CellLattice, numbers: &[u32]| {
                    let mut found = vec![];
                    lattice.within(from, range, |place, offset| {
                        found.push((place, numbers[lattice.order()[place] as usize], offset));
                    });
                    found
                };
                let near = found(&lattice, &numbers);
                prop_assert_eq!(&near, &found(&same, &others));
                prop_assert!(near.is_sorted_by_key(|&(place, ..)| place));
                let mut found: Vec<u32> = near.iter().map(|&(_, number, _)| number).collect();
                found.sort_unstable();
                let within = |&&number: &&u32| {
                    (points[number as usize] - from).length_squared() <= range * range
                };
                let expected: Vec<u32> = numbers.iter().filter(within).copied().collect();
                prop_assert_eq!(found, expected);
            }
        }
    }

    #[test]
    fn places_and_rows_are_inverse_to_each_other() {
        let points: Vec<Vec3> = (0..100).map(|k| Vec3::new((k * 37 % 100) as f32, (k % 7) as f32, 0.0)).collect();
        let mut lattice = build(&points, &(0..100).collect::<Vec<_>>(), 4.0);
        let of =
            |lattice: &CellLattice| (0..100).all(|row| lattice.order()[lattice.places()[row] as usize] as usize == row);
        assert!(of(&lattice) && lattice.order()[..3] != [0, 1, 2]);
        lattice.rows_are_in_order();
        assert!(of(&lattice) && lattice.order()[..3] == [0, 1, 2]);
        build(&[], &[], 1.0).within(Vec3::ZERO, 1.0, |_, _| panic!("the lattice is empty"));
    }
}
