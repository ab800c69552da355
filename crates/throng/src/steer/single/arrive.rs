//! Arrival: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Reason, Target, View, Why};
use glam::Vec3;

/// Goes to a target at the top speed, slows down in proportion to the distance, and comes to rest there.
///
/// It does not overshoot, whatever the time step: where the vehicle could not brake within the slowing distance, or follows
/// too slowly, it slows down earlier.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Arrive, Behaviour, Target, View, Why};
/// let arrive = Arrive { slowing_distance: 2.0, ..Arrive::from(Target::Point(Vec3::X)) };
/// let steering = arrive.steer(&View::default(), &mut [], &mut Why::default());
/// assert!((View::default().wish(steering).x - 0.9).abs() < 1e-6, "half way through, half the speed");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrive {
    /// Where, or to whom.
    pub target: Target,
    /// How far away it begins to slow down, metres. Limit: >= 0.
    pub slowing_distance: f32,
    /// How near is there, metres: it stops at once. Limit: >= 0.
    pub tolerance: f32,
}

impl From<Target> for Arrive {
    fn from(target: Target) -> Self {
        Self { target, slowing_distance: 1.0, tolerance: 0.01 }
    }
}

/// Part of the top speed that is rest: who drifts at it leaves no tolerance within hours.
const REST: f32 = 1e-6;

impl Behaviour for Arrive {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let target = self.target.find(view)?;
        why.note(|| Reason::Aim(target.position));
        let offset = view.to(target.position);
        if offset.length() > self.tolerance {
            return Some(view.reach(approach(view, offset, Vec3::ZERO, self.slowing_distance)));
        }
        (view.motion.speed() > REST * view.vehicle.max_speed).then(|| view.reach(Vec3::ZERO))
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.slowing_distance >= 0.0, "slowing distance", self.slowing_distance, "0 or more")?;
        Error::unless(self.tolerance >= 0.0, "tolerance", self.tolerance, "0 or more")
    }
}

/// The velocity at which to come to what is so far away and moves so: its own, and more in proportion to the distance, up
/// to the top speed.
pub(in crate::steer) fn approach(view: &View<'_>, offset: Vec3, velocity: Vec3, slowing_distance: f32) -> Vec3 {
    let most = view.vehicle.max_speed;
    let nearing = (offset / settling_time(view, slowing_distance / most)).clamp_length_max(most);
    (view.passable(velocity) + nearing).clamp_length_max(most)
}

/// The least time constant, but not less than this, by which a distance can shrink without overshoot.
///
/// It is long enough for the brakes from the top speed. And velocity follows what is wanted by the vehicle's response, a
/// part of the difference in each step: distance and velocity are a linear system, whose eigenvalues are real and positive
/// from `seconds * (1 + q) / (1 - q)` on, `q` the square root of the part that is left in a step. That is four times the
/// response for short steps.
pub(in crate::steer) fn settling_time(view: &View<'_>, least: f32) -> f32 {
    let vehicle = &view.vehicle;
    let follows = vehicle.response + vehicle.smoothing;
    let left = if follows > 0.0 { libm::expf(-0.5 * view.seconds / follows) } else { 0.0 };
    least.max(vehicle.max_speed / vehicle.max_braking()).max(view.seconds * (1.0 + left) / (1.0 - left))
}
