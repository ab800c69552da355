//! Forward: the constant forward force to which OpenSteer's demos add all other forces.

use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, TraceRecorder};

/// Applies a force straight ahead.
///
/// ```
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
/// use throng_steer::MoveForward;
/// let steering = MoveForward { part: 0.5 }.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default());
/// assert_eq!(steering.map(|steering| steering.force), Some(glam::Vec3::X * 2.5));
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoveForward {
    /// Part of the greatest force.
    #[parameter(required, least = 0, most = 1)]
    pub part: f32,
}

impl Behaviour for MoveForward {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        Some((view.forward() * (self.part * view.vehicle.max_force)).into())
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
