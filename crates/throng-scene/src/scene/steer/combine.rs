//! Ways to combine behaviours, and to cure them.

use super::{Near, Noise, Steer, Target, What, Who, parameters};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::{Deserialize, Deserializer, Serialize, de};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;

parameters! {
    /// A part of a sum.
    Weighted {
        /// What its force is multiplied with. Without it, 1. Limit: >= 0.
        weight: Option<f64>,
        /// The part.
        of: Steer,
    }
    /// In order, each part is asked with a probability.
    Dithering {
        /// How many seconds what was drawn holds; 0: it is drawn in every step. Without it, 0.1. Limit: >= 0.
        every: Option<f64>,
        /// The parts, the most important first.
        of: Vec<Probable>,
    }
    /// A part that is asked with a probability.
    Probable {
        /// How probably. Without it, 1. Limit: 0 to 1.
        probability: Option<f64>,
        /// The part.
        of: Steer,
    }
    /// Forces are granted in order until there is none left.
    Allocation {
        /// How much there is, as a part of the vehicle's top force. Without it, 1. Limit: > 0 to 1.
        budget: Option<f64>,
        /// The parts, the most important first.
        of: Vec<Steer>,
    }
    /// Goes in the one direction of many that is the most interesting less its danger.
    ContextSteering {
        /// The parts: what is interesting.
        of: Vec<Weighted>,
        /// How many directions it weighs all round; those who fly as many again above and below. Without it, 16. Limit: 4
        /// to 64.
        directions: Option<u64>,
        /// In how many seconds a touch is no danger yet. Without it, 2. Limit: > 0.
        horizon: Option<f64>,
        /// Who is in the way. Without it, anybody.
        who: Option<Who>,
        /// What is in the way. Without it, everything.
        what: Option<What>,
    }
    /// One behaviour at a time: a state machine.
    Switch {
        /// The name of the state it begins in.
        first: String,
        /// The states, by name.
        states: BTreeMap<String, State>,
    }
    /// A state of a switch.
    State {
        /// What is done in it.
        of: Steer,
        /// When it is left, and for which state: the first whose condition holds.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        exits: Vec<Exit>,
    }
    /// A way out of a state.
    Exit {
        /// The name of the state it leads to.
        to: String,
        /// When.
        when: Condition,
    }
    /// A target and a distance.
    Apart {
        /// Whom or what.
        target: Target,
        /// How far, metres. Limit: >= 0.
        than: f64,
    }
    /// How many are near.
    Crowd {
        /// Where. Without it, as far as the agent sees.
        near: Option<Near>,
        /// How many at least.
        least: u64,
    }
    /// Bounds of a figure of the rules.
    Counted {
        /// The name of the figure.
        of: String,
        /// At least so much. Without it, however little.
        at_least: Option<f64>,
        /// At most so much. Without it, however much.
        at_most: Option<f64>,
    }
    /// Nothing to say.
    #[derive(Default)]
    Nothing {}
    /// Asks a part only every so often, and keeps what it said in between.
    Amortised {
        /// Seconds from one time to the next. Limit: > 0.
        every: f64,
        /// What is asked.
        of: Box<Steer>,
    }
    /// Keeps the force of a part for a while after the part has nothing more to correct, fading.
    Hold {
        /// How long, seconds. Limit: > 0.
        seconds: f64,
        /// What is held.
        of: Box<Steer>,
    }
    /// Lets direction and speed of what a part would like waver by noise.
    Irregular {
        /// The most that the direction wavers, degrees. Without it, 10. Limit: 0 to 85.
        angle: Option<f64>,
        /// The most that the speed wavers, as a part of it. Without it, 0.08. Limit: 0 to 1.
        speed: Option<f64>,
        /// How both waver.
        noise: Option<Noise>,
        /// What wavers.
        of: Box<Steer>,
    }
    /// A part that goes no faster and pushes no harder than these.
    Limited {
        /// The speed that the part takes for the top speed, m/s. Without it, that of the vehicle. Limit: > 0.
        max_speed: Option<f64>,
        /// The most force it has, newtons. Without it, that of the vehicle. Limit: > 0.
        max_force: Option<f64>,
        /// What is limited.
        of: Box<Steer>,
    }
    /// Stops where a part would run into somebody, and waits for a moment of random length.
    StopAndWait {
        /// Whom it stops for. Without it, anybody.
        who: Option<Who>,
        /// It stops this many seconds before it would touch somebody. Without it, 0.3. Limit: > 0.
        within: Option<f64>,
        /// The least it waits, seconds. Without it, 0.2. Limit: > 0.
        least_wait: Option<f64>,
        /// The most it waits, seconds. Without it, 1. Limit: at least `least_wait`.
        most_wait: Option<f64>,
        /// For how many seconds its way must be clear before it goes on. Without it, 0.5. Limit: >= 0.
        clear: Option<f64>,
        /// What it would do.
        of: Box<Steer>,
    }
}

/// The sum of all parts, each times its weight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WeightedSum(pub Vec<Weighted>);

/// The sum of parts in order, each times its weight, up to the vehicle's top force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RunningSum(pub Vec<Weighted>);

/// The first part that has anything to correct. In files a list of parts, or `{ epsilon = 0.01, of = [ .. ] }`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Priority {
    /// A force no greater than this, newtons, is nothing to correct. Without it, 0. Limit: >= 0.
    pub epsilon: Option<f64>,
    /// The parts, the most important first.
    pub of: Vec<Steer>,
}

/// Something that holds or not, for one agent in one step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Condition {
    /// A target is there, and nearer than so many metres.
    Nearer(Apart),
    /// A target is farther than so many metres, or not there.
    Farther(Apart),
    /// It has been in the state for so many seconds. Limit: >= 0.
    After(f64),
    /// There are at least so many near it.
    Crowded(Crowd),
    /// The behaviour of the state had nothing to correct in its last step.
    Done(Nothing),
    /// By chance, so many times a second on average. Limit: >= 0.
    Chance(f64),
    /// A figure of the rules is within bounds.
    Figure(Counted),
    /// The other does not hold.
    Not(Box<Condition>),
    /// All hold.
    All(Vec<Condition>),
    /// One holds at least.
    Any(Vec<Condition>),
}

/// What `{ epsilon = .., of = [ .. ] }` says.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Table {
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
                let Table { epsilon, of } = Table::deserialize(MapAccessDeserializer::new(map))?;
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
        let table = generator.subschema_for::<Table>();
        json_schema!({ "anyOf": [list, table] })
    }
}
