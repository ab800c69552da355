//! Tether: keeps a wandering agent near a place (UnitySteer's SteerForTether).

use throng::Error;
use throng::motion::Steering;
use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};

/// Comes back when the agent is too far from a target. Nothing to correct within the length of the tether.
///
/// ```
/// use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};
/// use throng_steer::Tether;
/// let dog = Tether { to: Target::Point(glam::Vec3::X), length: 2.0 };
/// assert_eq!(dog.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default()), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tether {
    /// The target.
    pub to: Target,
    /// Greatest distance from it, metres. Limit: >= 0.
    pub length: f32,
}

impl Behaviour for Tether {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let center = self.to.find(view)?.position;
        if view.to(center).length() > self.length { view.seek(center, why) } else { None }
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.length >= 0.0, "length of the tether", self.length, "0 or more")
    }
}
