//! Offset pursuit: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Prediction, Reason, Target, View, Why};
use glam::Vec3;

/// Passes a quarry at a distance, as in a strafing run, or to look at it.
///
/// It aims beside where the quarry will be, on the side on which it is itself; who comes straight at it passes on the right.
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

impl Behaviour for OffsetPursuit {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let quarry = self.quarry.find(view)?;
        let future = quarry.position_in(self.prediction.of_quarry(view, &quarry));
        why.note(|| Reason::Expects(future));
        let across = view.motion.basis.lateral(view.to(future));
        let away = if across.length() > 1e-3 * self.distance { -across } else { -view.motion.basis.side };
        view.seek(future + away.normalize_or(Vec3::ZERO) * self.distance, why)
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.distance >= 0.0, "distance to pass at", self.distance, "0 or more")?;
        self.prediction.check()
    }
}
