//! A force that is always the same: OpenSteer's "low speed turn" and "one turning away".

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, View, Why};
use glam::Vec3;

/// Presses in a direction, whatever it does: in the end it goes there. The vehicle makes of it what it can.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, ConstantForce, View, Why};
/// let said = ConstantForce(Vec3::Y).steer(&View::default(), &mut [], &mut Why::default());
/// assert_eq!(said.map(|steering| steering.force), Some(Vec3::Y));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantForce(
    /// The force, newtons. Limit: finite.
    pub Vec3,
);

impl Behaviour for ConstantForce {
    fn steer(&self, _: &View<'_>, _: &mut [f32], _: &mut Why<'_>) -> Option<Steering> {
        Some(self.0.into())
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_finite("constant force", f64::from(self.0.element_sum()))
    }
}
