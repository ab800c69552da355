//! Permutation of rows in place.

/// A permutation as its cycles: each row of a cycle takes the content of the next one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cycles {
    /// The rows of the cycles of more than one row, cycle by cycle.
    rows: Vec<u32>,
    /// End of each cycle.
    ends: Vec<u32>,
    /// Rows that have been found in a cycle, one bit each.
    seen: Vec<u64>,
}

impl Cycles {
    /// Finds the cycles that move the content of row `order[k]` to row `k`.
    pub fn find(&mut self, order: &[u32]) {
        let Self { rows, ends, seen } = self;
        rows.clear();
        ends.clear();
        seen.clear();
        seen.resize(order.len().div_ceil(64), 0);
        for start in (0u32..).take(order.len()) {
            let (first, mut row) = (rows.len(), start);
            while seen[row as usize / 64] >> (row % 64) & 1 == 0 {
                seen[row as usize / 64] |= 1 << (row % 64);
                rows.push(row);
                row = order[row as usize];
            }
            if rows.len() - first > 1 {
                ends.push(rows.len() as u32);
            } else {
                rows.truncate(first);
            }
        }
    }

    /// Moves the contents of the rows.
    pub fn turn<T>(&self, all: &mut [T]) {
        self.swaps(|a, b| all.swap(a, b));
    }

    /// Calls `swap` for pairs of rows. The swaps, one after the other, make the permutation.
    pub fn swaps(&self, mut swap: impl FnMut(usize, usize)) {
        let mut start = 0;
        for &end in &self.ends {
            for pair in self.rows[start..end as usize].windows(2) {
                swap(pair[0] as usize, pair[1] as usize);
            }
            start = end as usize;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rows_come_to_where_the_order_says(order in (0u32..200).prop_flat_map(|n| Just((0..n).collect::<Vec<_>>()).prop_shuffle())) {
            let mut all: Vec<String> = (0..order.len()).map(|row| row.to_string()).collect();
            let moved: Vec<String> = order.iter().map(|&row| all[row as usize].clone()).collect();
            let mut cycles = Cycles::default();
            cycles.find(&(0..300).rev().collect::<Vec<_>>());
            cycles.find(&order);
            cycles.turn(&mut all);
            prop_assert_eq!(all, moved);
        }
    }
}
