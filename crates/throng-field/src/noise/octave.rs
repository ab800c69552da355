//! Octaves: noise of one size, and the combination of octaves to turbulence.

use throng::Error;

/// Maximum number of octaves of a field.
const MOST: usize = 16;

/// Noise of one size: eddies about a length wide that last about a period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Octave {
    /// Width of the eddies, metres: velocities farther apart than 1.42 times the length are independent. Limit: > 0.
    pub length: f32,
    /// Lifetime of the eddies, seconds: velocities farther apart in time than 1.42 times the period are independent.
    /// Infinite: the noise does not change. Limit: > 0.
    pub period: f32,
    /// Root mean square of the velocity, m/s, over all places and times. Limit: >= 0.
    pub speed: f32,
}

impl Octave {
    /// Returns octaves for turbulence: each half as long as the one before, from this length and period on, with this
    /// total speed, m/s.
    ///
    /// Speeds are proportional to the lengths to the power of 1/3 and periods to the power of 2/3 (Kolmogorov 1941), so
    /// potentials are proportional to the power of 4/3: Bridson, Hourihan, Nordenstam, *Curl-noise for procedural fluid
    /// flow*, SIGGRAPH 2007.
    ///
    /// ```
    /// use throng_field::Octave;
    /// let all = Octave::turbulence(0.8, 1.0, 0.5, 4)?;
    /// assert_eq!(all[3].length, 0.1);
    /// assert!((all[3].period - 0.25).abs() < 1e-6 && (all[0].speed - 2.0 * all[3].speed).abs() < 1e-6);
    /// assert!((all.iter().map(|octave| octave.speed * octave.speed).sum::<f32>() - 0.25).abs() < 1e-6);
    /// # Ok::<(), throng::Error>(())
    /// ```
    ///
    /// # Errors
    /// No octaves or more than 16; an octave out of its limits.
    pub fn turbulence(length: f32, period: f32, speed: f32, octaves: usize) -> Result<Vec<Self>, Error> {
        check_count(octaves)?;
        let third = |k: usize| libm::exp2f(-(k as f32) / 3.0);
        let squares: f32 = (0..octaves).map(|k| third(k) * third(k)).sum();
        let octave = |k: usize| Self {
            length: length * libm::exp2f(-(k as f32)),
            period: period * third(k) * third(k),
            speed: speed * third(k) / squares.sqrt(),
        };
        let all: Vec<Self> = (0..octaves).map(octave).collect();
        all.iter().try_for_each(Self::check)?;
        Ok(all)
    }

    pub(super) fn check(&self) -> Result<(), Error> {
        Error::unless_positive("the length of an octave", self.length)?;
        Error::unless(self.period > 0.0, "the period of an octave", self.period, "greater than 0")?;
        let is_speed = self.speed >= 0.0 && self.speed.is_finite();
        Error::unless(is_speed, "the speed of an octave", self.speed, "at least 0 and finite")
    }
}

pub(super) fn check_count(octaves: usize) -> Result<(), Error> {
    Error::unless((1..=MOST).contains(&octaves), "the number of octaves", octaves as f64, "from 1 to 16")
}
