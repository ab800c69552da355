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
        self.follow_grid();
    }

    /// As [`sort_rows`](Self::sort_rows), for a grid that is fresh, if it pays.
    pub(super) fn sort_rows_if_scattered(&mut self) {
        let order = self.step.grid.order();
        if order.len() >= LARGE && self.tally.sub_steps.is_multiple_of(EVERY) && is_scattered(order) {
            self.follow_grid();
        }
    }

    fn follow_grid(&mut self) {
        let StepMemory { grid, cycles, rest, .. } = &mut self.step;
        cycles.find(grid.order());
        self.agents.permute(cycles);
        grid.rows_are_in_order();
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
