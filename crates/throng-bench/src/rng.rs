//! Random numbers that are the same on all machines.

use glam::{DVec2, DVec3};

/// A small pseudorandom number generator (SplitMix64: Steele, Lea, Flood, OOPSLA 2014), from a seed.
#[derive(Clone, Debug)]
pub struct Dice(pub u64);

impl Dice {
    /// Returns the next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Returns the next number from `low` up to but without `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// Returns the next whole number below `count`, which is at least 1.
    pub fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
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
