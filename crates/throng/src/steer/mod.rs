//! Steering: the aims of an agent, as forces. Reynolds' behaviours, one in each file, and ways to combine them.
//!
//! Craig Reynolds, Flocks, herds, and schools, SIGGRAPH 1987; Steering behaviors for autonomous characters, GDC 1999;
//! and the additions of OpenSteer, gdx-ai, yuka and UnitySteer.
//!
//! A [`Behaviour`] sees one agent and its surroundings ([`SteeringInput`]), frozen at the start of the step. It returns a
//! [`Steering`], a force that the agent's [`Vehicle`](crate::motion::Vehicle) follows within its limits, or `None` if
//! there is nothing to correct. Ways to combine behaviours are behaviours too, and take any other behaviours as parts.
//!
//! ```
//! use glam::Vec3;
//! use throng::motion::{Motion, Vehicle};
//! use throng::steer::{Arrive, Behaviour, Target, SteeringInput, TraceRecorder};
//!
//! let behaviour = Arrive::from(Target::Point(Vec3::new(3.0, 4.0, 0.0)));
//! let (vehicle, mut motion) = (Vehicle::default(), Motion::default());
//! let mut memory = vec![0.0; behaviour.memory()];
//! for step in 0..500 {
//!     let view = SteeringInput { motion, vehicle, time: f64::from(step) * 0.02, seconds: 0.02, ..SteeringInput::default() };
//!     let steering = behaviour.steer(&view, &mut memory, &mut TraceRecorder::default()).unwrap_or_default();
//!     vehicle.step(&mut motion, steering, 0.02);
//! }
//! assert!(motion.position.distance(Vec3::new(3.0, 4.0, 0.0)) < 0.02 && motion.speed() < 0.01);
//! ```

mod approach;
mod batch;
mod behaviour;
mod combine;
mod group;
mod noise;
mod place;
mod prediction;
mod single;
pub mod swarm;
mod target;
mod trace;
mod view;

pub use crate::motion::Steering;
pub use crate::random::Rng;
pub(crate) use batch::{BatchAgents, Steer};
pub use batch::{MOST_IN_BATCH, SteeringBatch};
pub use behaviour::{Behaviour, BoxedBehaviour};
pub use combine::*;
pub use group::*;
pub use noise::Noise;
pub use place::*;
pub use prediction::Prediction;
pub use single::*;
pub use target::{GroupFilter, Kinematics, Target};
pub use trace::{SteeringReason, TraceEntry, TraceRecorder};
pub use view::{AgentQuery, SteeringInput, SteeringNeighbour, Stimulus};

/// The page about behaviours that users write: its example is a test.
#[cfg(doctest)]
#[doc = include_str!("../../../../docs/behaviours.md")]
struct BehavioursPage;
