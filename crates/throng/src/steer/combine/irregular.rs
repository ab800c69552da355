//! Irregular motion: the cure for motion like a robot's.

use crate::Error;
use crate::motion::{Steering, turned};
use crate::steer::{Behaviour, Branch, Noise, Reason, View, Why};

/// Lets direction and speed of what a part would like waver by noise: nobody walks quite straight, or quite evenly. The
/// place stays where motion leads, so nothing jumps.
///
/// ```
/// use throng::steer::{Arrive, Irregular, Noise, Target};
/// let noise = Noise { turbulent: true, ..Noise::default() };
/// let tired = Irregular { angle: 0.2, speed: 0.08, noise, of: Arrive::from(Target::Goal).into() };
/// ```
#[derive(Clone, Debug)]
pub struct Irregular {
    /// The most that the direction wavers, radians; of those who fly up and down too. 0.1 to 0.25 look natural.
    /// Limit: 0 to 1.5.
    pub angle: f32,
    /// The most that the speed wavers, as a part of it. 0.05 to 0.1 look natural. Limit: 0 to 1.
    pub speed: f32,
    /// How both waver.
    pub noise: Noise,
    /// What wavers.
    pub of: Branch,
}

impl Behaviour for Irregular {
    fn memory(&self) -> usize {
        self.of.words()
    }

    fn steer(&self, view: &View<'_>, mut memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let said = self.of.steer_as(0, view, &mut memory, why);
        let noise = |k| self.noise.at(view.time, k, view.dice);
        let basis = &view.motion.basis;
        let wish = turned(view.wish(said), basis.up, self.angle * noise(0));
        let wish = if view.is_on_ground() { wish } else { turned(wish, basis.side, self.angle * noise(1)) };
        let wish = (wish * (1.0 + self.speed * noise(2))).clamp_length_max(view.vehicle.max_speed);
        why.note(|| Reason::Wishes(wish));
        let facing = said.and_then(|said| said.facing);
        (said.is_some() || wish != view.velocity()).then(|| Steering { facing, ..view.reach(wish) })
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless((0.0..=1.5).contains(&self.angle), "angle of wavering", self.angle, "from 0 to 1.5")?;
        Error::unless((0.0..=1.0).contains(&self.speed), "wavering of speed", self.speed, "from 0 to 1")?;
        self.noise.check()?;
        self.of.check()
    }
}
