//! A list for every row, flat.

use crate::parallel::{self, WORD, Words};

/// A list of numbers for every row: flat in parts that threads fill each on its own, with memory of its own.
#[derive(Clone, Debug, Default)]
pub(super) struct Lists<S = ()> {
    parts: Vec<Part>,
    scratch: Vec<S>,
}

#[derive(Clone, Debug)]
struct Part {
    /// Where the list of each row starts, and where the last one ends.
    starts: [u32; WORD + 1],
    items: Vec<u32>,
    /// Rows whose lists are not empty, a bit each.
    some: u64,
}

/// Items that there is room for from the start, in a part: most lists are short.
const ROOM: usize = 3 * WORD;

impl<S: Default + Send> Lists<S> {
    /// Makes the lists anew of all parts that are not to be kept: `list(scratch, row, items)` adds the items of a row and
    /// leaves alone what is there.
    pub fn fill(
        &mut self,
        rows: usize,
        keep: impl Fn(usize) -> bool + Sync,
        list: impl Fn(&mut S, usize, &mut Vec<u32>) + Sync,
    ) {
        let empty = || Part { starts: [0; WORD + 1], items: Vec::with_capacity(ROOM), some: 0 };
        self.parts.resize_with(rows.div_ceil(WORD), empty);
        parallel::ranges_with(Words(&mut self.parts), &mut self.scratch, |scratch, part_rows, Words(parts)| {
            for (first, Part { starts, items, some }) in part_rows.step_by(WORD).zip(parts) {
                if keep(first / WORD) {
                    continue;
                }
                items.clear();
                *some = 0;
                for (at, end) in starts[1..].iter_mut().enumerate() {
                    let (row, start) = (first + at, items.len());
                    if row < rows {
                        list(scratch, row, items);
                    }
                    *some |= u64::from(items.len() > start) << at;
                    *end = items.len() as u32;
                }
            }
        });
    }

    /// Adds items to the lists of rows, sorted by row, and sorts these lists.
    pub fn add(&mut self, told: &[(u32, u32)], rank: impl Fn(u32) -> u32) {
        let part_of = |row: u32| row as usize / WORD;
        for mut told in told.chunk_by(|a, b| part_of(a.0) == part_of(b.0)) {
            let part = &mut self.parts[part_of(told[0].0)];
            let mut items = Vec::with_capacity(part.items.len() + told.len());
            let mut from = 0;
            for (at, end) in part.starts[1..].iter_mut().enumerate() {
                let start = items.len();
                items.extend(&part.items[from..*end as usize]);
                let (own, others) = told.split_at(told.partition_point(|&(row, _)| row as usize % WORD <= at));
                told = others;
                items.extend(own.iter().map(|&(_, item)| item));
                items[start..].sort_unstable_by_key(|&item| rank(item));
                part.some |= u64::from(items.len() > start) << at;
                from = *end as usize;
                *end = items.len() as u32;
            }
            part.items = items;
        }
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
        let Some(part) = self.parts.get(row / WORD) else { return &[] };
        &part.items[part.starts[row % WORD] as usize..part.starts[row % WORD + 1] as usize]
    }
}
