//! Who and what each body could touch in this step: a complete list.

use super::Bodies;
use super::lists::Lists;
use crate::perceive::Grid;
use crate::space::{NearWalls, Walls};

/// For each body, the others and the walls within its reach and theirs.
#[derive(Clone, Debug, Default)]
pub struct Contacts {
    others: Lists,
    /// Nothing, or the number of edges, the edges, the discs.
    walls: Lists<NearWalls>,
    /// Bodies and those that tell them of contacts they do not look for.
    told: Vec<(u32, u32)>,
}

/// Ranges are a little wider than the sums, for the rounding of squares.
const PAD: f32 = 1.0001;

/// How bodies find each other: everybody looks as far as is needed for all who are not larger than usual or than they
/// are; the few who are larger tell.
#[derive(Clone, Copy)]
struct Search<'a> {
    bodies: &'a Bodies<'a>,
    numbers: &'a [u32],
    grid: &'a Grid,
    /// Size that few exceed.
    usual: f32,
}

impl Search<'_> {
    /// How far from its centre a body can touch something in the step.
    #[inline]
    fn size(&self, row: usize) -> f32 {
        self.bodies.bound(row) + self.bodies.reach(row)
    }

    /// Calls `found` for those who can touch `row` and are not larger than `limit`.
    #[inline]
    fn look(&self, row: usize, limit: f32, mut found: impl FnMut(usize)) {
        let range = (self.size(row) + limit) * (PAD * PAD);
        self.grid.within(self.bodies.positions[row], range, |near| {
            let other = near.row as usize;
            if other != row && self.size(other) <= limit && self.touch(row, other, near.distance_squared) {
                found(other);
            }
        });
    }

    /// Whether two can touch.
    #[inline]
    fn touch(&self, a: usize, b: usize, distance_squared: f32) -> bool {
        let Self { bodies, numbers, .. } = self;
        // rounded in the same way whoever asks
        let rank = |row: usize| (bodies.bound(row), numbers[row]);
        let (a, b) = if rank(a) < rank(b) { (b, a) } else { (a, b) };
        let range = (bodies.bound(a) + bodies.bound(b) + bodies.reach(a) + bodies.reach(b)) * PAD;
        let discs = bodies.is_disc(a) && bodies.is_disc(b);
        let above = if discs { bodies.altitudes[b] - bodies.altitudes[a] } else { 0.0 };
        distance_squared + above * above <= range * range
    }
}

impl Contacts {
    /// Collects all pairs that could touch, by a grid over the bodies' positions, and all walls. `meets` tells
    /// whether two rows are solid to each other, the same whichever comes first; `alone` may say of rows that it is
    /// known that they can touch none of the others.
    pub fn collect(
        &mut self,
        bodies: &Bodies<'_>,
        numbers: &[u32],
        grid: &Grid,
        walls: &Walls,
        meets: impl Fn(usize, usize) -> bool + Sync,
        alone: impl Fn(usize) -> bool + Sync,
    ) {
        let rows = bodies.positions.len();
        let mut search = Search { bodies, numbers, grid, usual: 0.0 };
        let sizes = || (0..rows).map(|row| search.size(row));
        let mean = sizes().map(f64::from).sum::<f64>() / rows as f64;
        let usual = sizes().filter(|&size| f64::from(size) <= 2.0 * mean).fold(0.0, f32::max);
        search.usual = usual;
        self.told.clear();
        for row in (0..rows).filter(|&row| search.size(row) > usual) {
            let size = search.size(row);
            let told = &mut self.told;
            search.look(row, size, |other| {
                if search.size(other) < size && meets(row, other) {
                    told.push((other as u32, row as u32));
                }
            });
        }
        self.told.sort_unstable();
        let told = &self.told;
        self.others.fill(rows, |(), row, others| {
            if alone(row) {
                return;
            }
            let start = others.len();
            search.look(row, search.size(row).max(usual), |other| {
                if meets(row, other) {
                    others.push(other as u32);
                }
            });
            if !told.is_empty() {
                let first = told.partition_point(|&(of, _)| of < row as u32);
                others.extend(told[first..].iter().take_while(|&&(of, _)| of == row as u32).map(|&(_, by)| by));
            }
            others[start..].sort_unstable_by_key(|&other| numbers[other as usize]);
        });
        self.collect_walls(bodies, walls);
    }

    fn collect_walls(&mut self, bodies: &Bodies<'_>, walls: &Walls) {
        if walls.is_empty() {
            self.walls.clear();
            return;
        }
        self.walls.fill(bodies.positions.len(), |near, row, found| {
            let range = f64::from(bodies.bound(row) + bodies.reach(row)) * 1.0001;
            walls.near(bodies.positions[row].as_dvec2(), range, near);
            if !near.edges.is_empty() || !near.discs.is_empty() {
                found.push(near.edges.len() as u32);
                found.extend(near.edges.iter().chain(&near.discs).map(|&(_, index)| index));
            }
        });
    }

    /// Rows of the bodies that `row` could touch, in the order of their numbers.
    #[inline]
    pub fn of(&self, row: usize) -> &[u32] {
        self.others.of(row)
    }

    /// Wall edges that `row` could touch, nearest first.
    pub fn edges_of(&self, row: usize) -> &[u32] {
        self.walls_of(row).0
    }

    /// Solid discs that `row` could touch, nearest first.
    pub fn discs_of(&self, row: usize) -> &[u32] {
        self.walls_of(row).1
    }

    fn walls_of(&self, row: usize) -> (&[u32], &[u32]) {
        match self.walls.of(row) {
            [edges, all @ ..] => all.split_at(*edges as usize),
            [] => (&[], &[]),
        }
    }

    /// Whether `row` can touch no wall.
    pub fn is_off_walls(&self, row: usize) -> bool {
        self.walls.of(row).is_empty()
    }

    /// Whether `row` can touch nothing.
    pub fn is_alone(&self, row: usize) -> bool {
        self.of(row).is_empty() && self.is_off_walls(row)
    }
}
