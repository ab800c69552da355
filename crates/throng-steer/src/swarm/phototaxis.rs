//! Positive phototaxis: to a light, and round it.

use super::guide::{Guide, GuideOutput, check_amount};
use glam::Vec3;
use std::f32::consts::TAU;
use throng::Error;
use throng::steer::{Rng, SteeringInput, Target};

/// Flies to a light where the light is bright enough, and circles it within an orbit. Each insect has an axis of its
/// own, so that insects circle in different directions. With the noise there: moths round a lamp.
///
/// The intensity `I` of the light is its power over the square of the distance. The light attracts with the speed times
/// `I / (I + threshold)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phototaxis {
    /// The light.
    pub light: Target,
    /// Intensity at a distance of 1 m. Limit: >= 0.
    pub power: f32,
    /// The intensity that attracts with half of the speed. Limit: > 0.
    pub threshold: f32,
    /// Greatest speed towards the light, m/s. Limit: >= 0.
    pub speed: f32,
    /// Distance within which insects circle, metres; from 1.5 times this distance on they fly straight to the light.
    /// Limit: > 0.
    pub orbit: f32,
    /// Factor on the noise in the orbit. Limit: >= 0.
    pub noise: f32,
}

impl From<Target> for Phototaxis {
    fn from(light: Target) -> Self {
        Self { light, power: 1.0, threshold: 0.01, speed: 1.0, orbit: 0.5, noise: 1.5 }
    }
}

/// Returns the axis of an insect's orbit, of length 1, uniformly distributed.
fn axis(rng: Rng) -> Vec3 {
    let (z, angle) = (2.0 * rng.draw(0) - 1.0, TAU * rng.draw(1));
    let (sin, cos) = libm::sincosf(angle);
    let beside = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(beside * cos, beside * sin, z)
}

impl Guide for Phototaxis {
    fn guide(&self, view: &SteeringInput<'_>, _: &mut [f32], chosen: &mut GuideOutput) {
        let Some(light) = self.light.find(view) else { return };
        let to = view.to(light.position);
        let square = to.length_squared();
        // I / (I + threshold) at any distance
        let part = self.power / (self.power + self.threshold * square);
        let inwards = ((square.sqrt() - self.orbit) / (0.5 * self.orbit)).clamp(0.0, 1.0);
        let Some(direction) = to.try_normalize().filter(|_| part > 0.0) else { return };
        let mut way = direction * inwards;
        if inwards < 1.0 {
            let axis = if view.is_on_ground() {
                Vec3::Z * if view.rng.at(0).draw(0) < 0.5 { -1.0 } else { 1.0 }
            } else {
                axis(view.rng.at(0))
            };
            let round = axis.cross(direction).try_normalize().unwrap_or(direction.any_orthonormal_vector());
            way += round * (1.0 - inwards);
            chosen.noise *= 1.0 + (self.noise - 1.0) * part * (1.0 - inwards);
        }
        chosen.velocity += way * (self.speed * part);
    }

    fn check(&self) -> Result<(), Error> {
        check_amount("power of the light", self.power)?;
        Error::unless_positive("threshold of the light", self.threshold)?;
        check_amount("speed towards the light", self.speed)?;
        Error::unless_positive("orbit round the light", self.orbit)?;
        check_amount("noise round the light", self.noise)
    }
}
