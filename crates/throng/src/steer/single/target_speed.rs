//! Target speed: OpenSteer's steerForTargetSpeed.

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, View, Why};

/// Goes at a speed, wherever it goes: only ahead or back. Nothing to correct at that speed.
///
/// ```
/// use throng::steer::{Behaviour, TargetSpeed, View, Why};
/// let stroll = TargetSpeed { speed: 0.7 };
/// let steering = stroll.steer(&View::default(), &mut [], &mut Why::default()).expect("it stands");
/// assert!(steering.force.x > 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TargetSpeed {
    /// The speed, m/s. Limit: >= 0.
    pub speed: f32,
}

/// Part of the top speed that does not matter.
const NEAR: f32 = 1e-3;

impl Behaviour for TargetSpeed {
    fn steer(&self, view: &View<'_>, _: &mut [f32], _: &mut Why<'_>) -> Option<Steering> {
        let short = self.speed - view.velocity().dot(view.forward());
        let steering = || view.reach(view.velocity() + view.forward() * short);
        (short.abs() > NEAR * view.vehicle.max_speed).then(steering)
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.speed >= 0.0, "target speed", self.speed, "0 or more")
    }
}
