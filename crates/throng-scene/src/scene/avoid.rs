//! How agents avoid each other.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The local model of a group.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Avoid {
    /// Optimal reciprocal collision avoidance.
    Orca(Orca),
}

impl Default for Avoid {
    fn default() -> Self {
        Self::Orca(Orca::default())
    }
}

/// Optimal reciprocal collision avoidance (van den Berg, Guy, Lin, Manocha, 2011).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Orca {
    /// Seconds ahead for which a velocity must be safe from other agents. Limit: > 0.
    pub time_horizon: f64,
    /// Seconds ahead for which a velocity must be safe from obstacles. Limit: > 0.
    pub time_horizon_obstacles: f64,
    /// How many of the nearest others are taken into account. Limit: 1 to 1000.
    pub neighbours: u32,
    /// How far an agent looks for others, metres between centres. Limit: > 0.
    pub neighbour_distance: f64,
}

impl Default for Orca {
    fn default() -> Self {
        Self { time_horizon: 2.0, time_horizon_obstacles: 0.7, neighbours: 10, neighbour_distance: 5.0 }
    }
}
