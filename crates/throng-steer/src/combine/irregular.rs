//! Irregular motion: the cure for robot-like motion.

use crate::Noise;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::{Steering, turned};
use throng::parameters::{Angle, Value, parameters};
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Adds noise to the direction and speed of a part, so that the motion looks less mechanical.
///
/// People do not walk quite straight or
/// quite evenly. The position follows from the velocity, so nothing jumps.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::{Arrive, Irregular, Noise};
/// let noise = Noise { turbulent: true, ..Noise::default() };
/// let tired = Irregular { noise, ..Irregular::new(Arrive::new(Target::Goal)) };
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct Irregular {
    /// Greatest deviation of the direction, degrees; of agents that fly also up and down. 6 to 14 look natural.
    #[parameter(default = Angle::from_radians(0.175), unit = "°", least = 0, most = 85)]
    pub angle: Angle,
    /// Greatest deviation of the speed, as a part of it. 0.05 to 0.1 look natural.
    #[parameter(default = 0.08, least = 0, most = 1)]
    pub speed: f32,
    /// The noise of both.
    pub noise: Noise,
    /// The part.
    #[parameter(required)]
    pub of: BoxedBehaviour,
}

impl Behaviour for Irregular {
    fn memory(&self) -> usize {
        self.of.words()
    }

    fn steer(&self, view: &SteeringInput<'_>, mut memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let said = self.of.steer_as(0, view, &mut memory, why);
        let noise = |k| self.noise.at(view.time, k, view.rng);
        let basis = &view.motion.basis;
        let chosen = turned(view.chosen(said), basis.up, self.angle.radians() * noise(0));
        let chosen =
            if view.is_on_ground() { chosen } else { turned(chosen, basis.side, self.angle.radians() * noise(1)) };
        let chosen = (chosen * (1.0 + self.speed * noise(2))).clamp_length_max(view.vehicle.max_speed);
        why.note(|| SteeringReason::Wishes(chosen));
        let facing = said.and_then(|said| said.facing);
        (said.is_some() || chosen != view.velocity()).then(|| Steering { facing, ..view.reach(chosen) })
    }

    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        self.of.fields(see);
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        self.of.check()
    }
}
