//! The lattice: points in space sorted into cells.

use crate::lanes::LANES;
use crate::parallel;
use glam::{UVec3, Vec3};
use std::ops::Range;

/// Height of cells, and of the layers they lie in, over the mean distance of points, at most: so that as many points as a
/// vector has lanes are about as high as they are long.
const HEIGHT: f32 = 2.5;
/// Width of cells over their height.
const WIDTH: f32 = 0.25;
/// Cells a point, at most.
const CELLS: f32 = 4.0;

/// A lattice of cells over points in space, rebuilt by counting sort, for those who look at everybody near them.
///
/// Reynolds, Interaction with groups of autonomous characters, GDC 2000, "bin lattice". Cells are rows of narrow columns,
/// one layer above the other, and points lie in memory in their order: whatever a query needs of a row of cells is one run
/// of memory. Within a cell they lie by their coordinates, then by number: so the *place* of a point does not depend on its
/// row, and who goes through places in ascending order meets everybody in an order that depends on where they are only.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lattice {
    low: Vec3,
    /// Cells a metre.
    inverse: Vec3,
    /// Columns, rows and layers.
    cells: UVec3,
    /// Greatest distance of a coordinate from zero: what rounding depends on.
    extent: f32,
    /// Where the points of each cell begin, and where the last ones end.
    starts: Vec<u32>,
    /// Coordinates by place; beyond the end, whole vectors of zeros.
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

impl Lattice {
    /// Sorts points into cells, at most `reach` high, metres; more if they lie so far apart that there would be many more
    /// cells than points. `numbers` break ties and must all differ.
    pub fn rebuild(&mut self, point: impl Fn(usize) -> Vec3 + Sync, numbers: &[u32], reach: f32) {
        self.len = numbers.len();
        if self.len == 0 {
            return;
        }
        let (low, high) =
            (1..self.len).map(&point).fold((point(0), point(0)), |(low, high), p| (low.min(p), high.max(p)));
        let size = high - low;
        self.extent = low.abs().max(high.abs()).max_element();
        let count = self.len as f32;
        let longest = size.max_element();
        let area = (size.x * size.y).max(size.y * size.z).max(size.z * size.x);
        let spacing = (size.element_product() / count).cbrt().max((area / count).sqrt()).max(longest / count);
        let mut height = (2.0 * reach).min(HEIGHT * spacing).max(1e-6).max(longest / 1e6);
        let across = |height: f32| Vec3::new(1.0 / (WIDTH * height), 1.0 / height, 1.0 / height);
        while (size * across(height) + 1.0).element_product() > CELLS * count + 64.0 {
            height *= 1.25;
        }
        (self.low, self.inverse) = (low, across(height));
        self.cells = (size * self.inverse).as_uvec3() + 1;
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
        // vectors are read whole
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

    /// Puts the points of every cell in the order of their coordinates.
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

    /// The cell of a point, or the nearest one. Its parts never fall as the coordinates rise.
    fn cell(&self, point: Vec3) -> UVec3 {
        // `as` saturates
        ((point - self.low) * self.inverse).as_uvec3().min(self.cells - 1)
    }

    fn start_of(&self, cell: UVec3) -> usize {
        ((cell.z * self.cells.y + cell.y) * self.cells.x + cell.x) as usize
    }

    /// Row of each place.
    pub fn order(&self) -> &[u32] {
        &self.order[..self.len]
    }

    /// Place of each row.
    pub fn places(&self) -> &[u32] {
        &self.places[..self.len]
    }

    /// Notes that the rows have been put in the order of places.
    pub fn rows_are_in_order(&mut self) {
        self.order[..self.len].iter_mut().zip(0..).for_each(|(row, place)| *row = place);
        self.places.iter_mut().zip(0..).for_each(|(place, row)| *place = row);
    }

    /// Coordinates by place, and beyond the last as many as a vector has.
    pub fn coordinates(&self) -> [&[f32]; 3] {
        [&self.x, &self.y, &self.z]
    }

    /// Height of cells, metres.
    pub fn height(&self) -> f32 {
        1.0 / self.inverse.y
    }

    /// The place after the last point of the row of cells that the point at a place is in.
    pub fn end_of_row(&self, place: usize) -> usize {
        let cell = self.cell(Vec3::new(self.x[place], self.y[place], self.z[place]));
        self.starts[self.start_of(cell.with_x(0)) + self.cells.x as usize] as usize
    }

    /// Calls `visit` for the runs of places, ascending, that hold all points within a distance of a box, and others.
    #[inline(always)]
    pub fn runs_near(&self, low: Vec3, high: Vec3, distance: f32, mut visit: impl FnMut(Range<usize>)) {
        // whatever rounding does, points within the distance have coordinates within this of the box
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

    /// Calls `visit` for every point within `range` of `from` (inclusive), with its place and its offset, by ascending places.
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

    fn build(points: &[Vec3], numbers: &[u32], reach: f32) -> Lattice {
        let mut lattice = Lattice::default();
        lattice.rebuild(|row| points[row], numbers, reach);
        lattice
    }

    proptest! {
        #[test]
        fn who_is_within_reach_is_found_whatever_the_order_of_rows(
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
                let found = |lattice: &Lattice, numbers: &[u32]| {
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
    fn places_and_rows_tell_of_each_other() {
        let points: Vec<Vec3> = (0..100).map(|k| Vec3::new((k * 37 % 100) as f32, (k % 7) as f32, 0.0)).collect();
        let mut lattice = build(&points, &(0..100).collect::<Vec<_>>(), 4.0);
        let of =
            |lattice: &Lattice| (0..100).all(|row| lattice.order()[lattice.places()[row] as usize] as usize == row);
        assert!(of(&lattice) && lattice.order()[..3] != [0, 1, 2]);
        lattice.rows_are_in_order();
        assert!(of(&lattice) && lattice.order()[..3] == [0, 1, 2]);
        build(&[], &[], 1.0).within(Vec3::ZERO, 1.0, |_, _| panic!("nobody is there"));
    }
}
