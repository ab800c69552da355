//! Groups of agents.

use super::flow::Governed;
use super::steer::ObstacleNames;
use super::surface::is_default;
use super::{AgentShape, Body, Colour, Motor, Number, Source, WrapAround, source};
use crate::registry::{Avoid, GivenParameters, Goal, Place, Steer};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use throng::avoid::{NoAvoidance, Orca};
use throng::motion::Vehicle;
use throng::parameters::Parameters;

/// A group of agents with the same start, goal, body and avoidance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// The name, for people and for `--set`. Without it, `group-1` for the first group.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// The number of agents. Without it, as many as the place or the sources define. Limit: 1 to 20,000,000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u64>,
    /// Where the agents start.
    pub place: Place,
    /// Where the agents go. Without it, they stay.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub goal: Option<Goal>,
    /// Sources: the agents enter one at a time instead of at the start.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "source::one_or_many::deserialize")]
    #[schemars(schema_with = "source::one_or_many::schema")]
    pub source: Vec<Source>,
    /// Seconds that the agents stand at their place before they set off. Limit: >= 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wait: Option<Number>,
    /// The agents' bodies.
    #[serde(default)]
    pub body: Body,
    /// What moves the agents. Without it, a vehicle if they steer or have a `vehicle`, two wheels if they have a
    /// `tracking_error`, and else a holonomic motor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motor: Option<Motor>,
    /// The agents' speeds.
    #[serde(default)]
    pub speed: Speed,
    /// Greatest change of velocity, m/s². Without it, the library's default (5). Limit: > 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub acceleration: Option<Number>,
    /// Greatest change of heading, degrees a second. Without it, no limit. Besides, the ends of a body that is not a
    /// disc turn no faster than the agent's preferred speed. Limit: > 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turn_rate: Option<Number>,
    /// Greatest distance, metres, between a body that turns and the straight path to its chosen velocity. A value above
    /// 0 makes the agent a differential-drive robot, which avoidance takes to be larger by this distance. It needs a
    /// `turn_rate`. Limit: 0 to 10.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tracking_error: Option<Number>,
    /// Height of the centre above the ground at the start, metres; above 0 for agents that fly. Limit: 0 to 20000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub altitude: Option<Number>,
    /// Direction of the body at the start, degrees counter-clockwise from +x. Without it, towards the goal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heading: Option<Number>,
    /// Right of way: of two agents, the agent with the lower priority does more of the avoiding; with a difference of
    /// 1, it does all of it.
    #[serde(default, skip_serializing_if = "is_default")]
    pub priority: f64,
    /// The layers that the agents are on. Limit: 0 to 31 each.
    #[serde(default = "first_layer", skip_serializing_if = "is_first_layer")]
    pub layers: Vec<u8>,
    /// The layers that the agents avoid. Without it, all. Limit: 0 to 31 each.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub avoids: Option<Vec<u8>>,
    /// The fields that guide the agents, in addition to their routes or their behaviour, or in place of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field: Option<Governed>,
    /// The steering behaviour of the agents, which replaces walking along their routes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steer: Option<Steer>,
    /// Speed at the start, along the `heading`, m/s. Without it, they stand. Limit: >= 0, at most 1000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start_speed: Option<Number>,
    /// The vehicle that moves the agents: it determines their speed, acceleration and turn rate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vehicle: Option<GivenParameters<Vehicle>>,
    /// A sphere that the agents leave on one side and enter on the other, where `guard` and `solid` leave room for them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wrap_around: Option<WrapAround>,
    /// What the agents never enter, by name: surfaces, from the side each is seen from, obstacles, `"obstacles"` or
    /// `"everything"`. Without it, only what `guard` keeps them from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solid: Option<ObstacleNames>,
    /// The defaults of `look_ahead` and `keep_right`.
    #[serde(default, skip_serializing_if = "is_default")]
    pub preset: Preset,
    /// Whether agents look ahead: they walk where there is room, keep a time gap to the agent ahead, and turn away from
    /// oncoming agents. Without it, agents that do not steer look ahead, unless their `preset` says otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub look_ahead: Option<bool>,
    /// Seconds: an agent that looks ahead walks no faster than the gap to the agent ahead divided by its time gap.
    /// Without it, 1.15. Limit: 0.05 to 10.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_gap: Option<Number>,
    /// Width, metres, of the strip along its direction within which an agent that looks ahead has another agent ahead
    /// of it; at least the width of its body. Without it, 0.415. Limit: 0 to 10.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shoulders: Option<f64>,
    /// Distance, metres, that agents that look ahead prefer to keep from oncoming and standing agents. The nearer the
    /// other agent is, the less of the distance counts. Without it, 0.4. Limit: 0 to 10.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub personal_space: Option<f64>,
    /// Seconds in which an agent that looks ahead reaches its preferred velocity, and half as many across its
    /// direction; 0: at once, as far as its acceleration allows. Without it, 0.45. Limit: 0 to 10.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relaxation_time: Option<f64>,
    /// Greatest angle by which an agent that looks ahead turns away from an oncoming agent, degrees. If neither side is
    /// preferred, it passes on the right; with a negative angle, on the left. Agents that do not look ahead always turn
    /// by this angle. Without it, the `preset` decides: 20 for agents that look ahead and 0 for others, or 8. Limit:
    /// -28 to 28.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub keep_right: Option<f64>,
    /// Whether two agents that cannot pass each other agree which of them steps aside. Without it, agents that do not
    /// steer do.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resolve: Option<bool>,
    /// How the agents avoid each other. Without it, by ORCA, or not at all if they steer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub avoid: Option<Avoid>,
    /// Whether the guard keeps the agents from overlapping other agents and walls. Agents of two groups without guard
    /// may overlap. Without it, the guard is on, except for `avoid.rvo_lab` and agents that steer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub guard: Option<bool>,
    /// Colour in pictures. Without it, the next of the palette.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<Colour>,
    /// Symbol of the agents in pictures. Without it, the shape of their bodies.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mark: Option<AgentShape>,
    /// A file with the body of the agents, if they are people: a `.glb` file with a skin and the joints of a human.
    /// A relative name refers to the scene file's folder. Without it, throng's own people.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub figure: Option<String>,
}

