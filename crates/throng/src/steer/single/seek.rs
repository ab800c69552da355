//! Seek: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use crate::motion::Steering;
use crate::steer::{Behaviour, Target, View, Why};

/// Goes to a target at the top speed, and past it. Nothing to correct if it is not there.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, Seek, Target, View, Why};
/// let seek = Seek { target: Target::Point(Vec3::Y) };
/// let steering = seek.steer(&View::default(), &mut [], &mut Why::default()).expect("it is elsewhere");
/// assert!(steering.force.x == 0.0 && steering.force.y > 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seek {
    /// Whom or what.
    pub target: Target,
}

impl Behaviour for Seek {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        view.seek(self.target.find(view)?.position, why)
    }
}
