//! A constant force: OpenSteer's "low speed turn" and "one turning away".

use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::parameters;
use throng::steer::{Behaviour, SteeringInput, TraceRecorder};

/// Applies a constant force, newtons.
///
/// In the end the agent moves in its direction. The vehicle limits the force.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
/// use throng_steer::ConstantForce;
/// let said = ConstantForce(Vec3::Y).steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default());
/// assert_eq!(said.map(|steering| steering.force), Some(Vec3::Y));
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantForce(
    /// The force. Limit: finite.
    pub Vec3,
);

impl Behaviour for ConstantForce {
    fn steer(&self, _: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        Some(self.0.into())
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_finite("constant force", f64::from(self.0.element_sum()))
    }
}
