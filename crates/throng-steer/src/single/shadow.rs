//! Shadowing: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::approach;
use throng::Error;
use throng::motion::Steering;
use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Approaches a quarry, then matches its velocity and orientation.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::Shadow;
/// let detective = Shadow { quarry: Target::Agent(1), distance: 3.0, slowing_distance: 2.0 };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shadow {
    /// The quarry.
    pub quarry: Target,
    /// Distance to the quarry, metres. Limit: >= 0.
    pub distance: f32,
    /// Distance from there at which the agent begins to slow down, metres. Limit: >= 0.
    pub slowing_distance: f32,
}

impl Behaviour for Shadow {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let quarry = self.quarry.find(view)?;
        why.note(|| SteeringReason::Expects(quarry.position));
        let offset = view.to(quarry.position);
        let gap = offset.length() - self.distance;
        let nearing = offset.normalize_or_zero() * gap.max(0.0);
        let steering = view.reach(approach(view, nearing, quarry.velocity, self.slowing_distance));
        Some(Steering { facing: (gap <= 0.0).then_some(quarry.basis.forward), ..steering })
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.distance >= 0.0, "distance to shadow at", self.distance, "0 or more")?;
        Error::unless(self.slowing_distance >= 0.0, "slowing distance", self.slowing_distance, "0 or more")
    }
}
