//! Irregular motion: the cure for robot-like motion.

use crate::Noise;
use throng::Error;
use throng::motion::{Steering, turned};
use throng::parameters::Value;
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Varies the direction and the speed of a part's preferred velocity by noise: people do not walk quite straight or
/// quite evenly. The position follows from the velocity, so nothing jumps.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::{Arrive, Irregular, Noise};
/// let noise = Noise { turbulent: true, ..Noise::default() };
/// let tired = Irregular { angle: 0.2, speed: 0.08, noise, of: Arrive::new(Target::Goal).into() };
/// ```
#[derive(Clone, Debug)]
pub struct Irregular {
    /// Greatest change of direction, radians; for flying agents also up and down. 0.1 to 0.25 look natural. Limit: 0 to
    /// 1.5.
    pub angle: f32,
    /// Greatest change of speed, as a part of it. 0.05 to 0.1 look natural. Limit: 0 to 1.
    pub speed: f32,
    /// The noise of both changes.
    pub noise: Noise,
    /// The part.
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
        let chosen = turned(view.chosen(said), basis.up, self.angle * noise(0));
        let chosen = if view.is_on_ground() { chosen } else { turned(chosen, basis.side, self.angle * noise(1)) };
        let chosen = (chosen * (1.0 + self.speed * noise(2))).clamp_length_max(view.vehicle.max_speed);
        why.note(|| SteeringReason::Wishes(chosen));
        let facing = said.and_then(|said| said.facing);
        (said.is_some() || chosen != view.velocity()).then(|| Steering { facing, ..view.reach(chosen) })
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless((0.0..=1.5).contains(&self.angle), "angle of wavering", self.angle, "from 0 to 1.5")?;
        Error::unless((0.0..=1.0).contains(&self.speed), "wavering of speed", self.speed, "from 0 to 1")?;
        self.noise.check_limits()?;
        self.of.check()
    }
}
