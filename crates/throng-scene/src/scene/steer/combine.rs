//! Combinations of behaviours, and modifiers of a behaviour.

use super::{GroupFilter, Near, Noise, ObstacleNames, Steer, Target, parameters};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::{Deserialize, Deserializer, Serialize, de};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;

parameters! {
    /// A part of a sum.
    Weighted {
        /// Factor of its force. Without it, 1. Limit: >= 0.
        weight: Option<f64>,
        /// The behaviour of this part.
        of: Steer,
    }
    /// Parts in order, each evaluated with a probability.
    Dithering {
        /// Seconds for which a draw holds; 0: each step draws again. Without it, 0.1. Limit: >= 0.
        every: Option<f64>,
        /// The parts, the most important first.
        of: Vec<Probable>,
    }
    /// A part that is evaluated with a probability.
    Probable {
        /// The probability. Without it, 1. Limit: 0 to 1.
        probability: Option<f64>,
        /// The behaviour of this part.
        of: Steer,
    }
    /// Parts in order, each of which takes force from a budget until it is used up.
    Allocation {
        /// The budget, as a part of the vehicle's greatest force. Without it, 1. Limit: > 0 to 1.
        budget: Option<f64>,
        /// The parts, the most important first.
        of: Vec<Steer>,
    }
    /// Moves in the direction with the greatest interest minus danger, of a set of directions.
    ContextSteering {
        /// The parts: their forces are the interest.
        of: Vec<Weighted>,
        /// Number of directions in the horizontal plane; agents that fly evaluate as many again above and below it.
        /// Without it, 16. Limit: 4 to 64.
        directions: Option<u64>,
        /// Seconds beyond which a collision is no danger. Without it, 2. Limit: > 0.
        horizon: Option<f64>,
        /// The agents that are a danger. Without it, all agents.
        groups: Option<GroupFilter>,
        /// The obstacles that are a danger. Without it, everything.
        obstacles: Option<ObstacleNames>,
    }
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
    /// Evaluates a part only at intervals, and keeps its result in between.
    Amortised {
        /// Seconds between two evaluations. Limit: > 0.
        every: f64,
        /// The part.
        of: Box<Steer>,
    }
    /// Keeps the force of a part for some time after the part has nothing to correct, and fades it out.
    Hold {
        /// The time, seconds. Limit: > 0.
        seconds: f64,
        /// The part.
        of: Box<Steer>,
    }
    /// Adds noise to the direction and speed of a part.
    Irregular {
        /// Greatest deviation of the direction, degrees. Without it, 10. Limit: 0 to 85.
        angle: Option<f64>,
        /// Greatest deviation of the speed, as a part of it. Without it, 0.08. Limit: 0 to 1.
        speed: Option<f64>,
        /// The noise of both.
        noise: Option<Noise>,
        /// The part.
        of: Box<Steer>,
    }
    /// Limits the speed and force of a part.
    Limited {
        /// The speed that the part uses as the greatest speed, m/s. Without it, that of the vehicle. Limit: > 0.
        max_speed: Option<f64>,
        /// The greatest force of the part, newtons. Without it, that of the vehicle. Limit: > 0.
        max_force: Option<f64>,
        /// The part.
        of: Box<Steer>,
    }
    /// Stops where a part would collide with an agent, and waits for a random time.
    StopAndWait {
        /// The agents that it stops for. Without it, all agents.
        groups: Option<GroupFilter>,
        /// It stops this many seconds before contact. Without it, 0.3. Limit: > 0.
        within: Option<f64>,
        /// The least waiting time, seconds. Without it, 0.2. Limit: > 0.
        least_wait: Option<f64>,
        /// The greatest waiting time, seconds. Without it, 1. Limit: at least `least_wait`.
        most_wait: Option<f64>,
        /// Seconds for which its way must be clear before it continues. Without it, 0.5. Limit: >= 0.
        clear: Option<f64>,
        /// The part.
        of: Box<Steer>,
    }
}

/// The sum of all parts, each times its weight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WeightedSum(pub Vec<Weighted>);

/// The sum of parts in order, each times its weight, up to the vehicle's greatest force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RunningSum(pub Vec<Weighted>);

/// The first part that has something to correct. In files a list of parts, or `{ epsilon = 0.01, of = [ .. ] }`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Priority {
    /// A force no greater than this, newtons, counts as nothing to correct. Without it, 0. Limit: >= 0.
    pub epsilon: Option<f64>,
    /// The parts, the most important first.
    pub of: Vec<Steer>,
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

/// The table `{ epsilon = .., of = [ .. ] }`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PartsTable {
    epsilon: Option<f64>,
    of: Vec<Steer>,
}

impl From<Vec<Steer>> for Priority {
    fn from(of: Vec<Steer>) -> Self {
        Self { epsilon: None, of }
    }
}

impl<'de> Deserialize<'de> for Priority {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl<'de> de::Visitor<'de> for Visitor {
            type Value = Priority;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a list of behaviours, or { epsilon = 0.01, of = [ .. ] }")
            }
            fn visit_seq<A: de::SeqAccess<'de>>(self, seq: A) -> Result<Priority, A::Error> {
                Vec::deserialize(SeqAccessDeserializer::new(seq)).map(Priority::from)
            }
            fn visit_map<A: de::MapAccess<'de>>(self, map: A) -> Result<Priority, A::Error> {
                let PartsTable { epsilon, of } = PartsTable::deserialize(MapAccessDeserializer::new(map))?;
                Ok(Priority { epsilon, of })
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

impl JsonSchema for Priority {
    fn schema_name() -> Cow<'static, str> {
        "Priority".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let list = generator.subschema_for::<Vec<Steer>>();
        let table = generator.subschema_for::<PartsTable>();
        json_schema!({ "anyOf": [list, table] })
    }
}
