//! Pursuit: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use crate::Prediction;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::Value;
use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};

/// Goes to the predicted position of a quarry.
///
/// ```
/// use throng::steer::{GroupFilter, Target};
/// use throng_steer::{Prediction, Pursue};
/// let predator = Pursue { prediction: Prediction::Constant(1.0), ..Pursue::from(Target::Nearest(GroupFilter::Group(1))) };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pursue {
    /// The quarry.
    pub quarry: Target,
    /// How far ahead the position of the quarry is predicted.
    pub prediction: Prediction,
}

impl From<Target> for Pursue {
    fn from(quarry: Target) -> Self {
        Self { quarry, prediction: Prediction::default() }
    }
}

impl Behaviour for Pursue {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let quarry = self.quarry.find(view)?;
        view.seek(quarry.position_in(self.prediction.of_quarry(view, &quarry)), why)
    }

    fn check(&self) -> Result<(), Error> {
        self.prediction.check_limits()
    }
}
