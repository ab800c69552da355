//! Interventions: changes that are made to a scene while it runs.

use super::{Obstacle, Point};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A change that is made while the scene runs: a wall is put before agents, an agent is moved, a crowd is dropped in.
/// The studio records what the user does to a running scene in this form. Interventions are made in the order of the
/// file; a run with the same interventions gives the same bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Intervention {
    /// The time, seconds. The change is made after the step that ends nearest to it; at 0 before the first step. Limit:
    /// >= 0.
    pub time: f64,
    /// What changes.
    pub change: Change,
}

impl Intervention {
    /// Returns the number of steps after which it is made, in a world with steps of this many seconds.
    pub fn begins(&self, seconds: f64) -> u64 {
        (self.time / seconds).round() as u64
    }
}

/// A change of a running scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Change {
    /// Adds agents.
    Add(AddAgents),
    /// Removes the agent with this number.
    Remove(u32),
    /// Moves an agent along a path, as a hand does.
    Grab(Led),
    /// Makes an agent move towards a point that moves along a path, as fast as it can.
    Lead(Led),
    /// Makes agents move away from a point that moves along a path.
    Push(Push),
    /// Gives all agents of a group another goal.
    Goal(NewGoal),
    /// Adds an obstacle.
    Obstacle(Obstacle),
    /// Removes an obstacle: opens a door. The number is that of the obstacle in the scene, from 0; obstacles that
    /// interventions add count on in their order.
    Open(u32),
    /// Puts a removed obstacle back: closes a door. The number is that of the obstacle, as for `open`.
    Close(u32),
}

/// Agents that are added to a group. They are copies of the agents that the group has at the start, at rest, with their
/// journeys.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AddAgents {
    /// The group, by name.
    pub group: String,
    /// The number of agents; fewer are added if there is no room for all. Limit: 1 to 10,000.
    pub count: u32,
    /// The middle of the disc in which they stand.
    pub at: Point,
    /// The radius of the disc, metres. Without it, as large as needed. Limit: > 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
}

/// An agent, and the points that it is brought to or follows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Led {
    /// The agent, by number.
    pub agent: u32,
    /// One point for each step, from the time of the intervention on. Limit: at least 1.
    pub path: Vec<Point>,
}

/// A point that drives agents away.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Push {
    /// One point for each step, from the time of the intervention on. Limit: at least 1.
    pub path: Vec<Point>,
    /// Agents within this distance move away, metres. Limit: > 0.
    pub radius: f64,
}

/// A goal that replaces the goals of a group.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NewGoal {
    /// The group, by name.
    pub group: String,
    /// The goal.
    pub point: Point,
}
