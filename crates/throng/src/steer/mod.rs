//! Steering: what an agent would like, as a force. Reynolds' behaviours, one a file, and ways to combine them.
//!
//! Craig Reynolds, Flocks, herds, and schools, SIGGRAPH 1987; Steering behaviors for autonomous characters, GDC 1999; and
//! what OpenSteer, gdx-ai, yuka and UnitySteer added.
//!
//! A [`Behaviour`] sees one agent and what is near it ([`View`]), frozen at the start of the step, and answers with a
//! [`Steering`], a force that the agent's [`Vehicle`](crate::motion::Vehicle) obeys as far as it can; or with `None`, when
//! there is nothing to correct. Ways to combine behaviours are behaviours too, and take any others as their parts.
//!
//! ```
//! use glam::Vec3;
//! use throng::motion::{Motion, Vehicle};
//! use throng::steer::{Arrive, Behaviour, Target, View, Why};
//!
//! let behaviour = Arrive::from(Target::Point(Vec3::new(3.0, 4.0, 0.0)));
//! let (vehicle, mut motion) = (Vehicle::default(), Motion::default());
//! let mut memory = vec![0.0; behaviour.memory()];
//! for step in 0..500 {
//!     let view = View { motion, vehicle, time: f64::from(step) * 0.02, seconds: 0.02, ..View::default() };
//!     let steering = behaviour.steer(&view, &mut memory, &mut Why::default()).unwrap_or_default();
//!     vehicle.step(&mut motion, steering, 0.02);
//! }
//! assert!(motion.position.distance(Vec3::new(3.0, 4.0, 0.0)) < 0.02 && motion.speed() < 0.01);
//! ```

mod approach;
mod behaviour;
mod combine;
mod group;
mod noise;
mod place;
mod prediction;
mod single;
pub mod swarm;
mod target;
mod view;
mod why;

pub use crate::motion::Steering;
pub use crate::random::Dice;
pub use behaviour::{Behaviour, Branch};
pub use combine::*;
pub use group::*;
pub use noise::Noise;
pub use place::*;
pub use prediction::Prediction;
pub use single::*;
pub use target::{Mark, Target, Who};
pub use view::{Event, Neighbour, Others, View};
pub use why::{Reason, Told, Why};

/// The page on a behaviour of one's own: its example is a test.
#[cfg(doctest)]
#[doc = include_str!("../../../../docs/behaviours.md")]
struct Page;
