//! What a behaviour is.

use super::swarm::Swarm;
use super::{Flocking, View, Why};
use crate::Error;
use crate::motion::Steering;
use std::fmt::Debug;
use std::ops::Deref;
use std::sync::Arc;

/// One thing that an agent would like to do, as the force that does it.
///
/// A behaviour keeps no state: what it must remember of an agent is in the memory it is handed. Everything else it knows is
/// in the view, frozen at the start of the step, so the same view and memory give the same bits.
///
/// ```
/// use glam::Vec3;
/// use throng::motion::Steering;
/// use throng::steer::{Behaviour, View, Why};
///
/// /// Goes up, but not above a height.
/// #[derive(Debug)]
/// struct Climb {
///     height: f32,
/// }
///
/// impl Behaviour for Climb {
///     fn steer(&self, view: &View<'_>, _: &mut [f32], _: &mut Why<'_>) -> Option<Steering> {
///         (view.position().z < self.height).then(|| view.reach(Vec3::Z * view.vehicle.max_speed))
///     }
/// }
///
/// let steering = Climb { height: 5.0 }.steer(&View::default(), &mut [], &mut Why::default());
/// assert!(steering.expect("it is below").force.z > 0.0);
/// ```
pub trait Behaviour: Debug + Send + Sync {
    /// How many words of memory it needs for each agent.
    fn memory(&self) -> usize {
        0
    }

    /// The steering of one agent; `None`: there is nothing to correct. `memory` has [`memory`](Self::memory) words, at
    /// first zero; they are kept from step to step and saved with the world.
    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering>;

    /// The flock that it is, if it is no more and no less: the birds of a flock are steered many at once.
    fn as_flocking(&self) -> Option<&Flocking> {
        None
    }

    /// The swarm that it is, if it is no more and no less: the insects of a swarm are steered many at once.
    fn as_swarm(&self) -> Option<&Swarm> {
        None
    }

    /// What is wrong with the parameters, if anything is.
    ///
    /// # Errors
    /// [`Error::Limit`] names the parameter.
    fn check(&self) -> Result<(), Error> {
        Ok(())
    }
}

/// A behaviour as a part of another, or of a group. Made [from](From) any behaviour; clones share it.
///
/// ```
/// use throng::steer::{Branch, Wander};
/// let wander: Branch = Wander::default().into();
/// assert_eq!(wander.words(), 3);
/// ```
#[derive(Clone, Debug)]
pub struct Branch {
    behaviour: Arc<dyn Behaviour>,
    words: usize,
}

impl<B: Behaviour + 'static> From<B> for Branch {
    fn from(behaviour: B) -> Self {
        let words = behaviour.memory();
        Self { behaviour: Arc::new(behaviour), words }
    }
}

impl Deref for Branch {
    type Target = dyn Behaviour;

    fn deref(&self) -> &Self::Target {
        &*self.behaviour
    }
}

impl Branch {
    /// How many words of memory it needs for each agent.
    pub fn words(&self) -> usize {
        self.words
    }

    /// What it says as the `index`-th part of another behaviour: it takes its words from the front of `memory`, and
    /// draws random numbers of its own.
    pub fn steer_as(
        &self,
        index: usize,
        view: &View<'_>,
        memory: &mut &mut [f32],
        why: &mut Why<'_>,
    ) -> Option<Steering> {
        let own = self.take(memory);
        let view = View { dice: view.dice.branch(index), ..*view };
        why.part(index, |why| self.behaviour.steer(&view, own, why))
    }

    /// Its words, from the front of `memory`: for a part that is not asked.
    pub fn take<'m>(&self, memory: &mut &'m mut [f32]) -> &'m mut [f32] {
        let (own, rest) = std::mem::take(memory).split_at_mut(self.words);
        *memory = rest;
        own
    }
}

/// How many words the parts of a behaviour need.
pub(super) fn words<'a>(parts: impl IntoIterator<Item = &'a Branch>) -> usize {
    parts.into_iter().map(Branch::words).sum()
}

/// What is wrong with the first of them that anything is wrong with.
pub(super) fn check<'a>(parts: impl IntoIterator<Item = &'a Branch>) -> Result<(), Error> {
    parts.into_iter().try_for_each(|part| part.check())
}
