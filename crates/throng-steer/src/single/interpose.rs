//! Interpose: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::approach;
use throng::Error;
use throng::motion::Steering;
use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Moves between two targets, as a bodyguard does: to a point on the line between their predicted positions at the time
/// of arrival.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::Interpose;
/// let guard = Interpose { between: [Target::Agent(1), Target::Agent(2)], ratio: 0.25, slowing_distance: 1.0 };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interpose {
    /// The two targets.
    pub between: [Target; 2],
    /// Point on the line: 0 at the first target, 1 at the second. Limit: 0 to 1.
    pub ratio: f32,
    /// Distance at which the agent begins to slow down, metres. Limit: >= 0.
    pub slowing_distance: f32,
}

impl Behaviour for Interpose {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let [first, second] = self.between.map(|target| target.find(view));
        let (first, second) = (first?, second?);
        let between = |seconds| first.position_in(seconds).lerp(second.position_in(seconds), self.ratio);
        let velocity = first.velocity.lerp(second.velocity, self.ratio);
        let place = between(view.to(between(0.0)).length() / view.vehicle.max_speed);
        why.note(|| SteeringReason::Aim(place));
        Some(view.reach(approach(view, view.to(place), velocity, self.slowing_distance)))
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless((0.0..=1.0).contains(&self.ratio), "ratio", self.ratio, "from 0 to 1")?;
        Error::unless(self.slowing_distance >= 0.0, "slowing distance", self.slowing_distance, "0 or more")
    }
}
