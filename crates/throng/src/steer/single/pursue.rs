//! Pursuit: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Prediction, Target, View, Why};

/// Goes to where a quarry will be.
///
/// ```
/// use throng::steer::{Prediction, Pursue, Target, Who};
/// let predator = Pursue { prediction: Prediction::Constant(1.0), ..Pursue::from(Target::Nearest(Who::Group(1))) };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pursue {
    /// Whom.
    pub quarry: Target,
    /// How far ahead of it to aim.
    pub prediction: Prediction,
}

impl From<Target> for Pursue {
    fn from(quarry: Target) -> Self {
        Self { quarry, prediction: Prediction::default() }
    }
}

impl Behaviour for Pursue {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let quarry = self.quarry.find(view)?;
        view.seek(quarry.position_in(self.prediction.of_quarry(view, &quarry)), why)
    }

    fn check(&self) -> Result<(), Error> {
        self.prediction.check()
    }
}
