//! Fields attached to agents: Colas, van Toll, Zibrek, Hoyet, Olivier, Pettre, *Interaction fields: intuitive
//! sketch-based steering behaviors for crowd simulation*, Eurographics 2022.

use super::Field;
use crate::Error;
use glam::Vec2;
use std::fmt;
use std::sync::Arc;

/// A field around each agent of a group (the source) that moves and turns with that agent. It sets how the governed
/// agents move near the source, and where they look: for example they hide behind it, circle round it, make way for it
/// or greet it.
///
/// ```
/// use glam::Vec3;
/// use throng::agent::Guidance;
/// use throng::field::{Governed, Interaction};
/// use throng::{Agent, Group, Settings, World};
/// let mut world = World::new(Settings::default())?;
/// let singer = world.add_group(Group { name: "singer".into(), ..Group::default() })?;
/// world.add_agent(Agent { group: singer, ..Agent::default() })?;
/// // the fans keep 3 m away
/// let away = |place: Vec3, _: f64| if place.length() < 3.0 { place.normalize_or_zero() } else { Vec3::ZERO };
/// let around = vec![Interaction::new(singer.index(), away)];
/// let field = Governed { around, ..Governed::new(|_: Vec3, _: f64| Vec3::ZERO, 1.0) };
/// let fans = world.add_group(Group { guidance: Guidance::JOURNEY.governed(field), ..Group::default() })?;
/// world.add_agent(Agent::at([1.0, 0.0]).group(fans))?;
/// while world.time() < 4.0 {
///     world.step();
/// }
/// assert!((world.relative_columns().position[1].length() - 3.0).abs() < 0.3);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone)]
pub struct Interaction {
    /// The [position](crate::GroupId::index) in the world of the group of the sources. An agent is never its own
    /// source.
    pub source: usize,
    /// The velocity, in the source's frame: metres from its centre, x ahead of it, y to its left.
    pub field: Arc<dyn Field>,
    /// The direction to look in, in the same frame; its length does not count, and zero means the direction of motion.
    /// None: the direction of motion everywhere.
    pub looks: Option<Arc<dyn Field>>,
    /// Weight among several interactions. Limit: > 0, finite.
    pub weight: f32,
    /// Part of the source's velocity that is added where the field is not zero: 1 to move along with the source. Limit:
    /// finite.
    pub carried: f32,
    /// Distance from a source, metres, beyond which its field is not evaluated: a smaller reach is faster with many
    /// sources. Limit: > 0.
    pub reach: f32,
}

impl Interaction {
    /// Creates a field around each agent of a group, with weight 1.
    pub fn new(source: usize, field: impl Field + 'static) -> Self {
        Self { source, field: Arc::new(field), looks: None, weight: 1.0, carried: 0.0, reach: f32::INFINITY }
    }

    pub(super) fn check(&self) -> Result<(), Error> {
        Error::unless_positive("weight of an interaction", self.weight)?;
        Error::unless_finite("carried part of an interaction", f64::from(self.carried))?;
        Error::unless(self.reach > 0.0, "reach of an interaction", self.reach, "greater than 0")
    }

    /// Returns the velocity around one source, along the ground; zero where the field is zero.
    pub(crate) fn velocity(&self, source: &Source, place: Vec2, time: f64) -> Vec2 {
        let velocity = source.ask(&*self.field, place, time);
        if velocity == Vec2::ZERO { velocity } else { velocity + source.velocity * self.carried }
    }

    /// Returns the direction to look in around one source; zero for none.
    pub(crate) fn looks(&self, source: &Source, place: Vec2, time: f64) -> Vec2 {
        self.looks.as_ref().map_or(Vec2::ZERO, |looks| source.ask(&**looks, place, time).normalize_or_zero())
    }
}

impl fmt::Debug for Interaction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { source, weight, carried, reach, .. } = self;
        f.debug_struct("Interaction")
            .field("source", source)
            .field("weight", weight)
            .field("carried", carried)
            .field("reach", reach)
            .finish_non_exhaustive()
    }
}

/// An agent that a field is attached to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source {
    /// Metres from the world's origin.
    pub place: Vec2,
    /// Unit vector.
    pub ahead: Vec2,
    pub velocity: Vec2,
}

impl Source {
    /// Evaluates a field in the source's frame and returns the value in the world's frame; zero for values that are not
    /// finite.
    fn ask(&self, field: &dyn Field, place: Vec2, time: f64) -> Vec2 {
        let there = Vec2::new(self.ahead.x, -self.ahead.y).rotate(place - self.place);
        let said = self.ahead.rotate(field.velocity(there.extend(0.0), time).truncate());
        if said.is_finite() { said } else { Vec2::ZERO }
    }
}
