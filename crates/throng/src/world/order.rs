//! The order of rows: who is near on the ground is to be near in memory too.

use super::{StepMemory, World};

/// Agents from which on it pays to move rows: fewer lie in the nearest memory, however they lie there.
const LARGE: usize = 2048;
/// Sub-steps between two looks.
const EVERY: u64 = 16;
/// Rows from one to the next in the grid that memory is not read ahead over, and one in how many are this far apart
/// when rows are moved.
const FAR: u32 = 64;
const PART: usize = 8;

impl World {
    /// Puts the rows of [`agents`](Self::agents) in the order in which they lie on the ground, strip by strip. Large
    /// crowds do so by themselves now and then: everything is the same after it, but faster.
    pub fn sort_rows(&mut self) {
        self.rebuild_grid();
        self.put_in_order(false);
    }

    /// As [`sort_rows`](Self::sort_rows), for a grid or lattice that is fresh, if it pays.
    pub(super) fn sort_rows_if_scattered(&mut self) {
        let in_lattice = self.nobody_counts_the_nearest();
        if in_lattice && !self.anybody_looks_at_everybody() {
            // where nobody looks at anybody, nobody knows who is near
            return;
        }
        let order = if in_lattice { self.step.flocks.order() } else { self.step.grid.order() };
        if order.len() >= LARGE && self.tally.sub_steps.is_multiple_of(EVERY) && is_scattered(order) {
            self.put_in_order(in_lattice);
        }
    }

    /// Puts the rows in the order of the grid, or of the lattice.
    fn put_in_order(&mut self, lattice: bool) {
        let StepMemory { grid, flocks, cycles, rest, ahead, .. } = &mut self.step;
        cycles.find(if lattice { flocks.order() } else { grid.order() });
        self.agents.permute(cycles);
        if ahead.len() == self.agents.len() {
            cycles.turn(ahead);
        }
        if lattice {
            flocks.rows_are_in_order();
        } else {
            grid.rows_are_in_order();
        }
        rest.end();
        for (&slot, row) in self.agents.slot.iter().zip(0..) {
            self.slots.rows[slot as usize] = row;
        }
    }
}

fn is_scattered(order: &[u32]) -> bool {
    let jumps = order.windows(2).filter(|pair| pair[0].abs_diff(pair[1]) > FAR).count();
    jumps > order.len() / PART
}
