//! Positive phototaxis: to a light, and round it.

use super::guide::{Guide, GuideOutput};
use glam::Vec3;
use std::f32::consts::TAU;
use throng::Error;
use throng::parameters::{Value, parameters};
use throng::steer::{Rng, SteeringInput, Target};

/// Flies to a light, and around it.
///
/// The light attracts where it is bright enough; within an orbit an insect circles it. Each insect has an axis of its
/// own, so that insects circle in different directions. With the noise there: moths round a lamp.
///
/// The intensity `I` of the light is its power over the square of the distance. The light attracts with the speed times
/// `I / (I + threshold)`.
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phototaxis {
    /// The light.
    #[parameter(required)]
    pub light: Target,
    /// Its intensity at a distance of 1 m.
    #[parameter(default = 1.0, least = 0)]
    pub power: f32,
    /// The intensity that attracts with half of the speed.
    #[parameter(default = 0.01, above = 0)]
    pub threshold: f32,
    /// Greatest speed of the attraction, m/s.
    #[parameter(default = 1.0, unit = "m/s", least = 0)]
    pub speed: f32,
    /// Distance within which it circles, metres.
    ///
    /// From 1.5 times this distance on an insect flies straight to the light.
    #[parameter(default = 0.5, unit = "m", above = 0)]
    pub orbit: f32,
    /// Differences between the orbits of insects: each has an orbit of `1 - spread` to `1 + spread` times this distance.
    #[parameter(default = 0.0, least = 0, most = 1)]
    pub spread: f32,
    /// Factor of the noise in the orbit.
    #[parameter(name = "agitation", default = 1.5, least = 0)]
    pub noise: f32,
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
        let orbit = self.orbit * (1.0 + self.spread * (2.0 * view.rng.at(0).draw(3) - 1.0));
        let inwards = ((square.sqrt() - orbit) / (0.5 * self.orbit)).clamp(0.0, 1.0);
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
        self.check_limits()
    }
}
