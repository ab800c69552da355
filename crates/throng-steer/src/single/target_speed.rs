//! Target speed: OpenSteer's steerForTargetSpeed.

use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, TraceRecorder};

/// Reaches a speed, whatever its direction.
///
/// With a force forward or backward only. Nothing to correct at that speed.
///
/// ```
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
/// use throng_steer::TargetSpeed;
/// let stroll = TargetSpeed { speed: 0.7 };
/// let steering = stroll.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default()).expect("it stands");
/// assert!(steering.force.x > 0.0);
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TargetSpeed {
    /// The speed, m/s.
    #[parameter(required, unit = "m/s", least = 0)]
    pub speed: f32,
}

/// Difference of speeds that is tolerated, as a part of the top speed.
const NEAR: f32 = 1e-3;

impl Behaviour for TargetSpeed {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        let short = self.speed - view.velocity().dot(view.forward());
        let steering = || view.reach(view.velocity() + view.forward() * short);
        (short.abs() > NEAR * view.vehicle.max_speed).then(steering)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
