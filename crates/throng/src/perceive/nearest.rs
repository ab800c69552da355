//! Scalar nearest-neighbour search: the reference for the [SIMD search](super::tile), and the fallback for the points
//! that the SIMD search cannot decide.

use super::block::PointBlock;
use super::grid::{Grid, Run};
use glam::Vec2;

/// A point found by a query.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Near {
    /// Row in the slice that the grid was built from.
    pub row: u32,
    /// Number of the point. Of two points at the same distance the lower number comes first.
    pub number: u32,
    /// Squared distance in `f32` arithmetic: `dx * dx + dy * dy`, and what the `accept` function of the query added.
    pub distance_squared: f32,
}

impl Near {
    fn before(&self, other: &Self) -> bool {
        (self.distance_squared, self.number) < (other.distance_squared, other.number)
    }
}

/// A search in progress.
struct NearestSearch<'a, F> {
    grid: &'a Grid,
    from: Vec2,
    k: usize,
    limit: Near,
    accept: F,
    found: &'a mut Vec<Near>,
}

impl Grid {
    /// Finds the `k` nearest points within `range` of `from` (inclusive) that `accept` accepts, nearest first, ties by
    /// number. Clears `found` first. If points are also separated across the plane, `accept` adds that part to the
    /// squared distance, which holds only the distance in the plane before.
    pub fn nearest(&self, from: Vec2, k: usize, range: f32, accept: impl Fn(&mut Near) -> bool, found: &mut Vec<Near>) {
        found.clear();
        if self.is_empty() || k == 0 {
            return;
        }
        let limit = Near { row: 0, number: u32::MAX, distance_squared: range * range };
        let mut search = NearestSearch { grid: self, from, k, limit, accept, found };
        let middle = self.row(from.y);
        search.visit(middle);
        let (mut below, mut above) = (true, true);
        for ring in 1..self.rows() {
            below = below && ring <= middle && search.visit(middle - ring);
            above = above && middle + ring < self.rows() && search.visit(middle + ring);
            if !below && !above {
                break;
            }
        }
    }
}

impl<F: Fn(&mut Near) -> bool> NearestSearch<'_, F> {
    /// Returns the last of the `k` points found so far, or the limit if there are fewer.
    fn worst(&self) -> Near {
        if self.found.len() == self.k { self.found[self.k - 1] } else { self.limit }
    }

    /// Visits all points of a row of cells that may be among the nearest. Returns false if the row is too far away.
    fn visit(&mut self, row: usize) -> bool {
        let reach = self.grid.reach(self.from, self.worst().distance_squared.sqrt());
        let within = self.grid.row(self.from.y - reach) <= row && row <= self.grid.row(self.from.y + reach);
        if within {
            let grid = self.grid;
            grid.runs(row, self.from.x - reach, self.from.x + reach, |run| match run {
                Run::Points(start, end) => self.look(start, end),
                Run::Crowd(block) => self.look_in(&grid.blocks()[block as usize]),
            });
        }
        within
    }

    /// Visits a block, its nearer half first.
    fn look_in(&mut self, block: &PointBlock) {
        let number = block.least_number;
        let best = Near { row: 0, number, distance_squared: block.distance_squared(self.from) };
        if self.worst().before(&best) {
            return;
        }
        if block.halves == 0 {
            return self.look(block.start, block.end);
        }
        let (a, b) = (&self.grid.blocks()[block.halves as usize], &self.grid.blocks()[block.halves as usize + 1]);
        let key = |block: &PointBlock| (block.distance_squared(self.from), block.least_number);
        let (first, second) = if key(a) <= key(b) { (a, b) } else { (b, a) };
        self.look_in(first);
        self.look_in(second);
    }

    fn look(&mut self, start: u32, end: u32) {
        for at in start as usize..end as usize {
            let mut near = self.grid.near(self.from, at);
            let (worst, limit, full) = (self.worst(), self.limit, self.found.len() == self.k);
            let counts = |near: &Near| near.before(&worst) || near.distance_squared == limit.distance_squared && !full;
            let in_plane = near.distance_squared;
            if counts(&near) && (self.accept)(&mut near) && (near.distance_squared == in_plane || counts(&near)) {
                if full {
                    self.found.pop();
                }
                let place = self.found.partition_point(|other| other.before(&near));
                self.found.insert(place, near);
            }
        }
    }
}
