//! Cohesion: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::Neighbourhood;
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Steers to the mean position of the neighbours.
///
/// ```
/// use throng_steer::{Cohesion, Neighbourhood};
/// let sheep = Cohesion { near: Neighbourhood { distance: 9.0, ..Neighbourhood::default() }, full: 3.0 };
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cohesion {
    /// The neighbourhood.
    pub near: Neighbourhood,
    /// Distance of the mean position, metres, from which on the force is the vehicle's top force; 0: always the top
    /// force, as in OpenSteer, which may cause jitter. Limit: >= 0.
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
        Error::unless(self.full >= 0.0, "full pull", self.full, "0 or more")?;
        self.near.check()
    }
}
