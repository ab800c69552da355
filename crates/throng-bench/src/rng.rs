//! Random points.

use glam::{DVec2, DVec3};
use throng::random::SplitMix64;

/// A random number generator for workloads.
#[derive(Clone, Debug)]
pub struct Dice(SplitMix64);

impl Dice {
    /// Returns the generator of a seed.
    pub fn new(seed: u64) -> Self {
        Self(SplitMix64(seed))
    }

    /// Returns the next number from `low` up to but without `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0.between(low, high)
    }

    /// Returns the next whole number below `count`, which is at least 1.
    pub fn below(&mut self, count: usize) -> usize {
        self.0.below(count)
    }

    /// Returns the next point of a disc around the origin.
    pub fn in_disc(&mut self, radius: f64) -> DVec2 {
        loop {
            let p = DVec2::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0));
            if p.length_squared() <= 1.0 {
                return p * radius;
            }
        }
    }

    /// Returns the next point of a ball around the origin.
    pub fn in_sphere(&mut self, radius: f64) -> DVec3 {
        loop {
            let p = DVec3::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0));
            if p.length_squared() <= 1.0 {
                return p * radius;
            }
        }
    }
}
