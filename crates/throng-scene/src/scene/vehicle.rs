//! The vehicles of agents that steer.

use super::steer::Position;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The vehicle of a group that steers. What is not given is as for a pedestrian of mass 1, for which forces equal
/// accelerations.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Vehicle {
    /// How its body is oriented. Without it, on the ground.
    pub kind: Option<VehicleKind>,
    /// Kilograms. Without it, 1. Limit: > 0.
    pub mass: Option<f64>,
    /// The greatest force in any direction, newtons. Without it, 5. Limit: > 0.
    pub max_force: Option<f64>,
    /// The greatest force along each of its axes.
    pub forces: Option<Forces>,
    /// The greatest speed, m/s. Without it, 1.8. Limit: > 0, at most 1000.
    pub max_speed: Option<f64>,
    /// The least speed, m/s. Without it, 0. Limit: 0 to `max_speed`.
    pub min_speed: Option<f64>,
    /// Greatest turn rate, degrees a second. Without it, no limit. Limit: > 0.
    pub turn_rate: Option<f64>,
    /// Part of the top speed below which its turning is limited: at rest it can only go straight ahead; 0 lets it turn
    /// on the spot. Without it, 0. Limit: 0 to 1.
    pub low_speed: Option<f64>,
    /// Seconds in which it completes all but a third of a change to the velocity it aims for. Without it, 0.25. Limit:
    /// >= 0.
    pub response: Option<f64>,
    /// Seconds over which its acceleration is smoothed. Without it, 0. Limit: >= 0.
    pub smoothing: Option<f64>,
    /// How motion is integrated. Without it, `semi_implicit`.
    pub integrator: Option<Integrator>,
}

/// A sphere that agents do not leave: an agent that crosses it enters on the other side.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WrapAround {
    /// Its centre. Without it, `[0, 0]`.
    #[serde(default)]
    pub center: Position,
    /// Its radius, metres. Limit: > 0.
    pub radius: f64,
}

/// How a vehicle's body is oriented.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum VehicleKind {
    /// On the ground, upright.
    Ground,
    /// Flying level.
    Level,
    /// Flying, and banking into its turns, as birds and aircraft do.
    Banking,
}

/// How motion is integrated in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// First the velocity, then the position with the new velocity.
    SemiImplicit,
    /// The position with the velocity of the start of the step.
    Euler,
}

/// The greatest force along each axis of a vehicle, newtons. Without a value, the axis has no limit of its own. Limit:
/// >= 0.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Forces {
    /// Forwards.
    pub thrust: Option<f64>,
    /// Backwards.
    pub brake: Option<f64>,
    /// To either side.
    pub side: Option<f64>,
    /// Up and down.
    pub up: Option<f64>,
}
