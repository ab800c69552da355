//! The links between neighbouring cells of a terrain.

use super::super::cost::KEPT;
use super::super::eikonal::Links;
use super::terrain::{TOUCH, Terrain};
use glam::Vec2;
use throng::parallel;

/// Steps to the neighbours right, above, and diagonally above, with the bits of these links and of the links back.
const WAYS: [(isize, isize, Links, Links); 4] = [(1, 0, 2, 1), (0, 1, 8, 4), (1, 1, 128, 16), (-1, 1, 64, 32)];

impl Terrain {
    /// Returns the cell at an offset of columns and rows, if there is one.
    fn next(&self, cell: usize, (right, up): (isize, isize)) -> Option<usize> {
        let [columns, rows] = self.lattice.counts;
        let column = (cell % columns).checked_add_signed(right).filter(|&column| column < columns)?;
        let row = (cell / columns).checked_add_signed(up).filter(|&row| row < rows)?;
        Some(row * columns + column)
    }

    /// Sets lengths and directions of the cells that are too close to walls, from the neighbours that are farther from
    /// walls. So these cells lead out, and no flow leads on through gaps that are too narrow.
    pub(super) fn lead_out(&self, cost: &[f32], lengths: &mut [f32], directions: &mut [Vec2]) {
        for &cell in &self.close {
            let cell = cell as usize;
            let mut best = (f32::INFINITY, Vec2::ZERO);
            for (right, up, there, back) in WAYS {
                for (right, up, bit) in [(right, up, there), (-right, -up, back)] {
                    let next = self.next(cell, (right, up)).filter(|_| self.margin[cell] & bit != 0);
                    let Some(next) = next.filter(|&next| self.distances[next] >= self.distances[cell]) else {
                        continue;
                    };
                    let way = Vec2::new(right as f32, up as f32);
                    let length = lengths[next] + way.length() * self.lattice.cell as f32 * cost[cell];
                    if length < best.0 {
                        best = (length, way.normalize());
                    }
                }
            }
            (lengths[cell], directions[cell]) = best;
        }
    }

    /// Finds the links between neighbouring cells.
    pub(super) fn link(&mut self) {
        let mut onwards: Vec<(Links, Links)> = vec![(0, 0); self.lattice.len()];
        parallel::rows(&mut onwards[..], |(): &mut (), node, (links, margin)| {
            for (right, up, there, _) in WAYS {
                let Some(next) = self.next(node, (right, up)) else { continue };
                if self.solid[node] || self.solid[next] {
                    continue;
                }
                let open = self.is_open(node) && self.is_open(next);
                // diagonal links matter close to walls only
                let close = |node: usize| f64::from(self.distances[node]) < self.radius + 1.5 * self.lattice.cell;
                if right != 0 && up != 0 && open && !close(node) && !close(next) {
                    continue;
                }
                let gap = if open { (KEPT * self.radius).max(TOUCH) } else { TOUCH };
                let (from, to) = (self.middle(node), self.middle(next));
                // no point between the two cells is farther from both than half of their distance
                let sum = f64::from(self.distances[node]) + f64::from(self.distances[next]);
                if sum > 2.0 * gap + 1.001 * from.distance(to) || self.walls.keep_off((from, to), gap) {
                    *if open { &mut *links } else { &mut *margin } |= there;
                }
            }
        });
        for (node, (links, margin)) in onwards.into_iter().enumerate() {
            self.links[node] |= links;
            self.margin[node] |= margin;
            for (right, up, there, back) in WAYS {
                let Some(next) = self.next(node, (right, up)) else { continue };
                self.links[next] |= if links & there != 0 { back } else { 0 };
                self.margin[next] |= if margin & there != 0 { back } else { 0 };
            }
        }
        let close = (0..self.lattice.len()).filter(|&node| !self.is_open(node) && self.margin[node] != 0);
        self.close = close.map(|node| node as u32).collect();
        let far = |node: u32| self.distances[node as usize];
        self.close.sort_by(|&a, &b| far(b).total_cmp(&far(a)).then(a.cmp(&b)));
    }
}
