//! Wandering by noise: Reynolds, Steering behaviors for autonomous characters, GDC 1999, "Wander" (the second way of
//! its text).

use crate::Noise;
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Angle, Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Wanders by noise (Reynolds 1999).
///
/// The angle by which the agent turns aside is noise over time (Perlin 1985).
///
/// ```
/// use throng::parameters::Angle;
/// use throng_steer::{FractalWander, Noise};
/// let drunkard = FractalWander { angle: Angle::degrees(70.0), noise: Noise { period: 1.0, ..Noise::default() } };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FractalWander {
    /// Greatest angle by which it turns aside, degrees.
    ///
    /// Flying agents also turn up and down.
    #[parameter(default = Angle::from_radians(0.8), unit = "°", least = 0, most = 85)]
    pub angle: Angle,
    /// The noise of the angle.
    pub noise: Noise,
}

impl Behaviour for FractalWander {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let angle = |k| libm::sincosf(self.angle.radians() * self.noise.at(view.time, k, view.rng));
        let ((aside, ahead), (up, level)) = (angle(0), if view.is_on_ground() { (0.0, 1.0) } else { angle(1) });
        let direction = view.motion.basis.to_world(Vec3::new(ahead * level, aside * level, up));
        why.note(|| SteeringReason::Aim(view.position() + direction));
        view.turn(direction)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
