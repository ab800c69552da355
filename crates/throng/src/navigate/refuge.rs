//! Refuges: the nearest place outside the paths of other agents, to wait until they have passed.
//!
//! The ground is a lattice of cells on the mesh: each cell stands for the point of the mesh nearest to its centre, and
//! neighbours are linked where they are visible from each other. So a passage hardly wider than a body is a chain of
//! cells, whatever its direction. Shortest paths over the cells are found by Dijkstra's algorithm.

use super::mesh::NavMesh;
use super::path::Path;
use crate::space::{Disc, nearest_on_segment};
use glam::DVec2;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Width of a cell, in radii of the mesh.
const CELL: f64 = 1.25;
/// Number of cells from the middle to each side.
const HALF: usize = 64;
const SIDE: usize = 2 * HALF + 1;
/// Part of a disc's radius that a path keeps from it, so that an agent in contact with the disc can start.
const TOUCHES: f64 = 0.99;

/// The ground around a point, with the looked-up cells kept for further searches.
#[derive(Debug)]
pub(crate) struct Refuge<'a> {
    mesh: &'a NavMesh,
    low: DVec2,
    width: f64,
    /// The places of the cells, once looked up.
    places: Vec<Option<Option<DVec2>>>,
}

impl<'a> Refuge<'a> {
    pub fn new(mesh: &'a NavMesh, middle: DVec2) -> Self {
        let width = CELL * mesh.radius();
        Self { mesh, low: middle - width * (HALF as f64 + 0.5), width, places: vec![None; SIDE * SIDE] }
    }

    pub fn mesh(&self) -> &'a NavMesh {
        self.mesh
    }

    /// Returns the path to the nearest place that `found` accepts, around the discs in `blocked`. `None`: there is no
    /// such place nearby.
    pub fn nearest(&mut self, from: DVec2, blocked: &[Disc], found: impl Fn(DVec2) -> bool) -> Option<Path> {
        let start = self.mesh.nearest(from);
        let path = |corners, length| Some(Path { start, corners, length });
        if found(start) {
            return path(vec![start], 0.0);
        }
        let mut reached = vec![(f64::INFINITY, usize::MAX); SIDE * SIDE];
        let mut open = BinaryHeap::new();
        let here = self.cell(start)?;
        self.spread((start, 0.0, here, usize::MAX), blocked, &mut reached, &mut open);
        while let Some(Reverse((bits, cell))) = open.pop() {
            let length = f64::from_bits(bits);
            let Some(Some(place)) = self.places[cell].filter(|_| length <= reached[cell].0) else { continue };
            if found(place) {
                let mut chain = vec![place];
                let mut before = reached[cell].1;
                while before != usize::MAX {
                    chain.extend(self.places[before].flatten());
                    before = reached[before].1;
                }
                chain.reverse();
                return path(chain, length);
            }
            self.spread((place, length, cell, cell), blocked, &mut reached, &mut open);
        }
        None
    }

    /// Continues from a place in a cell to the cells around it. Lengths are never negative, so their bits are in the
    /// order of their values.
    fn spread(
        &mut self,
        (place, length, cell, before): (DVec2, f64, usize, usize),
        blocked: &[Disc],
        reached: &mut [(f64, usize)],
        open: &mut BinaryHeap<Reverse<(u64, usize)>>,
    ) {
        let (column, row) = (cell % SIDE, cell / SIDE);
        for y in row.saturating_sub(1)..(row + 2).min(SIDE) {
            for x in column.saturating_sub(1)..(column + 2).min(SIDE) {
                let next = y * SIDE + x;
                let Some(to) = self.place(next) else { continue };
                let there = length + to.distance(place);
                let free = |disc: &Disc| {
                    let least = (TOUCHES * disc.radius).min(place.distance(disc.center));
                    nearest_on_segment(place, to, disc.center).distance(disc.center) >= least
                };
                if there < reached[next].0 && blocked.iter().all(free) && self.mesh.visible(place, to) {
                    reached[next] = (there, before);
                    open.push(Reverse((there.to_bits(), next)));
                }
            }
        }
    }

    fn cell(&self, at: DVec2) -> Option<usize> {
        let cell = ((at - self.low) / self.width).floor();
        let inside = cell.min_element() >= 0.0 && cell.max_element() < SIDE as f64;
        inside.then(|| cell.y as usize * SIDE + cell.x as usize)
    }

    /// Returns the point of the mesh that a cell stands for; `None` if the cell is off the mesh.
    fn place(&mut self, cell: usize) -> Option<DVec2> {
        *self.places[cell].get_or_insert_with(|| {
            let middle = self.low + (DVec2::new((cell % SIDE) as f64, (cell / SIDE) as f64) + 0.5) * self.width;
            let nearest = self.mesh.nearest(middle);
            ((nearest - middle).abs().max_element() <= 0.5 * self.width).then_some(nearest)
        })
    }
}
