//! The state machine of a behaviour.

use super::super::notes::Notes;
use super::xml::{Xml, children};
use crate::error::{Error, Kind};
use crate::geometry::DVec2;
use crate::import::short;
use crate::scene::{Circle, Number, Rectangle, Region};
use roxmltree::Node;
use std::collections::BTreeMap;

/// The contents of a behaviour.
#[derive(Debug, Default)]
pub(super) struct Machine {
    /// Goals by the ids of their sets, in order.
    pub sets: BTreeMap<u64, Vec<Aim>>,
    pub states: BTreeMap<String, State>,
}

/// A goal.
#[derive(Clone, Debug)]
pub(super) struct Aim {
    pub id: u64,
    pub shape: MengeRegion,
    pub weight: f64,
    /// How many agents may have the goal at a time.
    pub capacity: f64,
}

/// The shape of a goal or a region.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum MengeRegion {
    Point(DVec2),
    /// The centre, half the sides, the angle in degrees.
    Box(DVec2, DVec2, f64),
    Disc(DVec2, f64),
}

/// A state.
#[derive(Debug, Default)]
pub(super) struct State {
    pub selector: Selector,
    pub velocity: Velocity,
    /// The transitions out of the state, in order.
    pub ways: Vec<Way>,
}

/// How an agent's goal is selected in a state.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum Selector {
    /// The agent's position.
    #[default]
    Stay,
    Explicit(u64, u64),
    /// The agent's position, mirrored: whether x and y change their signs.
    Mirror(bool, bool),
    /// The agent's position plus an offset.
    Offset(DVec2),
    Nearest(u64),
    Farthest(u64),
    Random(u64),
    Weighted(u64),
}

/// How an agent moves to its goal, as far as a scene can represent it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum Velocity {
    /// By the shortest path.
    #[default]
    Way,
    /// Not at all.
    Stand,
    /// By the vector field in this file.
    Field(String),
}

/// A transition out of a state.
#[derive(Clone, Debug)]
pub(super) struct Way {
    pub when: TransitionWhen,
    /// The target states, with weights; empty if the transition is not followed.
    pub to: Vec<(String, f64)>,
    /// Its description, for notes.
    pub name: String,
}

/// The condition of a transition. The conditions that a journey represents best come first.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum TransitionWhen {
    /// The agent is this near to its goal, metres.
    There(f64),
    /// A time has passed, seconds.
    Later(Number),
    /// Always.
    Now,
    /// The agent is in a region.
    In(MengeRegion),
    /// Any other condition.
    Other(String),
}

impl Machine {
    pub fn read(xml: &Xml, notes: &mut Notes) -> Result<Self, Error> {
        let root = xml.document.root_element();
        if root.tag_name().name() != "BFSM" {
            let message =
                format!("this is no behaviour of Menge's: its root is <{}>, not <BFSM>", root.tag_name().name());
            return Err(xml.wrong(root, Kind::NotAScene, message));
        }
        let mut machine = Self::default();
        for set in children(root, "GoalSet") {
            let goals = machine.sets.entry(xml.needed(set, "id")? as u64).or_default();
            for goal in children(set, "Goal") {
                goals.extend(aim(xml, goal, notes)?);
            }
        }
        for node in children(root, "State") {
            machine.states.insert(xml.text(node, "name")?.to_owned(), state(xml, node, notes)?);
        }
        for node in children(root, "Transition") {
            let (from, way) = (xml.text(node, "from")?, way(xml, node)?);
            for name in from.split(',').map(str::trim) {
                let Some(state) = machine.states.get_mut(name) else {
                    return Err(xml.wrong(
                        node,
                        Kind::UnknownKey,
                        format!("there is no state `{name}` for this transition to begin in"),
                    ));
                };
                state.ways.push(way.clone());
            }
            if let Some((name, _)) = way.to.iter().find(|(name, _)| !machine.states.contains_key(name)) {
                return Err(xml.wrong(
                    node,
                    Kind::UnknownKey,
                    format!("there is no state `{name}` for this transition to lead to"),
                ));
            }
        }
        for name in ["Task", "EventSystem", "VelModifier"] {
            if children(root, name).next().is_some() {
                notes.about(&format!("<{name}>"), "left out");
            }
        }
        Ok(machine)
    }
}

fn aim(xml: &Xml, node: Node, notes: &mut Notes) -> Result<Option<Aim>, Error> {
    let kind = xml.text(node, "type")?;
    let shape = match kind {
        "point" => MengeRegion::Point(DVec2::new(xml.needed(node, "x")?, xml.needed(node, "y")?)),
        "circle" => {
            MengeRegion::Disc(DVec2::new(xml.needed(node, "x")?, xml.needed(node, "y")?), xml.needed(node, "radius")?)
        }
        "AABB" => boxed(xml, node)?,
        "OBB" => {
            let (width, height) = (xml.needed(node, "width")?, xml.needed(node, "height")?);
            turned(xml, node, ["x", "y"], DVec2::new(width, height))?
        }
        other => {
            let shown = short(other);
            notes.about(&format!("goals of the kind `{shown}`"), "left out");
            return Ok(None);
        }
    };
    Ok(Some(Aim {
        id: xml.needed(node, "id")? as u64,
        shape,
        weight: xml.number(node, "weight")?.unwrap_or(1.0).clamp(0.0, 1e9),
        capacity: xml.number(node, "capacity")?.unwrap_or(f64::INFINITY).max(1.0),
    }))
}

fn boxed(xml: &Xml, node: Node) -> Result<MengeRegion, Error> {
    let low = DVec2::new(xml.needed(node, "min_x")?, xml.needed(node, "min_y")?);
    let high = DVec2::new(xml.needed(node, "max_x")?, xml.needed(node, "max_y")?);
    Ok(MengeRegion::Box(low.midpoint(high), (high - low).abs() * 0.5, 0.0))
}

