//! Swarms of insects: noise, what guides it, and a little distance.
//!
//! Wang, Jin, Deng, Zhou, *Inherent noise-aware insect swarm simulation*, Computer Graphics Forum 33(6), 2014: each insect takes on the
//! velocity of a governing field, of guidance and [curl noise](crate::field::CurlNoise), away from obstacles. The paper has the noise keep
//! insects apart; measured, it does not, so there is separation, as in what its authors did later (MODELS 3.1 and 3.4).
//!
//! ```
//! use glam::{DVec2, Vec3};
//! use throng::steer::Target;
//! use throng::steer::swarm::{Aggregate, Swarm, midge};
//! use throng::{Agent, Settings, SubSteps, World};
//! let mut world = World::new(Settings { step: 1.0 / 60.0, sub_steps: SubSteps::Fixed(1), ..Settings::default() })?;
//! let swarm = Swarm::default().with(Aggregate::from(Target::Point(Vec3::Z * 2.0)));
//! let group = world.add_group(swarm.group(midge()))?;
//! for x in 0..20 {
//!     let position = DVec2::new(0.5 * f64::from(x) - 5.0, 0.0);
//!     world.add_agent(Agent { position, altitude: 2.0, radius: 0.005, max_speed: 2.0, group, ..Agent::default() })?;
//! }
//! while world.time() < 10.0 {
//!     world.step();
//! }
//! assert!(world.agents().position.iter().all(|at| at.length() < 2.5), "they have gathered");
//! # Ok::<(), throng::Error>(())
//! ```

mod aggregate;
mod attack;
mod escape;
mod flow;
mod guide;
mod migrate;
mod phototaxis;
mod sedation;
mod swarming;
mod zones;

pub use aggregate::Aggregate;
pub use attack::Attack;
pub use escape::Escape;
pub use flow::Flow;
pub use guide::{Guide, Wish};
pub use migrate::{Align, HeightBand, Migrate};
pub use phototaxis::Phototaxis;
pub use sedation::Sedation;
pub use swarming::{Apart, KeepOff, Swarm, locust, midge};
pub use zones::Zones;

/// `docs/swarms.md`, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../../../docs/swarms.md")]
struct Page;
