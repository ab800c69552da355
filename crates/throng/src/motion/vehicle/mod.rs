//! The vehicle of steering behaviours: the motion of a body under a steering force.
//!
//! A point mass with a direction and with limits of force, speed and turning (Reynolds, Steering behaviors for
//! autonomous characters, GDC 1999, "Locomotion" and "A simple vehicle model"; OpenSteer's SimpleVehicle). All
//! smoothing and delays use time constants in seconds, so that results do not depend on the time step.

mod basis;
mod limit;
mod state;
mod steering;
mod step;
mod step_simd;

pub use basis::Basis;
pub use basis::{angle_between, turned, turned_towards};
pub use state::{Attitude, Motion};
pub use steering::Steering;
pub(crate) use step_simd::{Attitudes, Motions, Stepping};

use crate::Error;
use crate::parameters::{Angle, Value, parameters};
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// How a vehicle's body is oriented.
#[parameters]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Locomotion {
    /// On the ground, upright.
    ///
    /// It keeps its height.
    #[default]
    Ground,
    /// Flying level.
    ///
    /// It may climb and descend, and levels itself.
    Level,
    /// Flying, and banking into its turns, as birds and aircraft do.
    ///
    /// Up is along the sum of the lateral acceleration and the upward reaction to gravity.
    Banking,
}

/// How motion is integrated in a step.
#[parameters]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Integrator {
    /// First the velocity, then the position with the new velocity.
    ///
    /// Stable for springs.
    #[default]
    SemiImplicit,
    /// The position with the velocity of the start of the step.
    ///
    /// Forward Euler of textbooks.
    Euler,
}

/// The greatest force along each axis of a vehicle, newtons. Without a value, the axis has no limit of its own.
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Forces {
    /// Forwards.
    #[parameter(default = f32::INFINITY, infinite, unit = "N", least = 0)]
    pub thrust: f32,
    /// Backwards.
    #[parameter(default = f32::INFINITY, infinite, unit = "N", least = 0)]
    pub brake: f32,
    /// To either side.
    #[parameter(default = f32::INFINITY, infinite, unit = "N", least = 0)]
    pub side: f32,
    /// Up and down.
    #[parameter(default = f32::INFINITY, infinite, unit = "N", least = 0)]
    pub up: f32,
}

/// A vehicle: the motor of a point mass with a direction. What is not given is as for a pedestrian of mass 1, for which
/// forces equal accelerations.
///
/// ```
/// use glam::Vec3;
/// use throng::motion::{Motion, Vehicle};
/// let (vehicle, mut motion) = (Vehicle::default(), Motion::default());
/// for _ in 0..100 {
///     let force = vehicle.force_towards(&motion, Vec3::Y, 0.05);
///     vehicle.step(&mut motion, force, 0.05);
/// }
/// assert!(motion.velocity.distance(Vec3::Y) < 1e-3 && motion.basis.forward.y > 0.999);
/// ```
#[parameters(check = Self::check)]
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Vehicle {
    /// Kilograms.
    #[parameter(default = 1.0, unit = "kg", above = 0)]
    pub mass: f32,
    /// The greatest force in any direction, newtons.
    #[parameter(default = 5.0, unit = "N", above = 0)]
    pub max_force: f32,
    /// The greatest force along each of its axes.
    pub forces: Forces,
    /// The greatest speed, m/s.
    #[parameter(default = 1.8, unit = "m/s", above = 0, most = 1000)]
    pub max_speed: f32,
    /// The least speed, m/s. Limit: 0 to `max_speed`.
    ///
    /// For example that of an aircraft. The vehicle circles targets within its tightest turn, and places where it would stop.
    #[parameter(default = 0.0, unit = "m/s")]
    pub min_speed: f32,
    /// Greatest turn rate, degrees a second. Without it, no limit.
    #[parameter(name = "turn_rate", default = Angle::from_radians(f32::INFINITY), infinite, unit = "°/s", above = 0)]
    pub max_turn_rate: Angle,
    /// Part of the top speed below which its turning is limited: at rest it can only go straight ahead; 0 lets it turn on
    /// the spot.
    ///
    /// It accelerates ever more to the side the faster it is. 0.2 in OpenSteer.
    #[parameter(default = 0.0, least = 0, most = 1)]
    pub low_speed: f32,
    /// Seconds in which it completes all but a third of a change to the velocity it aims for.
    ///
    /// A time constant: all but 1/e of the change ([`force_towards`](Self::force_towards)).
    #[parameter(default = 0.25, unit = "s", least = 0)]
    pub response: f32,
    /// Seconds over which its acceleration is smoothed.
    #[parameter(default = 0.0, unit = "s", least = 0)]
    pub smoothing: f32,
    /// How its body is oriented.
    #[parameter(name = "kind")]
    pub locomotion: Locomotion,
    /// How motion is integrated.
    pub integrator: Integrator,
}

impl Vehicle {
    /// Returns the force that leads towards a desired velocity: of the difference, the fraction that the response makes
    /// up within `seconds` (> 0), so that results do not depend on the time step. For mass 1, response 1 and short
    /// steps it is Reynolds' "desired velocity - velocity".
    #[inline]
    pub fn force_towards(&self, motion: &Motion, desired: Vec3, seconds: f32) -> Vec3 {
        (desired - motion.velocity) * self.urgency(seconds)
    }

    /// Returns the velocity that a constant force leads to: the inverse of [`force_towards`](Self::force_towards).
    #[inline]
    pub fn velocity_of(&self, motion: &Motion, force: Vec3, seconds: f32) -> Vec3 {
        motion.velocity + force / self.urgency(seconds)
    }

    /// Returns the force per difference of velocity, newtons per m/s.
    #[inline]
    fn urgency(&self, seconds: f32) -> f32 {
        self.mass * part_in(seconds, self.response) / seconds
    }

    /// Returns the braking force: the velocity decays at `rate`, 1/s.
    pub fn brake(&self, motion: &Motion, rate: f32, seconds: f32) -> Vec3 {
        motion.velocity * (-self.mass * part_in(seconds, 1.0 / rate) / seconds)
    }

    /// Whether it may leave the ground.
    pub fn flies(self) -> bool {
        self.locomotion != Locomotion::Ground
    }

    /// Returns the least time constant by which a distance can shrink without overshoot, in steps of `seconds` (> 0).
    ///
    /// The velocity follows the chosen velocity by the response, a part of the difference in each step, so distance and
    /// velocity are a linear system. Its eigenvalues are real and positive from `seconds * (1 + q) / (1 - q)` on, where
    /// `q` is the square root of the part that is left after a step. For short steps that is four times the response.
    pub fn settling_time(&self, seconds: f32) -> f32 {
        let follows = self.response + self.smoothing;
        let left = if follows > 0.0 { libm::expf(-0.5 * seconds / follows) } else { 0.0 };
        seconds * (1.0 + left) / (1.0 - left)
    }

    /// Returns the greatest deceleration, m/s².
    pub fn max_braking(&self) -> f32 {
        self.max_force.min(self.forces.brake) / self.mass
    }

    /// Checks the parameters.
    ///
    /// # Errors
    /// [`Error::Limit`] names the parameter.
    pub fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        let (least, most) = (self.min_speed, self.max_speed);
        Error::unless((0.0..=most).contains(&least), "min_speed", least, "from 0 to max_speed")
    }
}

/// Returns the fraction of a difference that a process with time constant `time` makes up in `seconds`.
#[inline]
pub(crate) fn part_in(seconds: f32, time: f32) -> f32 {
    if time > 0.0 { 1.0 - libm::expf(-seconds / time) } else { 1.0 }
}
