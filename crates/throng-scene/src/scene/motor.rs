//! What moves agents.

use super::Group;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What moves agents, and which keys limit their motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Motor {
    /// They move in every direction, as people do: `speed`, `acceleration`, `turn_rate`.
    Holonomic,
    /// Robots that drive on two wheels and turn while they drive: the same keys and `tracking_error`.
    TwoWheels,
    /// Point masses under a force, with a direction: `vehicle`.
    Vehicle,
}

impl Motor {
    /// Returns the keys of a group that limit the motion of agents with this motor.
    pub fn keys(self) -> &'static [&'static str] {
        match self {
            Self::Holonomic => &["speed", "acceleration", "turn_rate"],
            Self::TwoWheels => &["speed", "acceleration", "turn_rate", "tracking_error"],
            Self::Vehicle => &["vehicle"],
        }
    }

    /// Returns the keys of a group that limit the motion of agents with other motors.
    pub fn keys_of_others(self) -> impl Iterator<Item = &'static str> {
        let all = [Self::TwoWheels, Self::Vehicle].into_iter().flat_map(Self::keys).copied();
        all.filter(move |key| !self.keys().contains(key))
    }
}

impl Group {
    /// Returns what moves the agents: what `motor` says, or what the other keys imply.
    pub fn moved_by(&self) -> Motor {
        let turns_on_wheels = || self.tracking_error.as_ref().is_some_and(|error| error.bounds()[1] > 0.0);
        match self.motor {
            Some(motor) => motor,
            None if self.steer.is_some() || self.vehicle.is_some() => Motor::Vehicle,
            None if turns_on_wheels() => Motor::TwoWheels,
            None => Motor::Holonomic,
        }
    }
}
