//! Pursuit: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use crate::Prediction;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Moves to the predicted position of a quarry (Reynolds 1999).
///
/// ```
/// use throng::steer::{GroupFilter, Target};
/// use throng_steer::{Prediction, Pursue};
/// let predator = Pursue { prediction: Prediction::Constant(1.0), ..Pursue::new(Target::Nearest(GroupFilter::Group(1))) };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pursue {
    /// The quarry.
    #[parameter(required)]
    pub quarry: Target,
    /// How far ahead its position is predicted. Without it, cases of at most 10 s.
    pub prediction: Prediction,
}

impl Behaviour for Pursue {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let quarry = self.quarry.find(view)?;
        let then = quarry.position_in(self.prediction.of_quarry(view, &quarry));
        why.note(|| SteeringReason::Expects { now: quarry.position, then });
        view.seek(then, why)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
