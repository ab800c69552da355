//! The vehicles of those who steer.

use super::steer::Position;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the bodies of a group that steers can do. What is not said is that of a pedestrian of mass 1, whose forces are
/// accelerations.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Vehicle {
    /// How it holds itself. Without it, on the ground.
    pub kind: Option<VehicleKind>,
    /// Kilograms. Without it, 1. Limit: > 0.
    pub mass: Option<f64>,
    /// The most force in any direction, newtons. Without it, 5. Limit: > 0.
    pub max_force: Option<f64>,
    /// The most force along each of its axes.
    pub forces: Option<Forces>,
    /// The speed it never exceeds, m/s. Without it, 1.8. Limit: > 0, at most 1000.
    pub max_speed: Option<f64>,
    /// The speed it never falls below, m/s. Without it, 0. Limit: 0 to `max_speed`.
    pub min_speed: Option<f64>,
    /// How fast it turns at most, degrees a second. Without it, no limit. Limit: > 0.
    pub turn_rate: Option<f64>,
    /// Part of the top speed below which it cannot turn freely: at rest only straight ahead; 0 for one that turns on the
    /// spot. Without it, 0. Limit: 0 to 1.
    pub low_speed: Option<f64>,
    /// Seconds in which it makes up all but a third of the way to a velocity that it wants. Without it, 0.25. Limit: >= 0.
    pub response: Option<f64>,
    /// Seconds over which its acceleration is smoothed. Without it, 0. Limit: >= 0.
    pub smoothing: Option<f64>,
    /// How motion follows from force. Without it, semi-implicit.
    pub integrator: Option<Integrator>,
}

/// A ball that nobody leaves: who does enters on the other side.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WrapAround {
    /// Its middle. Without it, `[0, 0]`.
    #[serde(default)]
    pub center: Position,
    /// Its radius, metres. Limit: > 0.
    pub radius: f64,
}

/// How a vehicle holds itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum VehicleKind {
    /// On the ground, upright.
    Ground,
    /// Flying level.
    Level,
    /// Flying, and leaning into its turns, as birds and aircraft do.
    Banking,
}

/// How motion follows from force in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// First the velocity, then the place with the new velocity.
    SemiImplicit,
    /// The place with the velocity of the start of the step.
    Euler,
}

/// The most force along each axis of a vehicle, newtons. Without one, no limit of its own. Limit: >= 0.
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
