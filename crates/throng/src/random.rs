//! Random numbers without state: each is a hash of what it is for.
//!
//! The key is (seed, agent's number, step, purpose), so a draw depends neither on the order of agents nor on what
//! else was drawn. The mixing function is the finaliser of SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).

/// What a number is drawn for. Two purposes never share a number.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Purpose {
    DetourAngle = 1,
    DetourTime,
    DetourSide,
    Coincident,
    CandidateAcross,
    CandidateAlong,
}

fn mix(mut z: u64) -> u64 {
    z = z.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// 64 random bits.
pub(crate) fn bits(seed: u64, number: u32, step: u64, purpose: Purpose) -> u64 {
    mix(mix(mix(seed ^ 0x7468_726f_6e67).wrapping_add(step)).wrapping_add((u64::from(number) << 8) | purpose as u64))
}

/// A number in [0, 1).
pub(crate) fn unit(seed: u64, number: u32, step: u64, purpose: Purpose) -> f32 {
    (bits(seed, number, step, purpose) >> 40) as f32 * (1.0 / 16_777_216.0)
}

/// Who draws random numbers, and when: what they depend on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dice {
    /// The world's seed.
    pub seed: u64,
    /// The agent's number.
    pub number: u32,
    /// Sub-steps made so far.
    pub step: u64,
}

impl Dice {
    /// A number in [low, high).
    pub(crate) fn between(self, (low, high): (f32, f32), purpose: Purpose) -> f32 {
        low + (high - low) * unit(self.seed, self.number, self.step, purpose)
    }

    /// The `k`-th of many numbers in [0, 1) for one purpose.
    pub(crate) fn nth(self, k: u32, purpose: Purpose) -> f32 {
        let seed = mix(self.seed.wrapping_add(u64::from(k) << 32));
        unit(seed, self.number, self.step, purpose)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_fill_the_unit_interval_evenly() {
        let mut bins = [0u32; 16];
        for number in 0..4_000 {
            for step in 0..4 {
                bins[(unit(7, number, step, Purpose::Coincident) * 16.0) as usize] += 1;
            }
        }
        // 1000 expected in each, standard deviation 31
        assert!(bins.iter().all(|&n| (870..1130).contains(&n)), "{bins:?}");
    }

    #[test]
    fn every_part_of_the_key_matters() {
        let draw = bits(1, 2, 3, Purpose::Coincident);
        assert_ne!(draw, bits(2, 2, 3, Purpose::Coincident));
        assert_ne!(draw, bits(1, 3, 3, Purpose::Coincident));
        assert_ne!(draw, bits(1, 2, 4, Purpose::Coincident));
        assert_ne!(draw, bits(1, 2, 3, Purpose::DetourAngle));
    }
}
