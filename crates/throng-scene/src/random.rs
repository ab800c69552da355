//! Counter-based random numbers: each is a function of (seed, group, agent, purpose, count).
//!
//! An agent gets the same numbers on every machine, whatever else the scene contains. The mixing function is applied once
//! per part of the key.

use crate::scene::Number;
use throng::random::{SplitMix64, mix};

/// The purpose of a random number. Draws for one purpose do not shift the draws for another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u64)]
#[allow(missing_docs)]
pub enum Purpose {
    Place = 1,
    Radius = 2,
    PreferredSpeed = 3,
    MaxSpeed = 4,
    Acceleration = 5,
    TurnRate = 6,
    Heading = 7,
    Wait = 8,
    StopWait = 9,
    Choice = 10,
    TrackingError = 11,
    Length = 12,
    Width = 13,
    Altitude = 14,
    StartSpeed = 15,
    Governed = 16,
    TimeGap = 17,
    Goal = 18,
}

/// The random numbers of one agent for one purpose.
#[derive(Clone, Debug)]
pub struct Random(SplitMix64);

impl Random {
    /// Returns the random number generator of this agent for this purpose.
    pub fn new(seed: u64, group: u64, agent: u64, purpose: Purpose) -> Self {
        Self::of_key(seed, &[group, agent, purpose as u64])
    }

    /// Returns the random number generator of this agent for a part of a purpose.
    pub(crate) fn part(seed: u64, group: u64, agent: u64, purpose: Purpose, part: u64) -> Self {
        Self::of_key(seed, &[group, agent, purpose as u64, part])
    }

    fn of_key(seed: u64, parts: &[u64]) -> Self {
        Self(SplitMix64(parts.iter().fold(mix(seed), |key, part| mix(key ^ part))))
    }

    /// Returns the next 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0.bits()
    }

    /// Returns the next number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0.unit()
    }

    /// Returns the next number between two bounds.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0.between(low, high)
    }

    /// Returns the next number of the standard normal distribution (Box and Muller).
    pub fn normal(&mut self) -> f64 {
        let radius = libm::sqrt(-2.0 * libm::log(1.0 - self.unit()));
        radius * libm::cos(core::f64::consts::TAU * self.unit())
    }

    /// Returns the next draw of a [`Number`].
    pub fn draw(&mut self, number: &Number) -> f64 {
        match number {
            Number::Constant(x) => *x,
            Number::Uniform([low, high]) => self.between(*low, *high),
            Number::Normal(normal) => {
                let [min, max] = normal.bounds();
                for _ in 0..1000 {
                    let x = normal.mean + normal.deviation * self.normal();
                    if (min..=max).contains(&x) {
                        return x;
                    }
                }
                // The bounds lie far out in a tail: use the value nearest to the mean.
                normal.mean.clamp(min, max)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Normal;

    #[test]
    fn draws_are_pinned() {
        let mut random = Random::new(1, 2, 3, Purpose::Place);
        let draws = [random.bits(), random.bits()];
        assert_eq!(draws, [0xc51f_eb72_9db6_9d8f, 0xddd1_5123_cf12_72b5]);
        assert_ne!(draws[0], Random::new(1, 3, 2, Purpose::Place).bits());
        assert_ne!(draws[0], Random::new(1, 2, 3, Purpose::Radius).bits());
        assert_ne!(draws[0], Random::new(2, 2, 3, Purpose::Place).bits());
    }

    #[test]
    fn units_are_even_and_normals_are_normal() {
        let n = 20_000;
        let mut random = Random::new(7, 0, 0, Purpose::Place);
        let mean = (0..n).map(|_| random.unit()).sum::<f64>() / f64::from(n);
        assert!((mean - 0.5).abs() < 0.01, "{mean}");
        let normals: Vec<f64> = (0..n).map(|_| random.normal()).collect();
        let mean = normals.iter().sum::<f64>() / f64::from(n);
        let variance = normals.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / f64::from(n);
        assert!(mean.abs() < 0.03 && (variance - 1.0).abs() < 0.04, "{mean} {variance}");
    }

    #[test]
    fn a_normal_stays_in_its_bounds() {
        let number = Number::Normal(Normal { mean: 1.3, deviation: 0.3, min: Some(1.0), max: Some(1.4) });
        let mut random = Random::new(7, 0, 0, Purpose::Radius);
        assert!((0..1000).all(|_| (1.0..=1.4).contains(&random.draw(&number))));
    }
}
