//! How agents avoid each other.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The local model of a group.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Avoid {
    /// Optimal reciprocal collision avoidance (van den Berg, Guy, Lin, Manocha, 2011).
    Orca(Horizons),
    /// Hybrid reciprocal velocity obstacles (Snape, van den Berg, Guy, Manocha, 2011).
    Hrvo(Hrvo),
    /// Reciprocal velocity obstacles (van den Berg, Lin, Manocha, 2008).
    Rvo(Rvo),
    /// Velocity obstacles (Fiorini, Shiller, 1998): everybody takes all of the avoiding, and oscillates.
    Vo(Horizons),
    /// No avoidance: only the guard keeps people apart.
    None(Unavoiding),
}

impl Default for Avoid {
    fn default() -> Self {
        Self::Orca(Horizons::default())
    }
}

/// Parameters of the models that look ahead for a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Horizons {
    /// Seconds ahead for which a velocity must be safe from other agents. Limit: > 0.
    pub time_horizon: f64,
    /// Seconds ahead for which a velocity must be safe from obstacles. Limit: > 0.
    pub time_horizon_obstacles: f64,
    /// How many of the nearest others are taken into account. Limit: 1 to 1000.
    pub neighbours: u32,
    /// How far an agent looks for others, metres between centres. Limit: > 0.
    pub neighbour_distance: f64,
}

impl Default for Horizons {
    fn default() -> Self {
        Self { time_horizon: 2.0, time_horizon_obstacles: 0.7, neighbours: 10, neighbour_distance: 5.0 }
    }
}

/// Parameters of hybrid reciprocal velocity obstacles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Hrvo {
    /// Seconds ahead for which a velocity must be safe from obstacles. Limit: > 0.
    pub time_horizon_obstacles: f64,
    /// How many of the nearest others are taken into account. Limit: 1 to 1000.
    pub neighbours: u32,
    /// How far an agent looks for others, metres between centres. Limit: > 0.
    pub neighbour_distance: f64,
}

impl Default for Hrvo {
    fn default() -> Self {
        Self { time_horizon_obstacles: 0.7, neighbours: 10, neighbour_distance: 5.0 }
    }
}

/// Parameters of reciprocal velocity obstacles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Rvo {
    /// Weight of the time to a collision against the distance from the preferred velocity, metres. Limit: > 0.
    pub weight: f64,
    /// Seconds ahead beyond which collisions with other agents count for nothing. Limit: > 0.
    pub time_horizon: f64,
    /// The same for obstacles. Limit: > 0.
    pub time_horizon_obstacles: f64,
    /// How many of the nearest others are taken into account. Limit: 1 to 1000.
    pub neighbours: u32,
    /// How far an agent looks for others, metres between centres. Limit: > 0.
    pub neighbour_distance: f64,
}

impl Default for Rvo {
    fn default() -> Self {
        Self { weight: 1.0, time_horizon: 5.0, time_horizon_obstacles: 0.7, neighbours: 10, neighbour_distance: 5.0 }
    }
}

/// No avoidance has no parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Unavoiding {}

impl Avoid {
    /// How many of the nearest others are taken into account, and how far an agent looks for them.
    pub fn sight(&self) -> (u32, f64) {
        match self {
            Self::Orca(model) | Self::Vo(model) => (model.neighbours, model.neighbour_distance),
            Self::Hrvo(model) => (model.neighbours, model.neighbour_distance),
            Self::Rvo(model) => (model.neighbours, model.neighbour_distance),
            // those who are followed in a queue
            Self::None(_) => (Horizons::default().neighbours, Horizons::default().neighbour_distance),
        }
    }
}
