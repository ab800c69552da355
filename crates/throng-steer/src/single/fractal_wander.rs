//! Wandering by noise: Reynolds, Steering behaviors for autonomous characters, GDC 1999, "Wander" (the second way of
//! its text).

use crate::Noise;
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::Value;
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Wanders: the angle by which the agent turns aside is noise over time (Perlin 1985).
///
/// ```
/// use throng_steer::{FractalWander, Noise};
/// let drunkard = FractalWander { angle: 1.2, noise: Noise { period: 1.0, ..Noise::default() } };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FractalWander {
    /// Greatest angle aside, radians; for flying agents also up and down. Limit: 0 to 1.5.
    pub angle: f32,
    /// The noise of the angle.
    pub noise: Noise,
}

impl Default for FractalWander {
    fn default() -> Self {
        Self { angle: 0.8, noise: Noise::default() }
    }
}

impl Behaviour for FractalWander {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let angle = |k| libm::sincosf(self.angle * self.noise.at(view.time, k, view.rng));
        let ((aside, ahead), (up, level)) = (angle(0), if view.is_on_ground() { (0.0, 1.0) } else { angle(1) });
        let direction = view.motion.basis.to_world(Vec3::new(ahead * level, aside * level, up));
        why.note(|| SteeringReason::Aim(view.position() + direction));
        view.turn(direction)
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless((0.0..=1.5).contains(&self.angle), "angle of wandering", self.angle, "from 0 to 1.5")?;
        self.noise.check_limits()
    }
}
