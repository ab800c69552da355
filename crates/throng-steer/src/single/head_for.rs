//! Steering to a heading: steerTowardHeading of OpenSteer's plug-ins.

use super::direction;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Angle, Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Turns to a direction.
///
/// It leaves the speed to other behaviours. Nothing to correct once the agent faces there.
///
/// ```
/// use throng::parameters::Angle;
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
/// use throng_steer::HeadFor;
/// let north = HeadFor::new(Angle::degrees(90.0));
/// let steering = north.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default()).expect("it faces east");
/// assert!(steering.force.y > 0.0 && steering.force.x < 0.0, "the turn brakes");
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadFor {
    /// The direction, degrees counter-clockwise from +x.
    #[parameter(required, unit = "°")]
    pub heading: Angle,
    /// Elevation of the direction, degrees.
    #[parameter(default = Angle::degrees(0.0), unit = "°", least = -90, most = 90)]
    pub pitch: Angle,
    /// Difference of the two directions, 0 to 2, from which on it uses all of the force.
    ///
    /// OpenSteer's is 0.
    #[parameter(default = 0.2, least = 0)]
    pub full: f32,
}

impl Behaviour for HeadFor {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let direction = view.passable(direction(self.heading, self.pitch)).try_normalize()?;
        why.note(|| SteeringReason::Wishes(direction * view.motion.speed()));
        view.urge(direction - view.forward(), self.full)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
