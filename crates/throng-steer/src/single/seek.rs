//! Seek: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use throng::motion::Steering;
use throng::parameters::parameters;
use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};

/// Moves to a target at top speed, and past it (Reynolds 1999).
///
/// Nothing to correct if the target does not exist.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};
/// use throng_steer::Seek;
/// let seek = Seek { target: Target::Point(Vec3::Y) };
/// let steering = seek.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default()).expect("it is elsewhere");
/// assert!(steering.force.x == 0.0 && steering.force.y > 0.0);
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seek {
    /// The target.
    #[parameter(required)]
    pub target: Target,
}

impl Behaviour for Seek {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        view.seek(self.target.find(view)?.position, why)
    }
}