/// Reads a box that is rotated about its lower left corner.
fn turned(xml: &Xml, node: Node, corner: [&str; 2], size: DVec2) -> Result<MengeRegion, Error> {
    let pivot = DVec2::new(xml.needed(node, corner[0])?, xml.needed(node, corner[1])?);
    let angle = xml.needed(node, "angle")?;
    let (sin, cos) = libm::sincos(angle.to_radians());
    Ok(MengeRegion::Box(pivot + DVec2::new(cos, sin).rotate(size * 0.5), size.abs() * 0.5, angle))
}

fn state(xml: &Xml, node: Node, notes: &mut Notes) -> Result<State, Error> {
    let mut state = State::default();
    let name = format!("state {}", node.attribute("name").unwrap_or_default());
    if let Some(selector) = children(node, "GoalSelector").next() {
        let set = || xml.needed(selector, "goal_set").map(|id| id as u64);
        let yes = |name: &str| selector.attribute(name).is_some_and(|said| said != "0" && said != "false");
        state.selector = match xml.text(selector, "type")? {
            "identity" => Selector::Stay,
            "explicit" => Selector::Explicit(set()?, xml.needed(selector, "goal")? as u64),
            "mirror" => Selector::Mirror(yes("mirror_x"), yes("mirror_y")),
            "nearest" | "nearest_nav_mesh" => Selector::Nearest(set()?),
            "farthest" | "farthest_nav_mesh" => Selector::Farthest(set()?),
            "random" => Selector::Random(set()?),
            "weighted" => Selector::Weighted(set()?),
            "offset" if selector.attribute("dist") == Some("c") => {
                Selector::Offset(DVec2::new(xml.needed(selector, "x_value")?, xml.needed(selector, "y_value")?))
            }
            other => {
                let shown = short(other);
                notes.about(
                    &name,
                    format!("goals that are chosen by `{shown}` are left out: people stay where they are"),
                );
                Selector::Stay
            }
        };
    }
    for velocity in children(node, "VelComponent") {
        state.velocity = match xml.text(velocity, "type")? {
            "goal" => Velocity::Way,
            "road_map" | "nav_mesh" => {
                notes.whole("road maps and navigation meshes for finding ways are not needed: ways are found on the ground itself");
                Velocity::Way
            }
            "zero" => Velocity::Stand,
            "vel_field" => Velocity::Field(xml.text(velocity, "file_name")?.replace('\\', "/")),
            other => {
                let shown = short(other);
                notes.about(
                    &name,
                    format!("velocities of the kind `{shown}` are left out: people take the shortest way"),
                );
                Velocity::Way
            }
        };
    }
    for action in children(node, "Action") {
        let shown = short(action.attribute("type").unwrap_or("unnamed"));
        notes.about(&name, format!("the action `{shown}` is left out"));
    }
    Ok(state)
}

fn way(xml: &Xml, node: Node) -> Result<Way, Error> {
    let condition = children(node, "Condition").next();
    let when = match condition {
        None => TransitionWhen::Other("none".into()),
        Some(node) => when(xml, node)?,
    };
    let target = children(node, "Target").next();
    let mut to: Vec<(String, f64)> =
        node.attribute("to").map(|name| (name.trim().to_owned(), 1.0)).into_iter().collect();
    if let Some(target) = target.filter(|target| target.attribute("type") == Some("prob")) {
        for state in children(target, "State") {
            let weight = xml.number(state, "weight")?.unwrap_or(1.0).clamp(0.0, 1e9);
            to.push((xml.text(state, "name")?.to_owned(), weight));
        }
    }
    let leads = match to.as_slice() {
        [] => "back".to_owned(),
        to => to.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", "),
    };
    Ok(Way { when, to, name: format!("to {leads}") })
}

fn when(xml: &Xml, node: Node) -> Result<TransitionWhen, Error> {
    let inside = node.attribute("inside").is_none_or(|said| said != "0" && said != "false");
    Ok(match xml.text(node, "type")? {
        "goal_reached" => TransitionWhen::There(xml.number(node, "distance")?.unwrap_or(0.0).max(0.0)),
        "timer" => TransitionWhen::Later(xml.distribution(node)?),
        "auto" => TransitionWhen::Now,
        "AABB" if inside => TransitionWhen::In(boxed(xml, node)?),
        "circle" if inside => TransitionWhen::In(MengeRegion::Disc(
            DVec2::new(xml.needed(node, "center_x")?, xml.needed(node, "center_y")?),
            xml.needed(node, "radius")?,
        )),
        "OBB" if inside => {
            let size = DVec2::new(xml.needed(node, "width")?, xml.needed(node, "height")?);
            TransitionWhen::In(turned(xml, node, ["pivot_x", "pivot_y"], size)?)
        }
        other => TransitionWhen::Other(short(other)),
    })
}

impl MengeRegion {
    /// Returns the centre.
    pub fn middle(&self) -> DVec2 {
        match self {
            Self::Point(at) | Self::Box(at, ..) | Self::Disc(at, _) => *at,
        }
    }

    /// Returns the region within `by` of the shape. A point becomes a disc of at least a centimetre; the corners of a
    /// box stay sharp.
    pub fn grown(&self, by: f64) -> Region {
        match self {
            Self::Point(at) => Region::Disc(Circle { center: at.to_array(), radius: by.max(0.01) }),
            Self::Disc(at, radius) => Region::Disc(Circle { center: at.to_array(), radius: radius + by }),
            Self::Box(at, half, rotation) => {
                let size = ((*half + by) * 2.0).to_array();
                Region::Rectangle(Rectangle { center: at.to_array(), size, rotation: *rotation })
            }
        }
    }
}
