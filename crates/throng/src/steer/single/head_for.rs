//! Steering to a heading: steerTowardHeading of OpenSteer's plug-ins.

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Reason, View, Why};
use glam::Vec3;

/// Turns to a direction, and leaves it to others how fast it goes. Nothing to correct once it faces there.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, HeadFor, View, Why};
/// let north = HeadFor { direction: Vec3::Y, full: 0.2 };
/// let steering = north.steer(&View::default(), &mut [], &mut Why::default()).expect("it faces east");
/// assert!(steering.force.y > 0.0 && steering.force.x < 0.0, "the turn brakes");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadFor {
    /// Where to; of any length but 0.
    pub direction: Vec3,
    /// How great the difference of the two directions is, 0 to 2, from which it has all of the force; OpenSteer: 0. Limit: >= 0.
    pub full: f32,
}

impl Behaviour for HeadFor {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let direction = view.passable(self.direction).try_normalize()?;
        why.note(|| Reason::Wishes(direction * view.motion.speed()));
        view.urge(direction - view.forward(), self.full)
    }

    fn check(&self) -> Result<(), Error> {
        let length = self.direction.length();
        Error::unless(
            length > 0.0 && length.is_finite(),
            "length of the direction",
            length,
            "greater than 0 and finite",
        )?;
        Error::unless(self.full >= 0.0, "full", self.full, "0 or more")
    }
}
