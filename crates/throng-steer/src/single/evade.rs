//! Evasion: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use crate::Prediction;
use crate::approach::nearest_time;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::Value;
use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};

/// Flees from the predicted position of a menace. The prediction is at most half of the time until the closest
/// approach: beyond that place the agent would flee towards the menace. A menace that moves away is not predicted.
///
/// ```
/// use throng::steer::{GroupFilter, Target};
/// use throng_steer::Evade;
/// let prey = Evade { panic_distance: 6.0, ..Evade::from(Target::Nearest(GroupFilter::OtherGroups)) };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evade {
    /// The menace.
    pub menace: Target,
    /// How far ahead its position is predicted.
    pub prediction: Prediction,
    /// Distance of the menace within which the agent flees, metres; infinite: at any distance. Limit: > 0.
    pub panic_distance: f32,
}

impl From<Target> for Evade {
    fn from(menace: Target) -> Self {
        Self { menace, prediction: Prediction::default(), panic_distance: f32::INFINITY }
    }
}

impl Behaviour for Evade {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let menace = self.menace.find(view)?;
        let offset = view.to(menace.position);
        if offset.length() > self.panic_distance {
            return None;
        }
        let nearest = nearest_time(offset, view.passable(menace.velocity)).max(0.0);
        view.flee(menace.position_in(self.prediction.of_menace(view, &menace).min(0.5 * nearest)), why)
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.panic_distance > 0.0, "panic distance", self.panic_distance, "greater than 0")?;
        self.prediction.check_limits()
    }
}
