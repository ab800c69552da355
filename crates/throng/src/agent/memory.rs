//! Memory of behaviours: the same number of words for every row.

use super::Cycles;
use crate::parallel::RowLists;
use serde::{Deserialize, Serialize};

/// The memory of the agents' behaviours: the same number of words for every row, possibly 0.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    all: Vec<f32>,
    /// Words for each row.
    each: usize,
    rows: usize,
}

impl Memory {
    /// Returns the number of rows.
    pub fn len(&self) -> usize {
        self.rows
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.rows == 0
    }

    /// Returns the words of a row.
    pub fn of(&self, row: usize) -> &[f32] {
        &self.all[row * self.each..(row + 1) * self.each]
    }

    /// Whether the number of words matches the number of rows.
    pub(crate) fn is_whole(&self) -> bool {
        self.all.len() == self.rows * self.each
    }

    /// Widens each row to at least this number of words. New words are zero.
    pub(crate) fn widen(&mut self, each: usize) {
        if each > self.each {
            let mut wide = vec![0.0; self.rows * each];
            for (row, words) in wide.chunks_exact_mut(each).enumerate() {
                words[..self.each].copy_from_slice(self.of(row));
            }
            (self.all, self.each) = (wide, each);
        }
    }

    /// Sets the words of a row to zero.
    pub(crate) fn forget(&mut self, row: usize) {
        self.all[row * self.each..(row + 1) * self.each].fill(0.0);
    }

    /// Adds a row of zeros.
    pub(crate) fn push(&mut self) {
        self.rows += 1;
        self.all.resize(self.rows * self.each, 0.0);
    }

    /// Reserves memory for more rows.
    pub(crate) fn reserve(&mut self, additional: usize) {
        self.all.reserve(additional * self.each);
    }

    /// Removes a row; the last row takes its place.
    pub(crate) fn swap_remove(&mut self, row: usize) {
        self.rows -= 1;
        let last = self.rows * self.each;
        self.all.copy_within(last..last + self.each, row * self.each);
        self.all.truncate(last);
    }

    /// Removes all rows from this one on.
    pub(crate) fn truncate(&mut self, rows: usize) {
        self.rows = self.rows.min(rows);
        self.all.truncate(self.rows * self.each);
    }

    /// Moves rows along cycles.
    pub(crate) fn permute(&mut self, cycles: &Cycles) {
        let Self { all, each, .. } = self;
        cycles.swaps(|a, b| (0..*each).for_each(|word| all.swap(a * *each + word, b * *each + word)));
    }

    /// Returns the words of all rows, mutable.
    pub(crate) fn lists(&mut self) -> RowLists<'_, f32> {
        RowLists { all: &mut self.all, stride: self.each }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_keep_their_words() {
        let mut words = Memory::default();
        (0..3).for_each(|_| words.push());
        words.widen(2);
        words.lists().all.copy_from_slice(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        let mut cycles = Cycles::default();
        cycles.find(&[2, 0, 1]);
        words.permute(&cycles);
        assert_eq!((words.of(0), words.of(1), words.of(2)), (&[5.0, 6.0][..], &[1.0, 2.0][..], &[3.0, 4.0][..]));
        words.widen(3);
        words.swap_remove(0);
        assert_eq!((words.len(), words.of(0), words.of(1)), (2, &[3.0, 4.0, 0.0][..], &[1.0, 2.0, 0.0][..]));
        words.push();
        assert_eq!(words.of(2), [0.0; 3]);
        assert!(words.is_whole());
    }
}
