//! Arrival: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Moves to a target, and stops there (Reynolds 1999).
///
/// It slows down in proportion to the distance. The agent does not overshoot, whatever the time step: if the vehicle could not brake within the slowing distance, or
/// responds too slowly, it slows down earlier.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};
/// use throng_steer::Arrive;
/// let arrive = Arrive { slowing_distance: 2.0, ..Arrive::new(Target::Point(Vec3::X)) };
/// let steering = arrive.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default());
/// assert!((SteeringInput::default().chosen(steering).x - 0.9).abs() < 1e-6, "half way through, half the speed");
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrive {
    /// The target.
    #[parameter(required)]
    pub target: Target,
    /// Distance at which it starts to slow down, metres.
    #[parameter(default = SLOWING_DISTANCE, unit = "m", least = 0)]
    pub slowing_distance: f32,
    /// Distance that counts as arrival, metres: it stops at once.
    #[parameter(default = 0.01, unit = "m", least = 0)]
    pub tolerance: f32,
}

/// Default distance at which behaviours start to slow down, metres.
pub(crate) const SLOWING_DISTANCE: f32 = 1.0;

/// Part of the top speed below which the agent counts as standing: at that speed it does not drift out of any tolerance
/// within hours.
const REST: f32 = 1e-6;

impl Behaviour for Arrive {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let target = self.target.find(view)?;
        why.note(|| SteeringReason::Aim(target.position));
        why.note(|| {
            let most = view.vehicle.max_speed;
            let radius = most * settling_time(view, self.slowing_distance / most);
            SteeringReason::Circle { center: target.position, radius }
        });
        let offset = view.to(target.position);
        if offset.length() > self.tolerance {
            return Some(view.reach(approach(view, offset, Vec3::ZERO, self.slowing_distance)));
        }
        (view.motion.speed() > REST * view.vehicle.max_speed).then(|| view.reach(Vec3::ZERO))
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

/// Returns the velocity for the approach to a target with this offset and velocity: the velocity of the target, and a
/// component towards it in proportion to the distance, up to the top speed.
pub(crate) fn approach(view: &SteeringInput<'_>, offset: Vec3, velocity: Vec3, slowing_distance: f32) -> Vec3 {
    let most = view.vehicle.max_speed;
    let nearing = (offset / settling_time(view, slowing_distance / most)).clamp_length_max(most);
    (view.passable(velocity) + nearing).clamp_length_max(most)
}

/// Returns the least time constant, at least `least`, by which a distance can shrink without overshoot. It is long enough
/// to brake from the top speed.
pub(crate) fn settling_time(view: &SteeringInput<'_>, least: f32) -> f32 {
    let vehicle = &view.vehicle;
    least.max(vehicle.max_speed / vehicle.max_braking()).max(vehicle.settling_time(view.seconds))
}
