//! The order of rows: agents that are near on the ground are to be near in memory.

use super::Perceive;
use crate::sleep::SleepBlocks;
use crate::world::State;

/// Number of agents from which on sorting the rows pays. The data of fewer agents fits into the caches in any order.
const LARGE: usize = 2048;
/// Sub-steps between two checks.
const EVERY: u64 = 16;
/// Distance of two rows, consecutive in the grid, beyond which the processor does not prefetch; and the part of such
/// pairs (one in `PART`) from which on the rows are sorted.
const FAR: u32 = 64;
const PART: usize = 8;

impl Perceive {
    /// Sorts the rows by their position on the ground, strip by strip.
    pub fn sort_rows(&mut self, state: &mut State, sleep: &mut SleepBlocks) {
        state.note_groups();
        self.rebuild_grid(state);
        self.put_in_order(state, sleep, false);
    }

    /// As [`sort_rows`](Self::sort_rows), from time to time, if it pays, for a world of a division that has no ghosts yet.
    pub fn sort_rows_of_part(&mut self, state: &mut State, sleep: &mut SleepBlocks) {
        if state.others.are_there && state.agents.len() >= LARGE && state.steps.is_multiple_of(EVERY) {
            state.note_groups();
            self.rebuild_grid(state);
            if is_scattered(self.grid.order()) {
                self.put_in_order(state, sleep, false);
            }
        }
    }

    /// As [`sort_rows`](Self::sort_rows), for a grid or lattice that is up to date, if it pays.
    pub(super) fn sort_rows_if_scattered(&mut self, state: &mut State, sleep: &mut SleepBlocks) {
        self.is_sorted = false;
        if state.others.are_there {
            // ghosts stay behind
            return;
        }
        let in_lattice = state.none_counts_the_nearest();
        if in_lattice && !state.any_looks_at_all() {
            // without a neighbour search the neighbours are unknown
            return;
        }
        let order = if in_lattice { self.lattice.order() } else { self.grid.order() };
        if order.len() >= LARGE && state.tally.sub_steps.is_multiple_of(EVERY) && is_scattered(order) {
            self.put_in_order(state, sleep, in_lattice);
        }
    }

    /// Sorts the rows into the order of the grid, or of the lattice.
    fn put_in_order(&mut self, state: &mut State, sleep: &mut SleepBlocks, in_lattice: bool) {
        let Self { grid, lattice, cycles, is_sorted, .. } = self;
        cycles.find(if in_lattice { lattice.order() } else { grid.order() });
        state.agents.permute(cycles);
        *is_sorted = true;
        if in_lattice {
            lattice.rows_are_in_order();
        } else {
            grid.rows_are_in_order();
        }
        sleep.end();
        for (&slot, row) in state.agents.slot.iter().zip(0..) {
            state.slots.rows[slot as usize] = row;
        }
    }
}

fn is_scattered(order: &[u32]) -> bool {
    let jumps = order.windows(2).filter(|pair| pair[0].abs_diff(pair[1]) > FAR).count();
    jumps > order.len() / PART
}
