//! A list for every row, flat.

use crate::parallel;

/// Rows in a part: a bit of a word each.
pub(super) const ROWS: usize = u64::BITS as usize;

/// A list of numbers for every row: flat in parts that threads fill each on its own, with memory of its own.
#[derive(Clone, Debug, Default)]
pub(super) struct Lists<S = ()> {
    parts: Vec<Part<S>>,
}

#[derive(Clone, Debug)]
struct Part<S> {
    /// Where the list of each row starts, and where the last one ends.
    starts: [u32; ROWS + 1],
    items: Vec<u32>,
    /// Rows whose lists are not empty, a bit each.
    some: u64,
    scratch: S,
}

impl<S: Default + Send> Lists<S> {
    /// Makes all lists anew: `list(scratch, row, items)` adds the items of a row and leaves alone what is there.
    pub fn fill(&mut self, rows: usize, list: impl Fn(&mut S, usize, &mut Vec<u32>) + Sync) {
        let empty = || Part { starts: [0; ROWS + 1], items: Vec::new(), some: 0, scratch: S::default() };
        self.parts.resize_with(rows.div_ceil(ROWS), empty);
        parallel::parts(&mut self.parts, rows, |part, Part { starts, items, some, scratch }| {
            items.clear();
            *some = 0;
            for (at, end) in starts[1..].iter_mut().enumerate() {
                let (row, start) = (part * ROWS + at, items.len());
                if row < rows {
                    list(scratch, row, items);
                }
                *some |= u64::from(items.len() > start) << at;
                *end = items.len() as u32;
            }
        });
    }

    /// Leaves nobody a list.
    pub fn clear(&mut self) {
        self.parts.clear();
    }

    /// The rows of a part whose lists are not empty, a bit each.
    pub fn some(&self, part: usize) -> u64 {
        self.parts.get(part).map_or(0, |part| part.some)
    }

    /// The list of a row; empty if there are none.
    #[inline]
    pub fn of(&self, row: usize) -> &[u32] {
        let Some(part) = self.parts.get(row / ROWS) else { return &[] };
        &part.items[part.starts[row % ROWS] as usize..part.starts[row % ROWS + 1] as usize]
    }
}
