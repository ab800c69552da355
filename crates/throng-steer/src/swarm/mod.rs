//! Swarms of insects: noise, guidance, and separation.
//!
//! Wang, Jin, Deng, Zhou, *Inherent noise-aware insect swarm simulation*, Computer Graphics Forum 33(6), 2014: each
//! insect follows the velocity of a governing field, of guidance and [curl noise](throng_field::CurlNoise), away from
//! obstacles. In the paper the curl noise keeps insects apart. Measured, it does not: of 1500 points placed a quarter
//! of the noise length apart, 28 % had a nearer neighbour after the time to drift by one noise length. So there is
//! separation, as in the authors' later model (Wang, Ren, Jin, Manocha, *BSwarm*, SCA 2015).
//!
//! ```
//! use glam::{DVec3, Vec3};
//! use throng::steer::Target;
//! use throng_steer::swarm::{midge, Aggregate, Swarm};
//! use throng::{Agent, Settings, SubSteps, World};
//! let mut world = World::new(Settings { step: 1.0 / 60.0, sub_steps: SubSteps::Fixed(1), ..Settings::default() })?;
//! let swarm = Swarm::default().with(Aggregate::new(Target::Point(Vec3::Z * 2.0)));
//! let group = world.add_group(swarm.group())?;
//! for x in 0..20 {
//!     let position = DVec3::new(0.5 * f64::from(x) - 5.0, 0.0, 2.0);
//!     world.add_agent(Agent { position, radius: 0.005, group, ..Agent::default() }.motor(midge()))?;
//! }
//! while world.time() < 10.0 {
//!     world.step();
//! }
//! assert!(world.relative_columns().position.iter().all(|at| at.length() < 2.5), "they have gathered");
//! # Ok::<(), throng::Error>(())
//! ```

mod aggregate;
mod attack;
mod chosen;
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
pub(crate) use flow::tell_spine;
pub use guide::{Guide, GuideOutput};
pub use migrate::{Align, HeightBand, Migrate};
pub use phototaxis::Phototaxis;
pub use sedation::Sedation;
pub use swarming::{KeepOff, Swarm, SwarmSpacing, locust, midge};
pub use zones::Zones;

/// `docs/swarms.md`, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../../docs/swarms.md")]
struct SwarmsPage;
