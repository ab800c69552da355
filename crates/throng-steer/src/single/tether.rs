//! Tether: keeps a wandering agent near a place (UnitySteer's SteerForTether).

use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Returns when it is too far from something.
///
/// Nothing to correct within the length of the tether.
///
/// ```
/// use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};
/// use throng_steer::Tether;
/// let dog = Tether { to: Target::Point(glam::Vec3::X), length: 2.0 };
/// assert_eq!(dog.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default()), None);
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tether {
    /// The target that it stays near.
    #[parameter(required)]
    pub to: Target,
    /// Greatest distance, metres.
    #[parameter(required, unit = "m", least = 0)]
    pub length: f32,
}

impl Behaviour for Tether {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let center = self.to.find(view)?.position;
        why.note(|| SteeringReason::Circle { center, radius: self.length });
        if view.to(center).length() > self.length { view.seek(center, why) } else { None }
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
