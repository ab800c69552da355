//! The grid.

use glam::Vec2;

/// A point found by a query.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Near {
    /// Its row in the slice the grid was built from.
    pub row: u32,
    /// Its number: ties in distance go to the lower one.
    pub number: u32,
    /// Square of the distance, `f32` arithmetic: `dx * dx + dy * dy`, and what was added by who accepted it.
    pub distance_squared: f32,
}

impl Near {
    fn before(&self, other: &Self) -> bool {
        (self.distance_squared, self.number) < (other.distance_squared, other.number)
    }
}

/// Points a block holds at most before it is divided.
const LEAF: usize = 24;

/// A box with the points in it: a cell, or a part of a crowded one.
#[derive(Clone, Copy, Debug)]
struct Block {
    low: Vec2,
    high: Vec2,
    least_number: u32,
    start: u32,
    end: u32,
    /// First of its two halves in `blocks`; 0 if it is not divided.
    halves: u32,
}

impl Block {
    fn distance_squared(&self, from: Vec2) -> f32 {
        let d = (self.low - from).max(from - self.high).max(Vec2::ZERO);
        d.x * d.x + d.y * d.y
    }
}

/// A uniform grid over points, rebuilt by counting sort, for exact neighbour queries.
///
/// Each occupied cell keeps the tight box round its points, so whole cells are skipped without a point being missed:
/// rounding is monotonic, hence the computed distance to a box never exceeds the computed distance to a point in it.
/// Cells that hold many points are divided further by medians, so that a query stays cheap when all points are in one
/// spot.
///
/// Cost: building is linear (n log n within crowded cells), a query depends on the points near it only.
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
    low: Vec2,
    inverse: f32,
    cell: f32,
    columns: usize,
    rows: usize,
    /// Block of each cell, or `EMPTY`.
    cells: Vec<u32>,
    blocks: Vec<Block>,
    /// Points, numbers and rows in the order of cells.
    points: Vec<Vec2>,
    numbers: Vec<u32>,
    order: Vec<u32>,
    cell_of: Vec<u32>,
    starts: Vec<u32>,
}

const EMPTY: u32 = u32::MAX;

impl Grid {
    /// Sorts the points into cells about `cell` wide (metres; widened if the points lie so far apart that there
    /// would be many more cells than points). `numbers` break ties and must all differ.
    ///
    /// # Panics
    /// If the slices differ in length. Points must be finite.
    pub fn rebuild(&mut self, points: &[Vec2], numbers: &[u32], cell: f32) {
        assert_eq!(points.len(), numbers.len(), "a number for every point");
        self.blocks.clear();
        self.points.clear();
        self.numbers.clear();
        self.order.clear();
        self.cells.clear();
        let Some(&first) = points.first() else {
            (self.columns, self.rows) = (0, 0);
            return;
        };
        let (low, high) = points.iter().fold((first, first), |(low, high), &p| (low.min(p), high.max(p)));
        let size = high - low;
        let most = (points.len() * 2 + 64) as f32;
        let mut cell = cell.max(1e-6).max(size.max_element() / 1e6);
        while (size.x / cell + 1.0) * (size.y / cell + 1.0) > most {
            cell *= 1.5;
        }
        self.low = low;
        self.cell = cell;
        self.inverse = 1.0 / cell;
        self.columns = (size.x * self.inverse) as usize + 1;
        self.rows = (size.y * self.inverse) as usize + 1;
        self.sort(points, numbers);
        self.cells.resize(self.columns * self.rows, EMPTY);
        for c in 0..self.cells.len() {
            let (start, end) = (self.starts[c] as usize, self.starts[c + 1] as usize);
            if start < end {
                self.cells[c] = self.blocks.len() as u32;
                let block = self.block(start, end);
                self.blocks.push(block);
            }
        }
        for c in 0..self.blocks.len() {
            self.divide(c);
        }
    }

