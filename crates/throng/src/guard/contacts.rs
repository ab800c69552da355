//! Who and what each body could touch in this step: a complete list.

use super::Bodies;
use crate::parallel;
use crate::perceive::Grid;
use crate::space::{NearWalls, Walls};
use glam::Vec2;

/// For each body, the others and the walls within its reach and theirs.
#[derive(Clone, Debug, Default)]
pub struct Contacts {
    own: Vec<Found>,
    starts: Vec<u32>,
    others: Vec<u32>,
}

/// What one body could touch; of a pair, the larger body lists the smaller.
#[derive(Clone, Debug, Default)]
struct Found {
    smaller: Vec<(u32, u32)>,
    edges: Vec<u32>,
    discs: Vec<u32>,
}

impl Contacts {
    /// Collects all pairs that could touch, by a grid over the bodies' positions, and all walls. `meets` tells
    /// whether two rows are solid to each other.
    pub fn collect(
        &mut self,
        bodies: &Bodies<'_>,
        numbers: &[u32],
        grid: &Grid,
        walls: &Walls,
        meets: impl Fn(usize, usize) -> bool + Sync,
    ) {
        let n = bodies.positions.len();
        self.own.resize_with(n, Found::default);
        let is_disc = |row: usize| bodies.cores[row] == Vec2::ZERO;
        let farthest = bodies.reach.values().iter().copied().fold(0.0, f32::max);
        parallel::rows(&mut self.own, 1, NearWalls::default, |near, row, found| {
            let found = &mut found[0];
            found.smaller.clear();
            let (at, radius, reach) = (bodies.positions[row], bodies.bound(row), bodies.reach[row]);
            // a little farther than the sum, for the rounding of squares
            let range = (2.0 * radius + reach + farthest) * 1.0001;
            grid.within(at, range, |near| {
                let other = near.row as usize;
                let size = bodies.bound(other);
                let rank = |row: usize| (bodies.bound(row), numbers[row]);
                let range = (radius + size + reach + bodies.reach[other]) * 1.0001;
                let above =
                    if is_disc(row) && is_disc(other) { bodies.altitudes[other] - bodies.altitudes[row] } else { 0.0 };
                let distance_squared = near.distance_squared + above * above;
                if rank(other) < rank(row) && distance_squared <= range * range && meets(row, other) {
                    found.smaller.push((near.number, near.row));
                }
            });
            found.edges.clear();
            found.discs.clear();
            if !walls.is_empty() {
                walls.near(at.as_dvec2(), f64::from(radius + reach) * 1.0001, near);
                found.edges.extend(near.edges.iter().map(|&(_, index)| index));
                found.discs.extend(near.discs.iter().map(|&(_, index)| index));
            }
        });
        self.make_symmetric(n, numbers);
    }

    /// Lists every pair with both of its bodies, each body's partners in the order of their numbers.
    fn make_symmetric(&mut self, n: usize, numbers: &[u32]) {
        self.starts.clear();
        self.starts.resize(n + 1, 0);
        for (row, found) in self.own.iter().enumerate() {
            self.starts[row + 1] += found.smaller.len() as u32;
            for &(_, other) in &found.smaller {
                self.starts[other as usize + 1] += 1;
            }
        }
        for row in 0..n {
            self.starts[row + 1] += self.starts[row];
        }
        self.others.resize(self.starts[n] as usize, 0);
        for (row, found) in self.own.iter().enumerate() {
            for &(_, other) in &found.smaller {
                for (of, partner) in [(row, other), (other as usize, row as u32)] {
                    let at = &mut self.starts[of];
                    self.others[*at as usize] = partner;
                    *at += 1;
                }
            }
        }
        self.starts.rotate_right(1);
        self.starts[0] = 0;
        for row in 0..n {
            let (start, end) = (self.starts[row] as usize, self.starts[row + 1] as usize);
            self.others[start..end].sort_unstable_by_key(|&other| numbers[other as usize]);
        }
    }

    /// Rows of the bodies that `row` could touch, in the order of their numbers.
    pub fn of(&self, row: usize) -> &[u32] {
        &self.others[self.starts[row] as usize..self.starts[row + 1] as usize]
    }

    /// Wall edges that `row` could touch, nearest first.
    pub fn edges_of(&self, row: usize) -> &[u32] {
        &self.own[row].edges
    }

    /// Solid discs that `row` could touch, nearest first.
    pub fn discs_of(&self, row: usize) -> &[u32] {
        &self.own[row].discs
    }

    /// Whether `row` can touch nothing.
    pub fn is_alone(&self, row: usize) -> bool {
        self.of(row).is_empty() && self.edges_of(row).is_empty() && self.discs_of(row).is_empty()
    }
}
