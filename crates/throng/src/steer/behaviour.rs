//! The trait of all steering behaviours.

use super::{FlockBatch, SteeringBatch, SteeringInput, TraceRecorder};
use crate::Error;
use crate::field::Field;
use crate::motion::Steering;
use std::fmt::Debug;
use std::ops::Deref;
use std::sync::Arc;

/// A steering behaviour: one aim of an agent, as the force that serves it.
///
/// A behaviour keeps no state. What it must remember of an agent is in the memory that the caller passes. Everything
/// else is in the view, which is frozen at the start of the step, so the same view and memory give the same bits.
///
/// ```
/// use glam::Vec3;
/// use throng::motion::Steering;
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
///
/// /// Goes up, but not above a height.
/// #[derive(Debug)]
/// struct Climb {
///     height: f32,
/// }
///
/// impl Behaviour for Climb {
///     fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
///         (view.position().z < self.height).then(|| view.reach(Vec3::Z * view.vehicle.max_speed))
///     }
/// }
///
/// let steering = Climb { height: 5.0 }.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default());
/// assert!(steering.expect("it is below").force.z > 0.0);
/// ```
pub trait Behaviour: Debug + Send + Sync {
    /// Returns the number of words of memory that the behaviour needs for each agent.
    fn memory(&self) -> usize {
        0
    }

    /// Returns the steering of one agent, or `None` if there is nothing to correct. `memory` has
    /// [`memory`](Self::memory) words, which are zero at first. They are kept from step to step and saved with the
    /// world.
    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering>;

    /// Steers several agents together, where that is faster. Agents that it leaves get the steering of
    /// [`steer`](Self::steer): both ways must give the same bits.
    fn steer_many(&self, batch: &mut SteeringBatch<'_>) {
        let _ = batch;
    }

    /// Whether [`steer_flock`](Self::steer_flock) computes the forces of agents that see all others within a distance. The
    /// neighbours of such agents are not sorted by distance: their order depends on positions only. A behaviour with
    /// memory is never steered as a flock.
    fn is_flock(&self) -> bool {
        false
    }

    /// Computes the forces of agents that see all others within a distance, in the order of their places in space. Only
    /// for a behaviour that [is a flock](Self::is_flock). Agents that it leaves get the steering of [`steer`](Self::steer):
    /// both ways must give the same bits.
    fn steer_flock(&self, batch: &mut FlockBatch<'_>) {
        let _ = batch;
    }

    /// Returns the distance within which an agent must see all others, metres, 0 if it needs no neighbours; `None` if the
    /// behaviour does not say.
    fn perception_range(&self) -> Option<f32> {
        None
    }

    /// Passes the fields that the behaviour and its parts follow to `see`, for pictures of them. Positions in the fields
    /// are relative to the origin of the group.
    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        let _ = see;
    }

    /// Checks the parameters.
    ///
    /// # Errors
    /// [`Error::Limit`] names the parameter.
    fn check(&self) -> Result<(), Error> {
        Ok(())
    }
}

/// A shared behaviour, as a part of another behaviour or of a group. Made [from](From) any behaviour; clones share it.
///
/// ```
/// use throng::steer::BoxedBehaviour;
/// use throng_steer::Wander;
/// let wander: BoxedBehaviour = Wander::default().into();
/// assert_eq!(wander.words(), 3);
/// ```
#[derive(Clone, Debug)]
pub struct BoxedBehaviour {
    behaviour: Arc<dyn Behaviour>,
    words: usize,
}

impl<B: Behaviour + 'static> From<B> for BoxedBehaviour {
    fn from(behaviour: B) -> Self {
        let words = behaviour.memory();
        Self { behaviour: Arc::new(behaviour), words }
    }
}

impl Deref for BoxedBehaviour {
    type Target = dyn Behaviour;

    fn deref(&self) -> &Self::Target {
        &*self.behaviour
    }
}

impl BoxedBehaviour {
    /// Returns the number of words of memory that the behaviour needs for each agent.
    pub fn words(&self) -> usize {
        self.words
    }

    /// Whether it is the same object as another.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.behaviour, &other.behaviour)
    }

    /// Returns the steering of the behaviour as the `index`-th part of another behaviour. The part takes its words from
    /// the front of `memory`, and its random numbers are independent of those of the other parts.
    pub fn steer_as(
        &self,
        index: usize,
        view: &SteeringInput<'_>,
        memory: &mut &mut [f32],
        why: &mut TraceRecorder<'_>,
    ) -> Option<Steering> {
        let own = self.take(memory);
        let view = SteeringInput { rng: view.rng.branch(index), ..*view };
        why.part(index, |why| self.behaviour.steer(&view, own, why))
    }

    /// Takes the words of the behaviour from the front of `memory`, for a part that does not run in this step.
    pub fn take<'m>(&self, memory: &mut &'m mut [f32]) -> &'m mut [f32] {
        let (own, rest) = std::mem::take(memory).split_at_mut(self.words);
        *memory = rest;
        own
    }
}

/// Returns the number of words of memory that the parts of a behaviour need.
pub fn words_of_parts<'a>(parts: impl IntoIterator<Item = &'a BoxedBehaviour>) -> usize {
    parts.into_iter().map(BoxedBehaviour::words).sum()
}

/// Checks the parts of a behaviour.
///
/// # Errors
/// The first error of a part.
pub fn check_parts<'a>(parts: impl IntoIterator<Item = &'a BoxedBehaviour>) -> Result<(), Error> {
    parts.into_iter().try_for_each(|part| part.check())
}
