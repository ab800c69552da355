//! Cohesion: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::Neighbourhood;
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Moves to the centre of near neighbours (Reynolds 1999).
///
/// ```
/// use throng_steer::{Cohesion, Neighbourhood};
/// let sheep = Cohesion { near: Neighbourhood { distance: 9.0, ..Neighbourhood::default() }, full: 3.0 };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cohesion {
    /// The neighbours. Without it, all that the neighbour search finds.
    pub near: Neighbourhood,
    /// Distance of the centre, metres, from which on it uses all of the force; 0: it always does.
    ///
    /// To use all of the force always, as in OpenSteer, may cause jitter.
    #[parameter(unit = "m", least = 0)]
    pub full: f32,
}

impl Behaviour for Cohesion {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        self.near.tell(view, why);
        let (count, sum) = self.near.of(view).fold((0.0, Vec3::ZERO), |(n, sum), other| (n + 1.0, sum + other.offset));
        if count == 0.0 {
            return None;
        }
        let middle = sum * (1.0 / count);
        why.note(|| SteeringReason::Aim(view.position() + middle));
        view.urge(middle, self.full)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
