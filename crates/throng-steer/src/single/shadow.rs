//! Shadowing: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::{SLOWING_DISTANCE, approach};
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Approaches a quarry, then moves as it moves (Reynolds 1999).
///
/// It matches the velocity of the quarry, and its orientation.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::Shadow;
/// let detective = Shadow { quarry: Target::Agent(1), distance: 3.0, slowing_distance: 2.0 };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shadow {
    /// The quarry.
    #[parameter(required)]
    pub quarry: Target,
    /// Distance that it keeps, metres.
    #[parameter(required, unit = "m", least = 0)]
    pub distance: f32,
    /// Distance from that point at which it starts to slow down, metres.
    #[parameter(default = SLOWING_DISTANCE, unit = "m", least = 0)]
    pub slowing_distance: f32,
}

impl Behaviour for Shadow {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let quarry = self.quarry.find(view)?;
        why.note(|| SteeringReason::Circle { center: quarry.position, radius: self.distance });
        let offset = view.to(quarry.position);
        let gap = offset.length() - self.distance;
        let nearing = offset.normalize_or_zero() * gap.max(0.0);
        let steering = view.reach(approach(view, nearing, quarry.velocity, self.slowing_distance));
        Some(Steering { facing: (gap <= 0.0).then_some(quarry.basis.forward), ..steering })
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
