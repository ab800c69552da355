//! The vehicle of steering behaviours: what a body makes of the force that it is steered by.
//!
//! A point mass with a direction, whose force, speed and turning are limited (Reynolds, Steering behaviors for
//! autonomous characters, GDC 1999, "Locomotion" and "A simple vehicle model"; OpenSteer's SimpleVehicle). All that is
//! smoothed or delayed is so by time constants in seconds, so that the time step does not show.

mod basis;
mod limit;
mod state;
mod steering;
mod step;
mod step_lanes;

pub use basis::Basis;
pub(crate) use basis::{angle_between, turned, turned_towards};
pub use state::{Attitude, Motion};
pub use steering::Steering;
pub(crate) use step_lanes::{Attitudes, Motions, Stepping};

use crate::Error;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// How a vehicle holds itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Locomotion {
    /// On the ground: it stays at its height, and upright.
    #[default]
    Ground,
    /// Flying level: it goes up and down, and rights itself.
    Level,
    /// Flying with banking: it leans into its turns, as birds and aircraft do, so that up is along the lateral
    /// acceleration and against gravity together.
    Banking,
}

/// How motion follows from force in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Integrator {
    /// First the velocity, then the place with the new velocity: stable where a spring is.
    #[default]
    SemiImplicit,
    /// The place with the velocity of the start of the step, as forward Euler has it in textbooks.
    Euler,
}

/// The most force along each axis of the vehicle, newtons; infinite for no limit of its own. Limit: >= 0.
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

/// What a vehicle can do. The default is a pedestrian of mass 1, so that forces are accelerations.
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
    /// Kilograms. Limit: > 0.
    pub mass: f32,
    /// The most force in any direction, newtons. Limit: > 0.
    pub max_force: f32,
    /// The most along each of its axes.
    pub forces: Forces,
    /// The speed it never exceeds, m/s. Limit: > 0.
    pub max_speed: f32,
    /// The speed it never falls below, as of an aircraft, m/s. It circles what lies within its tightest turn, and where
    /// it would rest. Limit: 0 to `max_speed`.
    pub min_speed: f32,
    /// How fast it turns at most, rad/s; infinite for no limit. Limit: > 0.
    pub max_turn_rate: f32,
    /// Part of the top speed below which it cannot turn freely: at rest only straight ahead, then ever more to the
    /// side; 0 for one that turns on the spot, 0.2 in OpenSteer. Limit: 0 to 1.
    pub low_speed: f32,
    /// Seconds in which it makes up all but a third of the way to a velocity that it wants
    /// ([`force_towards`](Self::force_towards)). Limit: >= 0.
    pub response: f32,
    /// Seconds over which its acceleration is smoothed; 0 for none. Limit: >= 0.
    pub smoothing: f32,
    /// How it holds itself.
    pub locomotion: Locomotion,
    /// How motion follows from force.
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
    /// The force that leads to a velocity: of the difference the part that is made up within so many seconds (> 0), so
    /// that the time step does not show. Reynolds' "desired velocity - velocity" is that of mass 1 and response 1.
    pub fn force_towards(&self, motion: &Motion, desired: Vec3, seconds: f32) -> Vec3 {
        (desired - motion.velocity) * self.urgency(seconds)
    }

    /// The velocity that a force leads to, in the end: [`force_towards`](Self::force_towards) the other way round.
    pub fn velocity_of(&self, motion: &Motion, force: Vec3, seconds: f32) -> Vec3 {
        motion.velocity + force / self.urgency(seconds)
    }

    /// Newtons for every m/s to make up.
    fn urgency(&self, seconds: f32) -> f32 {
        self.mass * part_in(seconds, self.response) / seconds
    }

    /// The force that brakes: velocity falls to nothing at a rate, 1/s.
    pub fn brake(&self, motion: &Motion, rate: f32, seconds: f32) -> Vec3 {
        motion.velocity * (-self.mass * part_in(seconds, 1.0 / rate) / seconds)
    }

    /// The most it can slow down, m/s².
    pub fn max_braking(&self) -> f32 {
        self.max_force.min(self.forces.brake) / self.mass
    }

    /// What is wrong with the parameters, if anything is.
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

/// The part of a difference that is made up in so many seconds by what has this time constant.
pub(crate) fn part_in(seconds: f32, time: f32) -> f32 {
    if time > 0.0 { 1.0 - libm::expf(-seconds / time) } else { 1.0 }
}
