//! The interface of steering behaviours: the aims of an agent, as forces.
//!
//! A [`Behaviour`] sees one agent and its surroundings ([`SteeringInput`]), frozen at the start of the step. It returns a
//! [`Steering`], a force that the agent's [`Vehicle`](crate::motion::Vehicle) follows within its limits, or `None` if
//! there is nothing to correct. The crate `throng-steer` has Reynolds' behaviours, flocks, swarms, and ways to combine
//! behaviours, which are behaviours too.

mod barriers;
mod batch;
mod behaviour;
mod flock;
mod target;
mod trace;
mod view;

pub use crate::motion::Steering;
pub use crate::random::Rng;
pub use barriers::Barriers;
pub(crate) use batch::{BatchAgents, Steer};
pub use batch::{MOST_IN_BATCH, SteeringBatch};
pub use behaviour::{Behaviour, BoxedBehaviour, check_parts, words_of_parts};
pub use flock::{Bird, Birds, FlockBatch};
pub use target::{GroupFilter, Kinematics, Target};
pub use trace::{SteeringReason, TraceEntry, TraceRecorder};
pub use view::{AgentQuery, SteeringInput, SteeringNeighbour, Stimulus};
