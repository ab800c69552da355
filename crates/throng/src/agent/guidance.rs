//! What guides the agents of a group.

use crate::Error;
use crate::field::Governed;
use crate::steer::BoxedBehaviour;

/// What guides the agents of a group: the source of their preferred velocities. Any guidance works with any
/// [motor](crate::motion::Motor).
///
/// By default each agent follows its journey, along paths around walls. A behaviour steers the agents instead; it knows
/// the next point of the journey ([`SteeringInput::goal`](crate::steer::SteeringInput::goal)). A field governs a share of
/// either. [`World::set_guidance`](crate::World::set_guidance) changes the guidance of a group while it runs.
///
/// ```
/// use glam::Vec3;
/// use throng::agent::Guidance;
/// use throng::field::Governed;
/// use throng_steer::Wander;
/// let wind = |_: Vec3, _: f64| Vec3::X;
/// let leaves = Guidance::behaviour(Wander::default()).governed(Governed::new(wind, 0.5));
/// assert!(leaves.behaviour.is_some() && leaves.field.is_some());
/// ```
#[derive(Clone, Debug, Default)]
pub struct Guidance {
    /// The behaviour by which the agents steer; `None`: each agent follows its journey. The velocity that their motor
    /// reaches by the steering force is the preferred velocity.
    pub behaviour: Option<BoxedBehaviour>,
    /// A field that governs a share of the motion, along the ground. Governed agents neither make detours nor agree on
    /// the right of way, because the field may be the reason that they make no progress.
    pub field: Option<Governed>,
}

impl Guidance {
    /// Each agent follows its journey.
    pub const JOURNEY: Self = Self { behaviour: None, field: None };

    /// Agents steer by a behaviour.
    pub fn behaviour(behaviour: impl Into<BoxedBehaviour>) -> Self {
        Self { behaviour: Some(behaviour.into()), field: None }
    }

    /// A field governs a share of this guidance.
    #[must_use]
    pub fn governed(self, field: Governed) -> Self {
        Self { field: Some(field), ..self }
    }

    /// Whether each agent follows its journey alone.
    pub fn is_journey(&self) -> bool {
        self.behaviour.is_none() && self.field.is_none()
    }

    /// Whether it has the same behaviour, the same object, as another guidance.
    pub(crate) fn has_behaviour_of(&self, other: &Self) -> bool {
        match (&self.behaviour, &other.behaviour) {
            (Some(own), Some(other)) => own.is_same(other),
            (own, other) => own.is_none() && other.is_none(),
        }
    }

    /// Returns the words of memory that its behaviour needs.
    pub(crate) fn words(&self) -> usize {
        self.behaviour.as_ref().map_or(0, |behaviour| behaviour.words())
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        self.behaviour.as_ref().map_or(Ok(()), |behaviour| behaviour.check())?;
        self.field.as_ref().map_or(Ok(()), Governed::check)
    }
}
