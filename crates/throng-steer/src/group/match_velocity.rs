//! Velocity matching: Reynolds, Flocks, herds, and schools, SIGGRAPH 1987; "Alignment" of 1999 by velocities.

use super::Neighbourhood;
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Matches the mean velocity of near neighbours (Reynolds 1987).
///
/// ```
/// use throng_steer::{MatchVelocity, Neighbourhood};
/// let fish = MatchVelocity { near: Neighbourhood { distance: 3.0, ..Neighbourhood::default() } };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MatchVelocity {
    /// The neighbours. Without it, all that the neighbour search finds.
    pub near: Neighbourhood,
}

impl Behaviour for MatchVelocity {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        self.near.tell(view, why);
        let (count, sum) =
            self.near.of(view).fold((0.0, Vec3::ZERO), |(n, sum), other| (n + 1.0, sum + other.velocity));
        if count == 0.0 {
            return None;
        }
        let mean = view.passable(sum / count);
        why.note(|| SteeringReason::Wishes(mean));
        Some(view.reach(mean))
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
