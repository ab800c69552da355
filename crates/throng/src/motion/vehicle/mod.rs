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
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// How a vehicle orients itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Locomotion {
    /// On the ground: it keeps its height and stays upright.
    #[default]
    Ground,
    /// Level flight: it may climb and descend, and levels itself.
    Level,
    /// Banked flight: it banks into turns, as birds and aircraft do, so that up is along the sum of the lateral
    /// acceleration and the upward reaction to gravity.
    Banking,
}

/// The integration scheme of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Integrator {
    /// The position uses the new velocity: stable for springs.
    #[default]
    SemiImplicit,
    /// The position uses the velocity at the start of the step, as forward Euler in textbooks.
    Euler,
}

/// The greatest force along each axis of the vehicle, newtons; infinite for no separate limit. Limit: >= 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Forces {
    /// Forwards.
    pub thrust: f32,
    /// Backwards.
    pub brake: f32,
    /// To either side.
    pub side: f32,
    /// Up and down.
    pub up: f32,
}

impl Default for Forces {
    fn default() -> Self {
        Self { thrust: f32::INFINITY, brake: f32::INFINITY, side: f32::INFINITY, up: f32::INFINITY }
    }
}

/// The parameters of a vehicle. The default is a pedestrian of mass 1, so that forces are accelerations.
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
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Vehicle {
    /// Mass, kilograms. Limit: > 0.
    pub mass: f32,
    /// Greatest force in any direction, newtons. Limit: > 0.
    pub max_force: f32,
    /// Greatest force along each axis.
    pub forces: Forces,
    /// Top speed, m/s. Limit: > 0.
    pub max_speed: f32,
    /// Least speed, m/s, for example of an aircraft. The vehicle circles targets within its tightest turn, and places
    /// where it would stop. Limit: 0 to `max_speed`.
    pub min_speed: f32,
    /// Greatest turn rate, rad/s; infinite for no limit. Limit: > 0.
    pub max_turn_rate: f32,
    /// Fraction of the top speed below which it cannot turn freely: when it stands it can accelerate only straight
    /// ahead, and then ever more to the side. 0 for a vehicle that turns on the spot, 0.2 in OpenSteer. Limit: 0 to 1.
    pub low_speed: f32,
    /// Time constant, seconds, with which it approaches a desired velocity ([`force_towards`](Self::force_towards)),
    /// all but 1/e of the change. Limit: >= 0.
    pub response: f32,
    /// Time constant of the smoothing of its acceleration, seconds; 0 for none. Limit: >= 0.
    pub smoothing: f32,
    /// How it orients itself.
    pub locomotion: Locomotion,
    /// The integration scheme.
    pub integrator: Integrator,
}

impl Default for Vehicle {
    fn default() -> Self {
        Self {
            mass: 1.0,
            max_force: 5.0,
            forces: Forces::default(),
            max_speed: 1.8,
            min_speed: 0.0,
            max_turn_rate: f32::INFINITY,
            low_speed: 0.0,
            response: 0.25,
            smoothing: 0.0,
            locomotion: Locomotion::Ground,
            integrator: Integrator::SemiImplicit,
        }
    }
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

    /// Returns the greatest deceleration, m/s².
    pub fn max_braking(&self) -> f32 {
        self.max_force.min(self.forces.brake) / self.mass
    }

    /// Checks the parameters.
    ///
    /// # Errors
    /// [`Error::Limit`] names the parameter.
    pub fn check(&self) -> Result<(), Error> {
        let Forces { thrust, brake, side, up } = self.forces;
        Error::unless_positive("mass", self.mass)?;
        Error::unless_positive("top force", self.max_force)?;
        for (what, force) in [("thrust", thrust), ("brake", brake), ("side force", side), ("lift", up)] {
            Error::unless(force >= 0.0, what, force, "0 or more")?;
        }
        Error::unless_positive("top speed", self.max_speed)?;
        let (least, most) = (self.min_speed, self.max_speed);
        Error::unless((0.0..=most).contains(&least), "least speed", least, "from 0 to the top speed")?;
        Error::unless(self.max_turn_rate > 0.0, "turn rate", self.max_turn_rate, "greater than 0")?;
        Error::unless((0.0..=1.0).contains(&self.low_speed), "low speed", self.low_speed, "from 0 to 1")?;
        for (what, time) in [("response", self.response), ("smoothing", self.smoothing)] {
            Error::unless(time >= 0.0 && time.is_finite(), what, time, "0 or more and finite")?;
        }
        Ok(())
    }
}

/// Returns the fraction of a difference that a process with time constant `time` makes up in `seconds`.
#[inline]
pub(crate) fn part_in(seconds: f32, time: f32) -> f32 {
    if time > 0.0 { 1.0 - libm::expf(-seconds / time) } else { 1.0 }
}
