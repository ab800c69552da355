//! The random numbers of mutants.

use throng::random::{SplitMix64, mix};

/// A pseudorandom number generator.
#[derive(Clone, Debug)]
pub(crate) struct Rng(SplitMix64);

impl Rng {
    /// Returns the generator of mutant `number` of a seed and a target.
    pub fn of(seed: u64, target: &str, number: u64) -> Self {
        let parts = target.bytes().map(u64::from).chain([number]);
        Self(SplitMix64(parts.fold(seed, |key, part| mix(key) ^ part)))
    }

    /// Returns the next 64 bits.
    pub fn next(&mut self) -> u64 {
        self.0.bits()
    }

    /// Returns a number below `end`; 0 for an `end` of 0.
    pub fn below(&mut self, end: usize) -> usize {
        self.0.below(end)
    }

    /// Returns an entry of a list, which is not empty.
    pub fn pick<'a, T>(&mut self, list: &'a [T]) -> &'a T {
        &list[self.below(list.len())]
    }
}