    fn cell_at(&self, p: Vec2) -> (usize, usize) {
        let q = (p - self.low) * self.inverse;
        // `as` saturates: points left of or below the grid go to 0
        ((q.x as usize).min(self.columns - 1), (q.y as usize).min(self.rows - 1))
    }

    fn sort(&mut self, points: &[Vec2], numbers: &[u32]) {
        let mut cell_of = std::mem::take(&mut self.cell_of);
        cell_of.clear();
        cell_of.extend(points.iter().map(|&p| {
            let (x, y) = self.cell_at(p);
            (y * self.columns + x) as u32
        }));
        self.starts.clear();
        self.starts.resize(self.columns * self.rows + 1, 0);
        for &c in &cell_of {
            self.starts[c as usize + 1] += 1;
        }
        for c in 1..self.starts.len() {
            self.starts[c] += self.starts[c - 1];
        }
        self.order.resize(points.len(), 0);
        for (row, &c) in cell_of.iter().enumerate() {
            let at = &mut self.starts[c as usize];
            self.order[*at as usize] = row as u32;
            *at += 1;
        }
        // filling moved every start to the next cell's: shift back
        self.starts.rotate_right(1);
        self.starts[0] = 0;
        self.points.extend(self.order.iter().map(|&row| points[row as usize]));
        self.numbers.extend(self.order.iter().map(|&row| numbers[row as usize]));
        self.cell_of = cell_of;
    }

    fn block(&self, start: usize, end: usize) -> Block {
        let first = self.points[start];
        let (low, high) = self.points[start..end].iter().fold((first, first), |(l, h), &p| (l.min(p), h.max(p)));
        let least_number = self.numbers[start..end].iter().copied().min().unwrap_or(0);
        Block { low, high, least_number, start: start as u32, end: end as u32, halves: 0 }
    }

    /// Halves a crowded block at its median, across its longer side (by number where all points coincide).
    fn divide(&mut self, at: usize) {
        let Block { low, high, start, end, .. } = self.blocks[at];
        let (start, end) = (start as usize, end as usize);
        if end - start <= LEAF {
            return;
        }
        let size = high - low;
        let mut part: Vec<(Vec2, u32, u32)> =
            (start..end).map(|k| (self.points[k], self.numbers[k], self.order[k])).collect();
        let middle = part.len() / 2;
        let axis = |p: Vec2| if size.x >= size.y { p.x } else { p.y };
        part.select_nth_unstable_by(middle, |a, b| axis(a.0).total_cmp(&axis(b.0)).then(a.1.cmp(&b.1)));
        for (k, (p, number, row)) in (start..end).zip(part) {
            self.points[k] = p;
            self.numbers[k] = number;
            self.order[k] = row;
        }
        let halves = self.blocks.len();
        self.blocks[at].halves = halves as u32;
        for (start, end) in [(start, start + middle), (start + middle, end)] {
            let block = self.block(start, end);
            self.blocks.push(block);
        }
        self.divide(halves);
        self.divide(halves + 1);
    }

    /// The `k` nearest points within `range` of `from` (inclusive) that `accept` accepts, nearest first, ties by
    /// number, into `found` (emptied first). Where more than the plane separates points, `accept` adds it to their
    /// distances: what lies in the plane is the least that they can be.
    pub fn nearest(&self, from: Vec2, k: usize, range: f32, accept: impl Fn(&mut Near) -> bool, found: &mut Vec<Near>) {
        found.clear();
        if self.order.is_empty() || k == 0 {
            return;
        }
        let limit = Near { row: 0, number: u32::MAX, distance_squared: range * range };
        let (cx, cy) = self.cell_at(from);
        for ring in 0..self.columns.max(self.rows) {
            // points of this ring are at least ring - 1 cells away; a little less, for rounding of the cells' edges
            let reach = (ring as f32 - 1.0) * self.cell * 0.999;
            let worst = if found.len() == k { found[k - 1] } else { limit };
            if ring > 1 && reach * reach > worst.distance_squared {
                break;
            }
            self.visit_ring(cx, cy, ring, |block| self.nearest_in(block, from, k, limit, &accept, found));
        }
    }

