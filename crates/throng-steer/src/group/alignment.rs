//! Alignment: Reynolds, Steering behaviors for autonomous characters, GDC 1999; OpenSteer's steerForAlignment.

use super::Neighbourhood;
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Turns to the mean forward direction of the neighbours: the force is that mean less the agent's own forward
/// direction. [`MatchVelocity`](super::MatchVelocity) also matches their speed.
///
/// ```
/// use throng_steer::{Alignment, Neighbourhood};
/// let bird = Alignment { near: Neighbourhood { most: 7, ..Neighbourhood::default() }, full: 0.5 };
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Alignment {
    /// The neighbourhood.
    pub near: Neighbourhood,
    /// Difference of the directions, 0 to 2, from which on the force is the vehicle's top force; 0: always the top
    /// force, as in OpenSteer, which may cause jitter. Limit: >= 0.
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
        Error::unless(self.full >= 0.0, "full turn", self.full, "0 or more")?;
        self.near.check()
    }
}
