//! Flee: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Moves straight away from a target (Reynolds 1999).
///
/// At the top speed. Nothing to correct if the target does not exist, or is beyond the panic distance.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};
/// use throng_steer::Flee;
/// let flee = Flee { panic_distance: 3.0, ..Flee::new(Target::Point(Vec3::Y * 4.0)) };
/// assert_eq!(flee.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default()), None);
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flee {
    /// The target.
    #[parameter(required)]
    pub target: Target,
    /// Greatest distance at which it flees, metres. Without it, any distance.
    #[parameter(default = f32::INFINITY, infinite, unit = "m", above = 0)]
    pub panic_distance: f32,
}

impl Behaviour for Flee {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let place = self.target.find(view)?.position;
        tell_range(place, self.panic_distance, why);
        if view.to(place).length() > self.panic_distance { None } else { view.flee(place, why) }
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

/// Records the range within which an agent flees from a place, if there is a limit.
pub(super) fn tell_range(place: Vec3, range: f32, why: &mut TraceRecorder<'_>) {
    if range.is_finite() {
        why.note(|| SteeringReason::Circle { center: place, radius: range });
    }
}