    fn nearest_in(
        &self,
        block: &Block,
        from: Vec2,
        k: usize,
        limit: Near,
        accept: &impl Fn(&mut Near) -> bool,
        found: &mut Vec<Near>,
    ) {
        let worst = if found.len() == k { found[k - 1] } else { limit };
        let best = Near { row: 0, number: block.least_number, distance_squared: block.distance_squared(from) };
        if worst.before(&best) {
            return;
        }
        if block.halves != 0 {
            let (a, b) = (&self.blocks[block.halves as usize], &self.blocks[block.halves as usize + 1]);
            let key = |block: &Block| (block.distance_squared(from), block.least_number);
            let (first, second) = if key(a) <= key(b) { (a, b) } else { (b, a) };
            self.nearest_in(first, from, k, limit, accept, found);
            self.nearest_in(second, from, k, limit, accept, found);
            return;
        }
        for at in block.start as usize..block.end as usize {
            let mut near = self.near(from, at);
            let worst = if found.len() == k { found[k - 1] } else { limit };
            let counts =
                |near: &Near| near.before(&worst) || near.distance_squared == limit.distance_squared && found.len() < k;
            let in_plane = near.distance_squared;
            if counts(&near) && accept(&mut near) && (near.distance_squared == in_plane || counts(&near)) {
                if found.len() == k {
                    found.pop();
                }
                let place = found.partition_point(|other| other.before(&near));
                found.insert(place, near);
            }
        }
    }

    /// Calls `visit` for every point within `range` of `from` (inclusive), in no particular order.
    pub fn within(&self, from: Vec2, range: f32, mut visit: impl FnMut(Near)) {
        if self.order.is_empty() {
            return;
        }
        let pad = Vec2::splat(range + self.cell * 0.001);
        let (x0, y0) = self.cell_at(from - pad);
        let (x1, y1) = self.cell_at(from + pad);
        for y in y0..=y1 {
            for &block in &self.cells[y * self.columns + x0..=y * self.columns + x1] {
                if block != EMPTY {
                    self.within_block(block, from, range * range, &mut visit);
                }
            }
        }
    }

    fn within_block(&self, block: u32, from: Vec2, range_squared: f32, visit: &mut impl FnMut(Near)) {
        let block = &self.blocks[block as usize];
        if block.distance_squared(from) > range_squared {
            return;
        }
        if block.halves != 0 {
            self.within_block(block.halves, from, range_squared, visit);
            self.within_block(block.halves + 1, from, range_squared, visit);
            return;
        }
        for at in block.start as usize..block.end as usize {
            let near = self.near(from, at);
            if near.distance_squared <= range_squared {
                visit(near);
            }
        }
    }

    fn near(&self, from: Vec2, at: usize) -> Near {
        let d = self.points[at] - from;
        Near { row: self.order[at], number: self.numbers[at], distance_squared: d.x * d.x + d.y * d.y }
    }

    fn visit_ring<'a>(&'a self, cx: usize, cy: usize, ring: usize, mut visit: impl FnMut(&'a Block)) {
        let x0 = cx.saturating_sub(ring);
        let x1 = (cx + ring).min(self.columns - 1);
        let mut cell = |x: usize, y: usize| {
            let block = self.cells[y * self.columns + x];
            if block != EMPTY {
                visit(&self.blocks[block as usize]);
            }
        };
        if ring == 0 {
            cell(cx, cy);
            return;
        }
        for y in [cy.checked_sub(ring), Some(cy + ring)].into_iter().flatten().filter(|&y| y < self.rows) {
            for x in x0..=x1 {
                cell(x, y);
            }
        }
        for x in [cx.checked_sub(ring), Some(cx + ring)].into_iter().flatten().filter(|&x| x < self.columns) {
            for y in (cy + 1).saturating_sub(ring)..(cy + ring).min(self.rows) {
                cell(x, y);
            }
        }
    }
}
