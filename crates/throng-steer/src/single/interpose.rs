//! Interpose: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::{SLOWING_DISTANCE, approach};
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Moves between two targets (Reynolds 1999).
///
/// As a bodyguard does: to a point on the line between their predicted positions at the time of arrival.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::Interpose;
/// let guard = Interpose { ratio: 0.25, ..Interpose::new(Target::Agent(1), Target::Agent(2)) };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interpose {
    /// The first target.
    #[parameter(required)]
    pub from: Target,
    /// The second target.
    #[parameter(required)]
    pub to: Target,
    /// Position on the line: 0 at the first target, 1 at the second.
    #[parameter(default = 0.5, least = 0, most = 1)]
    pub ratio: f32,
    /// Distance at which it starts to slow down, metres.
    #[parameter(default = SLOWING_DISTANCE, unit = "m", least = 0)]
    pub slowing_distance: f32,
}

impl Behaviour for Interpose {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let (first, second) = (self.from.find(view)?, self.to.find(view)?);
        let between = |seconds| first.position_in(seconds).lerp(second.position_in(seconds), self.ratio);
        let velocity = first.velocity.lerp(second.velocity, self.ratio);
        let place = between(view.to(between(0.0)).length() / view.vehicle.max_speed);
        why.note(|| SteeringReason::Aim(place));
        Some(view.reach(approach(view, view.to(place), velocity, self.slowing_distance)))
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
