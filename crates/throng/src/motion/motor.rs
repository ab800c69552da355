//! Motors: what moves a body, and the limits of its motion.

use super::Vehicle;
use crate::Error;
use crate::parameters::Angle;
use serde::{Deserialize, Serialize};

/// What moves a body, and the limits of its motion. Any motor works with any [guidance](crate::agent::Guidance).
///
/// ```
/// use throng::Agent;
/// use throng::motion::{Motor, TwoWheels, Vehicle};
/// let robot = Agent::at([0.0, 0.0]).motor(TwoWheels { tracking_error: 0.05, ..TwoWheels::default() });
/// let car = Agent::at([5.0, 0.0]).motor(Vehicle { max_speed: 10.0, ..Vehicle::default() });
/// assert_eq!((robot.motor.max_speed(), car.motor.max_speed()), (1.8, 10.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Motor {
    /// Moves in every direction, as people do.
    Holonomic(Holonomic),
    /// Drives forwards with two wheels, and turns while it drives.
    TwoWheels(TwoWheels),
    /// A point mass under a force, with limits of force, speed and turning.
    Vehicle(Vehicle),
}

/// The motor of a body that moves in every direction, as people do.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Holonomic {
    /// Maximum speed, m/s. Limit: 0 to 1000.
    pub max_speed: f32,
    /// Maximum acceleration, m/s²; infinite for no limit. Limit: > 0.
    pub max_acceleration: f32,
    /// Maximum turn rate, radians a second; infinite for no limit. The ends of a body that is not a disc also turn no
    /// faster than its preferred speed. Limit: > 0.
    pub max_turn_rate: f32,
}

/// The motor of a robot with two driven wheels, which cannot move to the side: Alonso-Mora et al. 2010.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TwoWheels {
    /// Maximum speed, m/s. Limit: 0 to 1000.
    pub max_speed: f32,
    /// Maximum acceleration, m/s²; infinite for no limit. Limit: > 0.
    pub max_acceleration: f32,
    /// Maximum turn rate, radians a second. Limit: > 0, finite.
    pub max_turn_rate: f32,
    /// Distance by which the body may deviate from the straight path of its chosen velocity while it turns, metres. The
    /// agent and its neighbours treat its body as larger by this distance. Limit: above 0, to 10.
    pub tracking_error: f32,
}

impl Default for Holonomic {
    /// A pedestrian: 1.8 m/s, 5 m/s², no limit on turning.
    fn default() -> Self {
        Self { max_speed: 1.8, max_acceleration: 5.0, max_turn_rate: f32::INFINITY }
    }
}

impl Default for TwoWheels {
    /// As fast as a pedestrian, half a turn a second, and 0.1 m beside its path.
    fn default() -> Self {
        let Holonomic { max_speed, max_acceleration, .. } = Holonomic::default();
        Self { max_speed, max_acceleration, max_turn_rate: std::f32::consts::PI, tracking_error: 0.1 }
    }
}

impl Default for Motor {
    /// A pedestrian.
    fn default() -> Self {
        Holonomic::default().into()
    }
}

impl From<Holonomic> for Motor {
    fn from(motor: Holonomic) -> Self {
        Self::Holonomic(motor)
    }
}

impl From<TwoWheels> for Motor {
    fn from(motor: TwoWheels) -> Self {
        Self::TwoWheels(motor)
    }
}

impl From<Vehicle> for Motor {
    fn from(motor: Vehicle) -> Self {
        Self::Vehicle(motor)
    }
}

impl Motor {
    /// Returns the limits in the form in which the world stores them.
    pub(crate) fn limits(&self) -> MotorLimits {
        match *self {
            Self::Holonomic(Holonomic { max_speed, max_acceleration, max_turn_rate }) => {
                MotorLimits { vehicle: None, max_speed, max_acceleration, max_turn_rate, tracking_error: 0.0 }
            }
            Self::TwoWheels(TwoWheels { max_speed, max_acceleration, max_turn_rate, tracking_error }) => {
                MotorLimits { vehicle: None, max_speed, max_acceleration, max_turn_rate, tracking_error }
            }
            Self::Vehicle(vehicle) => MotorLimits {
                vehicle: Some(vehicle),
                max_speed: vehicle.max_speed,
                max_acceleration: f32::INFINITY,
                max_turn_rate: vehicle.max_turn_rate.radians(),
                tracking_error: 0.0,
            },
        }
    }

    /// Returns the maximum speed, m/s.
    pub fn max_speed(&self) -> f32 {
        self.limits().max_speed
    }

    /// Sets the maximum speed, m/s.
    pub fn set_max_speed(&mut self, speed: f32) {
        match self {
            Self::Holonomic(Holonomic { max_speed, .. })
            | Self::TwoWheels(TwoWheels { max_speed, .. })
            | Self::Vehicle(Vehicle { max_speed, .. }) => *max_speed = speed,
        }
    }

    /// Returns the vehicle that behaviours steer in a step of `seconds` (> 0): the motor itself, or a vehicle with its
    /// limits. A motor without a limit of acceleration can reverse its velocity in the step.
    pub fn vehicle(&self, seconds: f32) -> Vehicle {
        let MotorLimits { vehicle, max_speed, max_acceleration, max_turn_rate, .. } = self.limits();
        if let Some(vehicle) = vehicle {
            return vehicle;
        }
        let max_force = max_acceleration.min(2.0 * max_speed / seconds);
        Vehicle { max_speed, max_force, max_turn_rate: Angle::from_radians(max_turn_rate), ..Vehicle::default() }
    }

    /// Checks the limits.
    ///
    /// # Errors
    /// [`Error::Limit`] names the parameter that is out of range.
    pub fn check(&self) -> Result<(), Error> {
        match *self {
            Self::Holonomic(_) => {}
            Self::TwoWheels(TwoWheels { max_turn_rate, tracking_error: error, .. }) => {
                Error::unless(error > 0.0 && error <= 10.0, "tracking error", error, "more than 0 and at most 10 m")?;
                let limit = "finite where there is a tracking error";
                Error::unless(max_turn_rate.is_finite(), "max turn rate", max_turn_rate, limit)?;
            }
            Self::Vehicle(vehicle) => return vehicle.check(),
        }
        let MotorLimits { max_speed, max_acceleration, max_turn_rate, .. } = self.limits();
        Error::unless((0.0..=1e3).contains(&max_speed), "max speed", max_speed, "from 0 to 1000 m/s")?;
        Error::unless(max_acceleration > 0.0, "max acceleration", max_acceleration, "greater than 0")?;
        Error::unless(max_turn_rate > 0.0, "max turn rate", max_turn_rate, "greater than 0")
    }
}

/// The limits of a motor, of any kind. A vehicle limits its acceleration itself.
pub(crate) struct MotorLimits {
    pub vehicle: Option<Vehicle>,
    pub max_speed: f32,
    pub max_acceleration: f32,
    pub max_turn_rate: f32,
    pub tracking_error: f32,
}
