//! The lists of the nearest neighbours.

use crate::parallel::WORD;
use crate::simd::ones;

/// The nearest neighbours of all agents.
#[derive(Clone, Debug, Default)]
pub(crate) struct Neighbours {
    /// For each row the number of its neighbours, then space for as many as any agent may have; in the order of the
    /// grid.
    pub(super) lists: Vec<u32>,
    /// How many of the neighbours may come close enough to be measured, in the order of the grid.
    pub(super) close: Vec<u16>,
    most: usize,
    /// Index of the list of each row.
    places: Vec<u32>,
}

impl Neighbours {
    /// Makes room for `most` neighbours of each row. `places` are the indices of the rows in the order of the grid.
    pub(super) fn resize(&mut self, places: &[u32], most: usize) {
        self.most = most;
        self.lists.resize(places.len() * (most + 1), 0);
        self.close.resize(places.len(), 0);
        self.places.clear();
        self.places.extend_from_slice(places);
    }

    /// Empties the lists of some rows.
    pub(super) fn forget(&mut self, rows: std::ops::Range<usize>) {
        for &place in &self.places[rows] {
            self.lists[place as usize * (self.most + 1)] = 0;
            self.close[place as usize] = 0;
        }
    }

    /// Empties the lists of all rows, for places in the order of the grid.
    pub(super) fn empty(&mut self, places: &[u32]) {
        self.lists.clear();
        self.close.clear();
        self.resize(places, 0);
    }

    /// Empties the lists of all rows, which are in no grid.
    pub(super) fn clear(&mut self, rows: usize) {
        self.most = 0;
        self.lists.clear();
        self.lists.resize(1, 0);
        self.close.clear();
        self.places.clear();
        self.places.resize(rows, 0);
    }

    /// Returns rows with neighbours that may come close enough to be measured, each with these neighbours, nearest
    /// first. Covers the 64 indices from `first` on in the order of the grid, or fewer at the end.
    pub fn close_from<'a>(&'a self, order: &'a [u32], first: usize) -> impl Iterator<Item = (u32, &'a [u32])> {
        let counts = self.close[first.min(self.close.len())..].iter().take(WORD);
        let bits = counts.rev().fold(0, |bits, &close| bits << 1 | u64::from(close != 0));
        // their number is known without reading the list
        let list = |place: usize| &self.lists[place * (self.most + 1) + 1..][..self.close[place].into()];
        ones(bits).map(move |at| (order[first + at], list(first + at)))
    }

    /// Returns the rows of the neighbours of a row, nearest first.
    #[inline]
    pub fn of(&self, row: usize) -> &[u32] {
        self.at(self.places[row] as usize)
    }

    /// Returns the rows of the neighbours of the agent at an index in the order of the grid, nearest first.
    #[inline]
    pub fn at(&self, place: usize) -> &[u32] {
        let list = &self.lists[place * (self.most + 1)..];
        &list[1..=list[0] as usize]
    }

    /// Returns the index of each row in the order of the grid.
    pub fn places(&self) -> &[u32] {
        &self.places
    }
}