impl Default for Group {
    fn default() -> Self {
        Self {
            name: String::new(),
            count: None,
            place: Place::default(),
            goal: None,
            source: vec![],
            wait: None,
            body: Body::default(),
            motor: None,
            speed: Speed::default(),
            acceleration: None,
            turn_rate: None,
            tracking_error: None,
            altitude: None,
            heading: None,
            priority: 0.0,
            layers: first_layer(),
            avoids: None,
            field: None,
            steer: None,
            start_speed: None,
            vehicle: None,
            wrap_around: None,
            solid: None,
            preset: Preset::Pedestrian,
            look_ahead: None,
            time_gap: None,
            shoulders: None,
            personal_space: None,
            relaxation_time: None,
            keep_right: None,
            resolve: None,
            avoid: None,
            guard: None,
            colour: None,
            mark: None,
            figure: None,
        }
    }
}

/// The kind of agents that a group imitates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Preset {
    /// People as measured in experiments: agents look ahead.
    #[default]
    Pedestrian,
    /// The agents of the labs and of animation: they head straight for their goals, turned to the right by 8 degrees,
    /// and leave all avoidance to the local model. They are faster, and as dense as bodies can be.
    Animation,
}

/// Speeds, metres a second.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Speed {
    /// The speed of an agent that nothing hinders, m/s. Limit: >= 0, at most 1000.
    pub preferred: Number,
    /// The greatest speed, m/s. Without it, 1.8, or the preferred speed if that is greater. Limit: at least `preferred`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<Number>,
}

impl Default for Speed {
    fn default() -> Self {
        Self { preferred: Number::Constant(1.3), max: None }
    }
}

pub(super) fn first_layer() -> Vec<u8> {
    vec![0]
}
#[allow(clippy::ptr_arg)]
pub(super) fn is_first_layer(layers: &Vec<u8>) -> bool {
    *layers == [0]
}
pub(super) fn yes() -> bool {
    true
}
pub(super) fn is_yes(yes: &bool) -> bool {
    *yes
}

impl Group {
    /// Returns the local model: that of the key `avoid`, or else ORCA, or no avoidance for agents that steer.
    pub fn local_model(&self) -> Avoid {
        self.avoid.clone().unwrap_or_else(|| {
            Avoid::named(match self.steer {
                None => Orca::NAME,
                Some(_) => NoAvoidance::NAME,
            })
        })
    }

    /// Returns the name of the group at this position of a scene: its own name, or `group-1` for the first.
    pub(crate) fn name_at(name: &str, position: usize) -> String {
        if name.is_empty() { format!("group-{}", position + 1) } else { name.to_owned() }
    }
}
