//! Steering to a heading: steerTowardHeading of OpenSteer's plug-ins.

use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Turns to a direction and leaves the speed to other behaviours. Nothing to correct once the agent faces there.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
/// use throng_steer::HeadFor;
/// let north = HeadFor { direction: Vec3::Y, full: 0.2 };
/// let steering = north.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default()).expect("it faces east");
/// assert!(steering.force.y > 0.0 && steering.force.x < 0.0, "the turn brakes");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadFor {
    /// The direction, of any length except 0.
    pub direction: Vec3,
    /// Difference of the two directions, 0 to 2, from which on the force is the vehicle's top force; OpenSteer: 0.
    /// Limit: >= 0.
    pub full: f32,
}

impl Behaviour for HeadFor {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let direction = view.passable(self.direction).try_normalize()?;
        why.note(|| SteeringReason::Wishes(direction * view.motion.speed()));
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
