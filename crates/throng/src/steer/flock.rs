//! Agents that see all others within a distance, and that a behaviour steers together.

use crate::motion::Vehicle;
use crate::perceive::CellLattice;
use fearless_simd::Level;
use glam::Vec3;
use std::ops::Range;

/// An agent as flocks perceive it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bird {
    /// Centre, metres.
    pub position: Vec3,
    /// Forward direction, a vector of length 1.
    pub forward: Vec3,
    /// Index of the group.
    pub group: u32,
    /// Body radius, metres.
    pub radius: f32,
}

/// All agents as flocks perceive them, by place.
#[derive(Clone, Debug, Default)]
pub struct Birds {
    /// The agents.
    pub all: Vec<Bird>,
    /// The forward directions once more, a column per component, padded to whole vectors.
    pub forward: [Vec<f32>; 3],
    /// The radius of all agents, if it is the same.
    pub radius: Option<f32>,
}

/// The agents of a group in a part of space that see all others within a distance. A behaviour sets their forces, records
/// the pairs of close agents, and sets [`is_done`](Self::is_done); or it leaves the batch as it is.
///
/// ```
/// use throng::motion::Steering;
/// use throng::steer::{Behaviour, FlockBatch, SteeringInput, TraceRecorder};
/// use throng_steer::Flocking;
///
/// /// A flock that keeps closer together.
/// #[derive(Debug)]
/// struct Close(Flocking);
///
/// impl Behaviour for Close {
///     fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
///         self.0.steer(view, memory, why)
///     }
///
///     fn is_flock(&self) -> bool {
///         true
///     }
///
///     fn steer_flock(&self, batch: &mut FlockBatch<'_>) {
///         self.0.steer_flock(batch);
///     }
/// }
/// ```
#[non_exhaustive]
pub struct FlockBatch<'a> {
    /// The SIMD instructions of the step. All levels must give the same bits.
    pub level: Level,
    /// The body of the group's agents.
    pub vehicle: &'a Vehicle,
    /// Index of the group.
    pub group: u32,
    /// Perception range, metres.
    pub range: f32,
    /// Distance within which two agents are close, metres, at most `range`.
    pub close: f32,
    /// All agents of the world, sorted into cells.
    pub lattice: &'a CellLattice,
    /// All agents of the world, by place in the lattice.
    pub birds: &'a Birds,
    /// The places of the batch: agents of this group and of other groups.
    pub places: Range<usize>,
    /// Memory that is kept from step to step, for ranges of places.
    pub runs: &'a mut Vec<Range<usize>>,
    /// Places of the pairs of close agents, to which the behaviour adds. The first of a pair is an agent of the batch.
    pub close_pairs: &'a mut Vec<(u32, u32)>,
    /// The forces by place, newtons. Those of agents of other groups stay unchanged.
    pub forces: &'a mut [Vec3],
    /// Returns the force of the agent at a place, by [`Behaviour::steer`](super::Behaviour::steer).
    pub one: &'a mut dyn FnMut(usize) -> Vec3,
    /// Whether the behaviour has set the forces and recorded the pairs.
    pub is_done: bool,
}

impl std::fmt::Debug for FlockBatch<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FlockBatch").field("places", &self.places).finish_non_exhaustive()
    }
}
