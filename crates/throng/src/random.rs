//! Random numbers that are the same on all machines.
//!
//! The numbers of a world are counter-based: each is a hash of its key (seed, agent's number, step, purpose), so a draw
//! depends neither on the order of the agents nor on other draws. [`mix`] is the hash, [`SplitMix64`] the sequence.

use glam::DVec2;

/// The purpose of a random number. Two purposes never share a number.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Purpose {
    /// The choices of an agent.
    Whim = 1,
    /// The direction in which two agents at the same position part.
    Coincident = 4,
    /// Candidate velocities, across.
    CandidateAcross,
    /// Candidate velocities, along.
    CandidateAlong,
    /// The draws of a behaviour: [`Rng::draw`].
    Behaviour,
    /// Noise along time.
    Noise,
    /// The draws of rules.
    Rules,
    /// Noise in space: the seeds of a field.
    Eddies,
}

/// The increment of the state of [`SplitMix64`].
const GAMMA: u64 = 0x9e37_79b9_7f4a_7c15;

/// Returns the mixed bits of a number: the output of [`SplitMix64`] in this state (Steele, Lea, Flood, OOPSLA 2014).
///
/// ```
/// assert_eq!(throng::random::mix(0), 0xe220_a839_7b1d_cdaf);
/// ```
#[inline]
pub fn mix(z: u64) -> u64 {
    let z = z.wrapping_add(GAMMA);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A sequence of random numbers from a seed, for workloads and tests (Steele, Lea, Flood, OOPSLA 2014).
///
/// ```
/// use throng::random::SplitMix64;
/// let mut rng = SplitMix64(7);
/// assert_eq!([rng.bits(), SplitMix64(7).bits()], [throng::random::mix(7); 2]);
/// assert!((2.0..3.0).contains(&rng.between(2.0, 3.0)) && rng.below(4) < 4);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SplitMix64(
    /// The state: the seed at first.
    pub u64,
);

impl SplitMix64 {
    /// Returns the next 64 bits.
    pub fn bits(&mut self) -> u64 {
        let bits = mix(self.0);
        self.0 = self.0.wrapping_add(GAMMA);
        bits
    }

    /// Returns the next number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns the next number from `low` up to but without `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Returns the next point of the box between two corners.
    pub fn point(&mut self, low: DVec2, high: DVec2) -> DVec2 {
        DVec2::new(self.between(low.x, high.x), self.between(low.y, high.y))
    }

    /// Returns the next whole number below `count`; 0 for a count of 0.
    pub fn below(&mut self, count: usize) -> usize {
        (self.bits() % count.max(1) as u64) as usize
    }
}

/// Returns the 64 random bits of a key: seed, agent's number, step, purpose.
#[inline]
pub fn bits(seed: u64, number: u32, step: u64, purpose: Purpose) -> u64 {
    mix(mix(mix(seed ^ 0x7468_726f_6e67).wrapping_add(step)).wrapping_add((u64::from(number) << 8) | purpose as u64))
}

/// Returns a number in [0, 1).
#[inline]
pub(crate) fn unit(seed: u64, number: u32, step: u64, purpose: Purpose) -> f32 {
    (bits(seed, number, step, purpose) >> 40) as f32 * (1.0 / 16_777_216.0)
}

/// A counter-based random number generator: its numbers depend only on these fields and on the index of the draw.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rng {
    /// The world's seed.
    pub seed: u64,
    /// The agent's number.
    pub number: u32,
    /// Sub-steps made so far.
    pub step: u64,
}

impl Rng {
    /// Returns the `k`-th number in [0, 1) of a [behaviour](crate::steer) in this step.
    #[inline]
    pub fn draw(self, k: u32) -> f32 {
        self.nth(k, Purpose::Behaviour)
    }

    /// Returns a normally distributed number of mean 0 and variance 1 (Box and Muller 1958). It uses the draws `2 k`
    /// and `2 k + 1`.
    pub fn normal(self, k: u32) -> f32 {
        let radius = libm::sqrtf(-2.0 * libm::logf(1.0 - self.draw(2 * k)));
        radius * libm::cosf(std::f32::consts::TAU * self.draw(2 * k + 1))
    }

    /// Returns the generator of the `index`-th part of a composite behaviour: its numbers are independent of the
    /// numbers of other parts.
    #[inline]
    pub fn branch(self, index: usize) -> Self {
        Self { seed: mix(self.seed.wrapping_add(1 + index as u64)), ..self }
    }

    /// Returns the generator of another step.
    #[inline]
    pub fn at(self, step: u64) -> Self {
        Self { step, ..self }
    }

    /// Returns the `k`-th number in [0, 1) for a purpose.
    #[inline]
    pub fn nth(self, k: u32, purpose: Purpose) -> f32 {
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
    fn normal_draws_have_the_moments_of_their_distribution() {
        let draws: Vec<f64> = (0..20_000).map(|number| f64::from(Rng { number, ..Rng::default() }.normal(3))).collect();
        let moment = |power: i32| draws.iter().map(|x| x.powi(power)).sum::<f64>() / draws.len() as f64;
        // standard deviations of these means: 0.007, 0.01, 0.03, 0.07
        for (power, expected, most) in [(1, 0.0, 0.03), (2, 1.0, 0.04), (3, 0.0, 0.12), (4, 3.0, 0.28)] {
            assert!((moment(power) - expected).abs() < most, "{power}: {}", moment(power));
        }
    }

    #[test]
    fn parts_draw_independent_numbers() {
        let rng = Rng { seed: 1, number: 2, step: 3 };
        let all = [rng, rng.branch(0), rng.branch(1), rng.branch(0).branch(1), rng.branch(1).branch(0), rng.at(4)];
        let mut draws: Vec<f32> = all.iter().flat_map(|rng| [rng.draw(0), rng.draw(1)]).collect();
        draws.sort_by(f32::total_cmp);
        draws.dedup();
        assert_eq!(draws.len(), 12);
    }

    #[test]
    fn every_part_of_the_key_matters() {
        let draw = bits(1, 2, 3, Purpose::Coincident);
        assert_ne!(draw, bits(2, 2, 3, Purpose::Coincident));
        assert_ne!(draw, bits(1, 3, 3, Purpose::Coincident));
        assert_ne!(draw, bits(1, 2, 4, Purpose::Coincident));
        assert_ne!(draw, bits(1, 2, 3, Purpose::Noise));
    }
}
