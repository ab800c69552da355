//! Alignment: Reynolds, Steering behaviors for autonomous characters, GDC 1999; OpenSteer's steerForAlignment.

use super::Neighbourhood;
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Turns to the mean direction of near neighbours (Reynolds 1999).
///
/// The force is the mean forward direction less the agent's own forward direction. [`MatchVelocity`](super::MatchVelocity) also matches their speed.
///
/// ```
/// use throng_steer::{Alignment, Neighbourhood};
/// let bird = Alignment { near: Neighbourhood { most: 7, ..Neighbourhood::default() }, full: 0.5 };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alignment {
    /// The neighbours. Without it, all that the neighbour search finds.
    pub near: Neighbourhood,
    /// Difference of the directions, 0 to 2, from which on it uses all of the force; 0: it always does.
    ///
    /// To use all of the force always, as in OpenSteer, may cause jitter.
    #[parameter(least = 0)]
    pub full: f32,
}

impl Behaviour for Alignment {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        self.near.tell(view, why);
        let (count, sum) = self.near.of(view).fold((0.0, Vec3::ZERO), |(n, sum), other| (n + 1.0, sum + other.forward));
        if count == 0.0 {
            return None;
        }
        let mean = sum * (1.0 / count);
        why.note(|| SteeringReason::Wishes(mean));
        view.urge(mean - view.forward(), self.full)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
