//! Lists of numbers for rows, in flat memory.

use crate::parallel::{self, WORD, Words};

/// A list of numbers for every row. The rows are divided into parts of 64. Threads fill the parts independently, each
/// with its own scratch memory.
#[derive(Clone, Debug, Default)]
pub(super) struct ContactLists<S = ()> {
    parts: Vec<ListPart>,
    scratch: Vec<S>,
}

#[derive(Clone, Debug)]
struct ListPart {
    /// Start of each row's list, and the end of the last list.
    starts: [u32; WORD + 1],
    items: Vec<u32>,
    /// Rows with a list that is not empty, one bit per row.
    some: u64,
    /// Marked rows, one bit per row.
    marked: u64,
}

/// Initial capacity for the items of a part. Most lists are short.
const ROOM: usize = 3 * WORD;

impl<S: Default + Send> ContactLists<S> {
    /// Rebuilds the lists of all parts for which `keep` returns false. `list(scratch, row, items)` appends the items of
    /// a row and must not change what is there. It returns whether the row is marked.
    pub fn fill(
        &mut self,
        rows: usize,
        keep: impl Fn(usize) -> bool + Sync,
        list: impl Fn(&mut S, usize, &mut Vec<u32>) -> bool + Sync,
    ) {
        let empty = || ListPart { starts: [0; WORD + 1], items: Vec::with_capacity(ROOM), some: 0, marked: 0 };
        self.parts.resize_with(rows.div_ceil(WORD), empty);
        parallel::ranges_with(Words(&mut self.parts), &mut self.scratch, |scratch, part_rows, Words(parts)| {
            for (first, ListPart { starts, items, some, marked }) in part_rows.step_by(WORD).zip(parts) {
                if keep(first / WORD) {
                    continue;
                }
                items.clear();
                (*some, *marked) = (0, 0);
                for (at, end) in starts[1..].iter_mut().enumerate() {
                    let (row, start) = (first + at, items.len());
                    if row < rows {
                        *marked |= u64::from(list(scratch, row, items)) << at;
                    }
                    *some |= u64::from(items.len() > start) << at;
                    *end = items.len() as u32;
                }
            }
        });
    }

    /// Adds items to the lists of rows and sorts these lists by `rank`. The pairs (row, item) must be sorted by row.
    pub fn add(&mut self, added: &[(u32, u32)], rank: impl Fn(u32) -> u32) {
        let part_of = |row: u32| row as usize / WORD;
        for mut added in added.chunk_by(|a, b| part_of(a.0) == part_of(b.0)) {
            let part = &mut self.parts[part_of(added[0].0)];
            let mut items = Vec::with_capacity(part.items.len() + added.len());
            let mut from = 0;
            for (at, end) in part.starts[1..].iter_mut().enumerate() {
                let start = items.len();
                items.extend(&part.items[from..*end as usize]);
                let (own, others) = added.split_at(added.partition_point(|&(row, _)| row as usize % WORD <= at));
                added = others;
                items.extend(own.iter().map(|&(_, item)| item));
                items[start..].sort_unstable_by_key(|&item| rank(item));
                part.some |= u64::from(items.len() > start) << at;
                from = *end as usize;
                *end = items.len() as u32;
            }
            part.items = items;
        }
    }

    /// Removes all lists.
    pub fn clear(&mut self) {
        self.parts.clear();
    }

    /// Returns the rows of a part with a list that is not empty, one bit per row.
    pub fn some(&self, part: usize) -> u64 {
        self.parts.get(part).map_or(0, |part| part.some)
    }

    /// Whether any row is marked.
    pub fn any_marked(&self) -> bool {
        self.parts.iter().any(|part| part.marked != 0)
    }

    /// Whether a row is marked.
    pub fn is_marked(&self, row: usize) -> bool {
        self.parts[row / WORD].marked >> (row % WORD) & 1 == 1
    }

    /// Returns the list of a row; empty if there are no lists.
    #[inline]
    pub fn of(&self, row: usize) -> &[u32] {
        let Some(part) = self.parts.get(row / WORD) else { return &[] };
        &part.items[part.starts[row % WORD] as usize..part.starts[row % WORD + 1] as usize]
    }
}

/// Items reported to rows: pairs (row, item).
#[derive(Clone, Debug, Default)]
pub(super) struct Reports {
    /// The pairs, sorted.
    pairs: Vec<(u32, u32)>,
    /// For each part of 64 rows the index of its first pair.
    starts: Vec<u32>,
    scratch: Vec<Vec<(u32, u32)>>,
}

impl Reports {
    /// Replaces the pairs by those that `report(first, pairs)` adds for every 64 of `count` sources, from `first` on.
    pub fn collect(&mut self, count: usize, report: impl Fn(usize, &mut Vec<(u32, u32)>) + Sync) {
        let Self { pairs, starts, scratch } = self;
        pairs.clear();
        starts.clear();
        scratch.iter_mut().for_each(Vec::clear);
        if count == 0 {
            return;
        }
        // the division needs a column; this has no memory
        parallel::ranges_with(&mut vec![(); count][..], scratch, |found, sources, _| {
            sources.step_by(WORD).for_each(|first| report(first, found));
        });
        pairs.extend(scratch.iter().flatten());
        pairs.sort_unstable();
        for (at, &(row, _)) in (0..).zip(&*pairs) {
            starts.resize(starts.len().max(row as usize / WORD + 1), at);
        }
        starts.push(pairs.len() as u32);
    }

    /// Removes all pairs.
    pub fn clear(&mut self) {
        self.pairs.clear();
        self.starts.clear();
    }

    /// Returns all pairs, sorted.
    pub fn all(&self) -> &[(u32, u32)] {
        &self.pairs
    }

    /// Returns the pairs of a row, sorted.
    #[inline]
    pub fn to(&self, row: usize) -> &[(u32, u32)] {
        let Some(&[start, end, ..]) = self.starts.get(row / WORD..) else { return &[] };
        if start == end {
            return &[];
        }
        let part = &self.pairs[start as usize..end as usize];
        let of_row = |before: usize| part.partition_point(|&(of, _)| (of as usize) < before);
        &part[of_row(row)..of_row(row + 1)]
    }
}
