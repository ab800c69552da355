//! Curl noise as files describe it.

use super::{CurlNoise, NoiseWall, Octave, Potential};
use throng::Error;
use throng::parameters::parameters;
use throng::steer::Barriers;

/// Random eddies without sources and sinks (curl noise, Bridson et al. 2007).
///
/// ```
/// use throng_field::{CurlNoise, Noise};
/// let gusts = CurlNoise::try_from(Noise { period: 2.0, ..Noise::new(0.4, 0.6) })?;
/// # Ok::<(), throng::Error>(())
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct Noise {
    /// Width of the eddies, metres.
    #[parameter(required, unit = "m", above = 0)]
    pub length: f32,
    /// Lifetime of the eddies, seconds. Without it, for ever.
    #[parameter(default = f32::INFINITY, infinite, unit = "s", above = 0)]
    pub period: f32,
    /// Root mean square of the speed, m/s.
    #[parameter(required, unit = "m/s", least = 0, most = 1000)]
    pub speed: f32,
    /// Number of octaves, each half as wide as the one before.
    #[parameter(default = 1, least = 1, most = 16)]
    pub octaves: usize,
    /// The potential of the noise.
    pub potential: Potential,
    /// Seed: another seed gives other eddies.
    pub seed: u64,
    /// Surfaces that it flows along: names of surfaces and of obstacles, `"obstacles"`, or `"everything"`. Without it,
    /// nothing.
    pub walls: Barriers,
    /// Distance up to which walls change the flow, metres. Without it, the width of the eddies.
    #[parameter(unit = "m", above = 0)]
    pub width: Option<f32>,
}

impl TryFrom<Noise> for CurlNoise {
    type Error = Error;

    fn try_from(said: Noise) -> Result<Self, Error> {
        let octaves = Octave::turbulence(said.length, said.period, said.speed, said.octaves)?;
        let mut noise = Self::new(said.potential, &octaves, said.seed)?;
        for wall in said.walls.0 {
            noise = noise.with_wall(NoiseWall::new(wall.surface, said.width.unwrap_or(said.length))?);
        }
        Ok(noise)
    }
}
