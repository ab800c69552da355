//! Evasion: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::flee::tell_range;
use crate::Prediction;
use crate::approach::nearest_time;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Moves away from the predicted position of a menace (Reynolds 1999).
///
/// The prediction is at most half of the time until the closest
/// approach: beyond that place the agent would flee towards the menace. A menace that moves away is not predicted.
///
/// ```
/// use throng::steer::{GroupFilter, Target};
/// use throng_steer::Evade;
/// let prey = Evade { panic_distance: 6.0, ..Evade::new(Target::Nearest(GroupFilter::OtherGroups)) };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evade {
    /// The menace.
    #[parameter(required)]
    pub menace: Target,
    /// How far ahead its position is predicted. Without it, cases of at most 10 s.
    pub prediction: Prediction,
    /// Greatest distance at which it flees, metres. Without it, any distance.
    #[parameter(default = f32::INFINITY, infinite, unit = "m", above = 0)]
    pub panic_distance: f32,
}

impl Behaviour for Evade {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let menace = self.menace.find(view)?;
        tell_range(menace.position, self.panic_distance, why);
        let offset = view.to(menace.position);
        if offset.length() > self.panic_distance {
            return None;
        }
        let nearest = nearest_time(offset, view.passable(menace.velocity)).max(0.0);
        let then = menace.position_in(self.prediction.of_menace(view, &menace).min(0.5 * nearest));
        why.note(|| SteeringReason::Expects { now: menace.position, then });
        view.flee(then, why)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
