//! Offset pursuit: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Prediction, Reason, Target, View, Why};
use glam::Vec3;

/// Passes a quarry at a distance, as in a strafing run, or to look at it.
///
/// It aims at the distance beside where the quarry will be, to the side to which it goes already; who comes straight at it
/// passes on the right.
/// Once past it there is nothing to correct, until it is some distances away: then it comes back for another pass.
///
/// ```
/// use throng::steer::{OffsetPursuit, Prediction, Target};
/// let pass = OffsetPursuit { quarry: Target::Agent(1), prediction: Prediction::default(), distance: 5.0 };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OffsetPursuit {
    /// Whom.
    pub quarry: Target,
    /// How far ahead of it to aim.
    pub prediction: Prediction,
    /// How far beside it to pass, metres. Limit: >= 0.
    pub distance: f32,
}

/// From this many distances on it comes for another pass.
const AWAY: f32 = 4.0;
/// Within this many distances of where the quarry will be it is past it once it gets no nearer.
const BESIDE: f32 = 2.0;

impl Behaviour for OffsetPursuit {
    /// Whether it is past the quarry, and not yet on its way back.
    fn memory(&self) -> usize {
        1
    }

    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let [past] = memory else { return None };
        let quarry = self.quarry.find(view)?;
        let future = quarry.position_in(self.prediction.of_quarry(view, &quarry));
        why.note(|| Reason::Expects(future));
        let offset = view.to(future);
        let distance = offset.length();
        let towards = offset / distance.max(f32::MIN_POSITIVE);
        let across = |v: Vec3| v - towards * v.dot(towards);
        let side = view.passable(across(view.forward()));
        let side = if side.length() > 1e-3 { side } else { view.passable(across(-view.motion.basis.side)) };
        let beside = side.normalize_or_zero();
        // along the tangent of the sphere of that radius
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
        why.note(|| Reason::Aim(aim));
        view.turn(view.to(aim))
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.distance >= 0.0, "distance to pass at", self.distance, "0 or more")?;
        self.prediction.check()
    }
}
