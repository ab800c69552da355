//! Groups of agents.

use super::avoid::Unavoiding;
use super::flow::Governed;
use super::steer::What;
use super::surface::is_default;
use super::{Avoid, Body, Colour, Goal, Mark, Number, Place, Source, Steer, Vehicle, WrapAround, source};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Agents that are alike: where they start, where they go, what bodies they have, how they avoid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// A name for people and for `--set`. Without it, `group-1` for the first.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// How many. Without it, as many as the place or the sources say. Limit: 1 to 20,000,000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u64>,
    /// Where they start.
    pub place: Place,
    /// Where they go. Without it they stay.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub goal: Option<Goal>,
    /// They enter one at a time instead of being there from the start.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "source::one_or_many::deserialize")]
    #[schemars(schema_with = "source::one_or_many::schema")]
    pub source: Vec<Source>,
    /// Seconds they stand at their place before they set off. Limit: >= 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wait: Option<Number>,
    /// Their bodies.
    #[serde(default)]
    pub body: Body,
    /// How fast they walk.
    #[serde(default)]
    pub speed: Speed,
    /// Greatest change of velocity, m/s². Without it, the library's default (5). Limit: > 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub acceleration: Option<Number>,
    /// Greatest change of heading, degrees a second. Without it, no limit. The ends of a body that is no disc turn no faster than the
    /// agent likes to walk besides. Limit: > 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turn_rate: Option<Number>,
    /// How far beside the straight way to what it chose a body may get while it turns, metres: more than 0 makes it a
    /// robot on two wheels, and taken to be larger by so much. It needs a `turn_rate`. Limit: 0 to 10.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tracking_error: Option<Number>,
    /// Height of the centre above the ground at the start, metres; more than 0 for those who fly. Limit: 0 to 20000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub altitude: Option<Number>,
    /// Direction of the body at the start, degrees counter-clockwise from +x. Without it, towards the goal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heading: Option<Number>,
    /// Right of way: of two agents the one with the lower priority does more of the avoiding; a difference of 1
    /// leaves all of it to that one.
    #[serde(default, skip_serializing_if = "is_default")]
    pub priority: f64,
    /// The layers they are on. Limit: 0 to 31 each.
    #[serde(default = "first_layer", skip_serializing_if = "is_first_layer")]
    pub layers: Vec<u8>,
    /// The layers they avoid. Without it, all. Limit: 0 to 31 each.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub avoids: Option<Vec<u8>>,
    /// The fields that govern where they go, beside their own ways or in place of them. Not for those who steer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field: Option<Governed>,
    /// What they steer by, instead of walking along their ways.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steer: Option<Steer>,
    /// How fast those who steer are at the start, along their `heading`, m/s. Without it, they stand. Limit: >= 0, at most
    /// 1000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start_speed: Option<Number>,
    /// What the bodies of those who steer can do; speed, acceleration and turning follow from it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vehicle: Option<Vehicle>,
    /// A ball that those who steer leave on one side and enter on the other. Only without `guard`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wrap_around: Option<WrapAround>,
    /// What none of them ever gets into, by name: surfaces, from the side from which each is seen, obstacles, `"obstacles"` or
    /// `"everything"`. Without it, nothing but what `guard` keeps them off. Not with `wrap_around`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solid: Option<What>,
    /// What `look_ahead` and `keep_right` are where they are not given.
    #[serde(default, skip_serializing_if = "is_default")]
    pub preset: Preset,
    /// Whether agents look ahead: they go where there is room, keep a time gap to the agent ahead, and turn from agents that
    /// come the other way. Without it, agents that do not steer do, unless their `preset` says otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub look_ahead: Option<bool>,
    /// Seconds: an agent that looks ahead walks no faster than the gap to the agent ahead divided by its time gap. Without it,
    /// 1.15. Limit: 0.05 to 10.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_gap: Option<Number>,
    /// Breadth across its way, metres, within which an agent that looks ahead has another ahead of it; no less than that of
    /// its body. Without it, 0.415. Limit: 0 to 10.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shoulders: Option<f64>,
    /// Metres that agents that look ahead like to keep from agents that come the other way or stay where they are; the nearer
    /// they are, the less of it counts. Without it, 0.4. Limit: 0 to 10.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub personal_space: Option<f64>,
    /// Seconds in which an agent that looks ahead comes to the velocity it would like, across its way in half
    /// of them; 0: at once, as hard as it can. Without it, 0.45. Limit: 0 to 10.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relaxation_time: Option<f64>,
    /// Greatest angle by which an agent that looks ahead turns from one that comes the other way, degrees. An undecided
    /// meeting is passed on the right; negative: on the left. Agents that do not look ahead are turned by it all the time.
    /// Without it, what the `preset` says: 20, or 0 for agents that do not look ahead, or 8. Limit: -28 to 28.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub keep_right: Option<f64>,
    /// Whether agents that cannot pass each other agree who steps aside. Without it, those who do not steer do.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resolve: Option<bool>,
    /// How they avoid others. Without it, by ORCA, or not at all if they steer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub avoid: Option<Avoid>,
    /// Whether the guard keeps them from overlapping others and walls. Two of groups without it may overlap. Without this
    /// key, it does, but for `avoid.rvo_lab` and those who steer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub guard: Option<bool>,
    /// Colour in pictures. Without it, the next of the palette.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<Colour>,
    /// What they look like in pictures. Without it, as their bodies are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mark: Option<Mark>,
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
        }
    }
}

/// Which agents are imitated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Preset {
    /// People, as they are measured in experiments: agents look ahead.
    #[default]
    Pedestrian,
    /// The agents of the labs and of animation: they head straight for their goals, turned to the right by 8 degrees, and
    /// leave all else to the local model. They are faster, and as dense as bodies can be.
    Animation,
}

/// Speeds, metres a second.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Speed {
    /// The speed they walk at when nothing hinders them. Limit: >= 0, at most 1000.
    pub preferred: Number,
    /// The speed they never exceed. Without it, 1.8, or the preferred speed where that is more. Limit: at least
    /// `preferred`.
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
    /// How they avoid others: as the key says, else by ORCA, or not at all if they steer.
    pub fn local_model(&self) -> Avoid {
        self.avoid.clone().unwrap_or_else(|| match self.steer {
            None => Avoid::default(),
            Some(_) => Avoid::None(Unavoiding::default()),
        })
    }

    /// Whether the guard keeps them from overlapping: as the key says, else all but those who steer and those with the
    /// labs' algorithm.
    pub fn is_guarded(&self) -> bool {
        self.guard.unwrap_or(self.steer.is_none() && !matches!(self.avoid, Some(Avoid::RvoLab(_))))
    }

    /// The name of the group at this position of a scene: its own, or `group-1` for the first.
    pub(crate) fn name_at(name: &str, position: usize) -> String {
        if name.is_empty() { format!("group-{}", position + 1) } else { name.to_owned() }
    }
}
