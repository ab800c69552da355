//! Combinations of behaviours, and modifiers of a behaviour.

use super::{Near, Steer, Target, parameters};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

parameters! {
    /// One behaviour at a time: a state machine.
    Switch {
        /// The name of the first state.
        first: String,
        /// The states, by name.
        states: BTreeMap<String, State>,
    }
    /// A state of a switch.
    State {
        /// The behaviour of the state.
        of: Steer,
        /// The exits of the state: the agent takes the first exit with a condition that holds.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        exits: Vec<Exit>,
    }
    /// An exit of a state.
    Exit {
        /// The name of the next state.
        to: String,
        /// The condition.
        when: Condition,
    }
    /// A target and a distance.
    Apart {
        /// The target.
        target: Target,
        /// The distance, metres. Limit: >= 0.
        than: f64,
    }
    /// A number of neighbours.
    Crowd {
        /// The neighbourhood. Without it, the reach of the neighbour search.
        near: Option<Near>,
        /// The least number.
        least: u64,
    }
    /// Bounds of a figure of the rules.
    Counted {
        /// The name of the figure.
        of: String,
        /// Lower bound. Without it, none.
        at_least: Option<f64>,
        /// Upper bound. Without it, none.
        at_most: Option<f64>,
    }
    /// An empty table.
    #[derive(Default)]
    Nothing {}
}

/// A condition for one agent in one step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Condition {
    /// A target exists, and is nearer than a distance.
    Nearer(Apart),
    /// A target is farther than a distance, or does not exist.
    Farther(Apart),
    /// The state has lasted for this many seconds. Limit: >= 0.
    After(f64),
    /// A number of neighbours is near.
    Crowded(Crowd),
    /// The behaviour of the state had nothing to correct in its last step.
    Done(Nothing),
    /// At random, this many times a second on average. Limit: >= 0.
    Chance(f64),
    /// A figure of the rules is within bounds.
    Figure(Counted),
    /// The condition does not hold.
    Not(Box<Condition>),
    /// All conditions hold.
    All(Vec<Condition>),
    /// At least one condition holds.
    Any(Vec<Condition>),
}
