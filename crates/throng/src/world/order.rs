//! The order of rows: agents that are near on the ground are to be near in memory.

use super::{StepMemory, World};

/// Number of agents from which on sorting the rows pays. The data of fewer agents fits into the caches in any order.
const LARGE: usize = 2048;
/// Sub-steps between two checks.
const EVERY: u64 = 16;
/// Distance of two rows, consecutive in the grid, beyond which the processor does not prefetch; and the part of such
/// pairs (one in `PART`) from which on the rows are sorted.
const FAR: u32 = 64;
const PART: usize = 8;

impl World {
    /// Sorts the rows of [`agents`](Self::agents) by their position on the ground, strip by strip. Large crowds are
    /// sorted automatically from time to time. It changes speed only, not results.
    pub fn sort_rows(&mut self) {
        self.rebuild_grid();
        self.put_in_order(false);
    }

    /// As [`sort_rows`](Self::sort_rows), for a grid or lattice that is up to date, if it pays.
    pub(super) fn sort_rows_if_scattered(&mut self) {
        let in_lattice = self.state.none_counts_the_nearest();
        if in_lattice && !self.state.any_looks_at_all() {
            // without a neighbour search the neighbours are unknown
            return;
        }
        let order = if in_lattice { self.step.flocks.order() } else { self.step.grid.order() };
        if order.len() >= LARGE && self.state.tally.sub_steps.is_multiple_of(EVERY) && is_scattered(order) {
            self.put_in_order(in_lattice);
        }
    }

    /// Sorts the rows into the order of the grid, or of the lattice.
    fn put_in_order(&mut self, lattice: bool) {
        let StepMemory { grid, flocks, cycles, rest, ahead, .. } = &mut self.step;
        cycles.find(if lattice { flocks.order() } else { grid.order() });
        self.state.agents.permute(cycles);
        if ahead.len() == self.state.agents.len() {
            cycles.turn(ahead);
        }
        if lattice {
            flocks.rows_are_in_order();
        } else {
            grid.rows_are_in_order();
        }
        rest.end();
        for (&slot, row) in self.state.agents.slot.iter().zip(0..) {
            self.state.slots.rows[slot as usize] = row;
        }
    }
}

fn is_scattered(order: &[u32]) -> bool {
    let jumps = order.windows(2).filter(|pair| pair[0].abs_diff(pair[1]) > FAR).count();
    jumps > order.len() / PART
}
