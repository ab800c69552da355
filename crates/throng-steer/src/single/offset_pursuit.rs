//! Offset pursuit: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use crate::Prediction;
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Passes a quarry at a distance (Reynolds 1999).
///
/// As in a strafing run, or to look at the quarry.
///
/// The agent aims at a point beside the predicted position of the quarry, at the distance, on the side to which it
/// already moves. An agent on a head-on course passes on the right. Once past, there is nothing to correct until the
/// agent is several distances away: then it comes back for another pass.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::{OffsetPursuit, Prediction};
/// let pass = OffsetPursuit { quarry: Target::Agent(1), prediction: Prediction::default(), distance: 5.0 };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OffsetPursuit {
    /// The quarry.
    #[parameter(required)]
    pub quarry: Target,
    /// How far ahead its position is predicted. Without it, cases of at most 10 s.
    pub prediction: Prediction,
    /// Distance at which it passes the quarry, metres.
    #[parameter(required, unit = "m", least = 0)]
    pub distance: f32,
}

/// Number of distances from which on the agent comes back for another pass.
const AWAY: f32 = 4.0;
/// Number of distances from the predicted position within which the agent counts as past once it gets no nearer.
const BESIDE: f32 = 2.0;

impl Behaviour for OffsetPursuit {
    /// Whether the agent is past the quarry, and not yet on its way back.
    fn memory(&self) -> usize {
        1
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let [past] = memory else { return None };
        let quarry = self.quarry.find(view)?;
        let future = quarry.position_in(self.prediction.of_quarry(view, &quarry));
        why.note(|| SteeringReason::Expects { now: quarry.position, then: future });
        why.note(|| SteeringReason::Circle { center: future, radius: self.distance });
        let offset = view.to(future);
        let distance = offset.length();
        let towards = offset / distance.max(f32::MIN_POSITIVE);
        let across = |v: Vec3| v - towards * v.dot(towards);
        let side = view.passable(across(view.forward()));
        let side = if side.length() > 1e-3 { side } else { view.passable(across(-view.motion.basis.side)) };
        let beside = side.normalize_or_zero();
        // along the tangent of the sphere with that radius
        let sine = (self.distance / distance.max(f32::MIN_POSITIVE)).min(1.0);
        let left = (distance * distance - self.distance * self.distance).max(0.0).sqrt();
        let aim = view.position() + (towards * (1.0 - sine * sine).sqrt() + beside * sine) * left.max(self.distance);
        if distance > AWAY * self.distance {
            *past = 0.0;
        } else if distance <= BESIDE * self.distance && offset.dot(view.velocity() - quarry.velocity) < 0.0 {
            *past = 1.0;
        }
        if *past > 0.0 {
            return None;
        }
        why.note(|| SteeringReason::Aim(aim));
        view.turn(view.to(aim))
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
