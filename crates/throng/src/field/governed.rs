//! Crowds that a field governs, as far as it does.

use super::{Adaptive, Field, Interaction, Map};
use crate::Error;
use crate::motion::angle;
use glam::{Vec2, Vec3};
use std::f32::consts::TAU;
use std::fmt;
use std::sync::Arc;

/// Beyond this angle, radians, two directions are against each other.
const AGAINST: f32 = 2.7;

/// A field that says where the agents of a group go, and how much it has to say beside their own ways: Jin et al. 2008, where
/// the motion of people is part autonomous, part governed.
///
/// Directions and speeds are blended each on their own: two that are against each other do not cancel out. Where the field says
/// nothing, or somebody has no way to go, the other alone counts. Others are avoided afterwards, as always.
///
/// ```
/// use glam::{DVec2, Vec3};
/// use throng::field::Governed;
/// use throng::{Agent, Group, Settings, World};
/// let mut world = World::new(Settings::default())?;
/// let east = |_: Vec3, _: f64| Vec3::X;
/// let group = world.add_group(Group { field: Some(Governed::new(east, 1.0)), ..Group::default() })?;
/// world.add_agent(Agent { group, ..Agent::default() })?;
/// while world.time() < 10.0 {
///     world.step();
/// }
/// assert!(world.agents().position[0].distance(DVec2::new(10.0, 0.0).as_vec2()) < 0.5);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone)]
pub struct Governed {
    /// The field, in metres from the world's origin.
    pub field: Arc<dyn Field>,
    /// What part of it is the field's: 0 to 1. That of an agent is this times [`Agent::governed`](crate::Agent::governed).
    pub ratio: f32,
    /// Where: the ratio is multiplied by the map, and is at most 1. None: everywhere.
    pub map: Option<Arc<Map>>,
    /// Fields about others, wherever these are. Where they say something, the mean by weight of all that do counts, with the
    /// field itself at a weight of 1.
    pub around: Vec<Interaction>,
}

impl Governed {
    /// By a field, with this ratio.
    pub fn new(field: impl Field + 'static, ratio: f32) -> Self {
        Self { field: Arc::new(field), ratio, map: None, around: Vec::new() }
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        Error::unless((0.0..=1.0).contains(&self.ratio), "ratio of a field", self.ratio, "0 to 1")?;
        self.field.adaptive().map_or(Ok(()), Adaptive::check)?;
        self.around.iter().try_for_each(Interaction::check)
    }

    /// What part of it is the field's at a place, of somebody who is governed so much.
    pub(crate) fn ratio_at(&self, place: Vec3, governed: f32) -> f32 {
        let here = self.map.as_ref().map_or(1.0, |map| map.at(place.truncate().as_dvec2()));
        (self.ratio * governed * here).clamp(0.0, 1.0)
    }
}

/// The preferred velocity, along the ground, of somebody who would prefer their own and goes with a velocity now, where a flow has
/// this part in it.
pub(crate) fn blend(own: Vec2, flow: Vec2, ratio: f32, velocity: Vec2) -> Vec2 {
    if ratio == 0.0 || flow == Vec2::ZERO || !flow.is_finite() {
        return own;
    }
    if own == Vec2::ZERO || ratio == 1.0 {
        return flow;
    }
    let speed = own.length() + ratio * (flow.length() - own.length());
    let turn = angle(Vec2::new(own.dot(flow), own.perp_dot(flow)));
    let turned = own.perp_dot(velocity);
    // between two that are against each other lead ways on both sides: who is on one stays on it
    let turn = if turn.abs() > AGAINST && turn * turned < 0.0 { turn - TAU.copysign(turn) } else { turn };
    let (sin, cos) = libm::sincosf(ratio * turn);
    Vec2::new(cos, sin).rotate(own.normalize()) * speed
}
impl fmt::Debug for Governed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Governed").field("ratio", &self.ratio).finish_non_exhaustive()
    }
}
