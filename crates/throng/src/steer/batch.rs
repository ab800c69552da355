//! Several agents of a group that a behaviour steers together.

use super::SteeringInput;
use crate::motion::Steering;
use glam::Vec3;

/// Greatest number of agents in a [`SteeringBatch`].
pub const MOST_IN_BATCH: usize = crate::simd::LANES;

/// Returns the steering of one agent, from its input and its memory.
pub(crate) type Steer<'f> = &'f mut dyn FnMut(&SteeringInput<'_>, &mut [f32]) -> Option<Steering>;

/// The agents of a batch, by index.
pub(crate) trait BatchAgents {
    fn position(&self, index: usize) -> Vec3;
    fn number(&self, index: usize) -> u32;
    /// Steers an agent.
    fn steer(&mut self, index: usize, steer: Steer<'_>);
}

/// At most [`MOST_IN_BATCH`] agents of a group, near each other. What a behaviour computes faster for several agents, it
/// computes first; then it steers each agent with the result.
///
/// ```
/// use glam::Vec3;
/// use throng::motion::Steering;
/// use throng::steer::{Behaviour, MOST_IN_BATCH, SteeringBatch, SteeringInput, TraceRecorder};
///
/// /// Goes along waves.
/// #[derive(Debug)]
/// struct Waves;
///
/// impl Waves {
///     fn steering(view: &SteeringInput<'_>, slope: f32) -> Option<Steering> {
///         Some(view.reach(Vec3::new(1.0, slope, 0.0)))
///     }
/// }
///
/// impl Behaviour for Waves {
///     fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
///         Self::steering(view, view.position().x.sin())
///     }
///
///     fn steer_many(&self, batch: &mut SteeringBatch<'_>) {
///         let mut slopes = [0.0; MOST_IN_BATCH];
///         slopes.iter_mut().take(batch.count()).enumerate().for_each(|(at, slope)| *slope = batch.position(at).x.sin());
///         for index in 0..batch.count() {
///             batch.steer(index, |view, _| Self::steering(view, slopes[index]));
///         }
///     }
/// }
/// ```
pub struct SteeringBatch<'a> {
    agents: &'a mut dyn BatchAgents,
    count: usize,
    /// The agents that have no steering yet, one bit each.
    left: u64,
    time: f64,
}

impl std::fmt::Debug for SteeringBatch<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SteeringBatch").field("agents", &self.count).finish_non_exhaustive()
    }
}

impl<'a> SteeringBatch<'a> {
    pub(crate) fn new(agents: &'a mut dyn BatchAgents, count: usize, time: f64) -> Self {
        Self { agents, count, left: u64::MAX >> (u64::BITS as usize - count), time }
    }

    /// Returns the agents that have no steering yet, one bit each.
    pub(crate) fn left(&self) -> u64 {
        self.left
    }

    /// Returns the number of agents.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Returns the time at the start of the sub-step, seconds: the [time](SteeringInput::time) of all inputs.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Returns the position of an agent, metres.
    pub fn position(&self, index: usize) -> Vec3 {
        self.agents.position(index)
    }

    /// Returns the number of an agent: that of its [random numbers](SteeringInput::rng).
    pub fn number(&self, index: usize) -> u32 {
        self.agents.number(index)
    }

    /// Steers an agent. `steer` gets its input and its memory, as [`Behaviour::steer`](super::Behaviour::steer) does, and
    /// returns its steering. Does nothing if the agent has been steered.
    pub fn steer(&mut self, index: usize, mut steer: impl FnMut(&SteeringInput<'_>, &mut [f32]) -> Option<Steering>) {
        if self.left >> index & 1 == 1 {
            self.left &= !(1 << index);
            self.agents.steer(index, &mut steer);
        }
    }
}
