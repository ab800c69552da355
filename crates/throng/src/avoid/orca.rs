//! ORCA.

use super::LocalModel;

/// Optimal reciprocal collision avoidance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orca {
    /// Seconds ahead for which a velocity must be safe from other agents. [Limit: > 0]
    pub time_horizon: f32,
    /// Seconds ahead for which a velocity must be safe from obstacles. [Limit: > 0]
    pub time_horizon_obstacles: f32,
}

impl Default for Orca {
    fn default() -> Self {
        Self { time_horizon: 2.0, time_horizon_obstacles: 0.7 }
    }
}

impl LocalModel for Orca {}
