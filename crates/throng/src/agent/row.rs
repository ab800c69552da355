//! Copies of single rows, for every kind of column.

use super::{Column, ColumnValue, Memory};

/// A column of which single values can be copied.
pub(crate) trait RowColumn {
    /// The value of a row.
    type Value;
    /// Returns a copy of the value of a row.
    fn value(&self, row: usize) -> Self::Value;
    /// Adds a row with this value.
    fn push_value(&mut self, value: Self::Value);
}

impl<T: Clone> RowColumn for Vec<T> {
    type Value = T;

    fn value(&self, row: usize) -> T {
        self[row].clone()
    }

    fn push_value(&mut self, value: T) {
        self.push(value);
    }
}

impl<T: ColumnValue> RowColumn for Column<T> {
    type Value = T;

    fn value(&self, row: usize) -> T {
        self[row]
    }

    fn push_value(&mut self, value: T) {
        self.push(value);
    }
}

impl RowColumn for Memory {
    type Value = Vec<f32>;

    fn value(&self, row: usize) -> Vec<f32> {
        self.of(row).to_vec()
    }

    fn push_value(&mut self, words: Vec<f32>) {
        self.push();
        let row = self.len() - 1;
        self.lists().all[row * words.len()..].copy_from_slice(&words);
    }
}
