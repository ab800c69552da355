//! Flee: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use throng::Error;
use throng::motion::Steering;
use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};

/// Moves straight away from a target at the top speed.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};
/// use throng_steer::Flee;
/// let flee = Flee { panic_distance: 3.0, ..Flee::from(Target::Point(Vec3::Y * 4.0)) };
/// assert_eq!(flee.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default()), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flee {
    /// The target.
    pub target: Target,
    /// Distance within which the agent flees, metres; infinite: at any distance. Limit: > 0.
    pub panic_distance: f32,
}

impl From<Target> for Flee {
    fn from(target: Target) -> Self {
        Self { target, panic_distance: f32::INFINITY }
    }
}

impl Behaviour for Flee {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let place = self.target.find(view)?.position;
        if view.to(place).length() > self.panic_distance { None } else { view.flee(place, why) }
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.panic_distance > 0.0, "panic distance", self.panic_distance, "greater than 0")
    }
}
