//! Noise along time: Perlin's, in octaves.
//!
//! Perlin, An image synthesizer, SIGGRAPH 1985: random slopes at the whole numbers, smooth between them. An octave has
//! twice the frequency of the octave before it. Each agent and each behaviour has independent noise.

use throng::parameters::parameters;
use throng::random::{Purpose, Rng};

/// Perlin noise: a value that changes randomly over time, between -1 and 1.
///
/// ```
/// use throng_steer::Noise;
/// let gentle = Noise { period: 3.0, octaves: 1, ..Noise::default() };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Seconds from one random slope to the next, of the slowest octave.
    #[parameter(default = 2.0, unit = "s", above = 0)]
    pub period: f32,
    /// Number of octaves.
    #[parameter(default = 3, least = 1, most = 8)]
    pub octaves: u32,
    /// Amplitude of each octave relative to the one before.
    #[parameter(default = 0.5, least = 0, most = 1)]
    pub gain: f32,
    /// Whether the noise is turbulence, with creases where it turns.
    ///
    /// The absolute values of the octaves are added, less their mean (Perlin 1985). The result is seldom far below zero
    /// and now and then far above it.
    pub turbulent: bool,
}

impl Noise {
    /// Returns the `k`-th value at a time, seconds, for the agent and the behaviour that this random number generator
    /// belongs to.
    pub fn at(&self, time: f64, k: u32, rng: Rng) -> f32 {
        let (mut sum, mut most, mut amount) = (0.0, 0.0, 1.0);
        let mut frequency = 1.0 / f64::from(self.period);
        for octave in 0..self.octaves {
            let draw = |step: u64| rng.at(step).nth(8 * k + octave, Purpose::Noise);
            // the offset puts the zeros of the octaves at different times
            let wave = perlin(time * frequency + f64::from(draw(u64::MAX)), draw);
            sum += amount * if self.turbulent { (wave.abs() - MEAN) / (1.0 - MEAN) } else { wave };
            most += amount;
            amount *= self.gain;
            frequency *= 2.0;
        }
        sum / most
    }
}

/// The mean absolute value of an octave: the integral of `(most / 2 + least² / (6 most))` over a cell, where most and
/// least are the greater and the smaller of the greatest shares of the two slopes there.
const MEAN: f32 = 0.210_453;

/// Returns one octave, between -1 and 1, from numbers drawn for each whole number.
fn perlin(x: f64, draw: impl Fn(u64) -> f32) -> f32 {
    let start = x.floor();
    let (cell, part) = (start as i64 as u64, (x - start) as f32);
    let slope = |cell: u64| 2.0 * draw(cell) - 1.0;
    let (from, to) = (slope(cell) * part, slope(cell.wrapping_add(1)) * (part - 1.0));
    let fade = part * part * part * (part * (part * 6.0 - 15.0) + 10.0);
    2.0 * (from + (to - from) * fade)
}

#[cfg(test)]
mod tests {
    use super::*;

    const DICE: Rng = Rng { seed: 5, number: 6, step: 7 };

    fn values(noise: Noise, step: f64) -> Vec<f32> {
        (0..20_000).map(|i| noise.at(f64::from(i) * step, 0, DICE)).collect()
    }

    #[test]
    fn it_fills_its_range_evenly_about_zero() {
        for turbulent in [false, true] {
            let all = values(Noise { turbulent, ..Noise::default() }, 0.37);
            assert!(all.iter().all(|value| (-1.0..=1.0).contains(value)));
            let mean = all.iter().sum::<f32>() / all.len() as f32;
            assert!(mean.abs() < 0.01, "{mean}");
            assert!(all.iter().any(|&value| value > 0.4));
            assert!(all.iter().any(|&value| value < if turbulent { -0.2 } else { -0.4 }));
        }
    }

    #[test]
    fn it_is_smooth_and_octaves_have_details() {
        let most = |noise| values(noise, 0.002).windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f32::max);
        let (smooth, fine) = (most(Noise { octaves: 1, ..Noise::default() }), most(Noise::default()));
        assert!(smooth < 0.006 && fine > smooth, "{smooth} {fine}");
    }

    #[test]
    fn each_has_its_own() {
        let at = |k, rng| Noise::default().at(12.3, k, rng);
        assert_ne!(at(0, DICE), at(1, DICE));
        assert_ne!(at(0, DICE), at(0, DICE.branch(0)));
        assert_eq!(at(0, DICE), at(0, DICE.at(8)), "the step does not matter, time does");
    }
}
