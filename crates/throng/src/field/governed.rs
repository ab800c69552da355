//! Groups governed by a field.

use super::{Adaptive, Field, Interaction};
use crate::Error;
use crate::motion::angle;
use glam::{DVec2, Vec2, Vec3};
use std::f32::consts::TAU;
use std::fmt;
use std::sync::Arc;

/// Angle between directions, radians, beyond which they count as opposed.
const AGAINST: f32 = 2.7;

/// A factor at every place along the ground, metres from the origin: for example a painted map. Functions of a place are
/// factor maps.
///
/// ```
/// use glam::DVec2;
/// use throng::agent::Guidance;
/// use throng::field::FactorMap;
/// let east = |place: DVec2| if place.x > 0.0 { 1.0 } else { 0.0 };
/// assert_eq!(FactorMap::at(&east, DVec2::X), 1.0);
/// ```
pub trait FactorMap: Send + Sync {
    /// Returns the factor at a place.
    fn at(&self, place: DVec2) -> f32;
}

impl<F: Fn(DVec2) -> f32 + Send + Sync> FactorMap for F {
    fn at(&self, place: DVec2) -> f32 {
        self(place)
    }
}

/// A field that governs the agents of a group, and its share beside their own preferred velocities: Jin et al. 2008,
/// where the motion of an agent is part autonomous, part governed.
///
/// Directions and speeds are blended separately: two opposed velocities do not cancel out. Where the field or the
/// agent's own preferred velocity is zero, the other alone counts. Collision avoidance comes after the blend.
///
/// ```
/// use glam::{DVec2, Vec3};
/// use throng::agent::Guidance;
/// use throng::field::Governed;
/// use throng::{Agent, Group, Settings, World};
/// let mut world = World::new(Settings::default())?;
/// let east = |_: Vec3, _: f64| Vec3::X;
/// let guidance = Guidance::JOURNEY.governed(Governed::new(east, 1.0));
/// let group = world.add_group(Group { guidance, ..Group::default() })?;
/// world.add_agent(Agent { group, ..Agent::default() })?;
/// while world.time() < 10.0 {
///     world.step();
/// }
/// assert!(world.relative_columns().position[0].distance(DVec2::new(10.0, 0.0).as_vec2()) < 0.5);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone)]
pub struct Governed {
    /// The field, in metres from the origin.
    pub field: Arc<dyn Field>,
    /// Share of the field in the preferred velocity: 0 to 1. It is multiplied by
    /// [`Agent::governed`](crate::Agent::governed).
    pub ratio: f32,
    /// Factor of the ratio at each place; the product is at most 1. None: 1 everywhere.
    pub map: Option<Arc<dyn FactorMap>>,
    /// Fields that move with a source. Where any of them is not zero, the weighted mean of all that are not zero
    /// counts, with the field itself at a weight of 1.
    pub around: Vec<Interaction>,
}

impl Governed {
    /// Creates it from a field and a ratio.
    pub fn new(field: impl Field + 'static, ratio: f32) -> Self {
        Self { field: Arc::new(field), ratio, map: None, around: Vec::new() }
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        Error::unless((0.0..=1.0).contains(&self.ratio), "ratio of a field", self.ratio, "0 to 1")?;
        self.field.adaptive().map_or(Ok(()), Adaptive::check)?;
        self.around.iter().try_for_each(Interaction::check)
    }

    /// Returns the share of the field at a place, for an agent with this value of `governed`.
    pub(crate) fn ratio_at(&self, place: Vec3, governed: f32) -> f32 {
        let here = self.map.as_ref().map_or(1.0, |map| map.at(place.truncate().as_dvec2()));
        (self.ratio * governed * here).clamp(0.0, 1.0)
    }
}

/// Returns the preferred velocity along the ground: `own` blended with the velocity of the field, `flow`, at its share.
/// `velocity` is the agent's current velocity.
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
    // between two opposed directions the blend can turn either way: keep the side on which the agent already moves
    let turn = if turn.abs() > AGAINST && turn * turned < 0.0 { turn - TAU.copysign(turn) } else { turn };
    let (sin, cos) = libm::sincosf(ratio * turn);
    Vec2::new(cos, sin).rotate(own.normalize()) * speed
}

impl fmt::Debug for Governed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Governed").field("ratio", &self.ratio).finish_non_exhaustive()
    }
}
