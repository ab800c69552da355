//! The reference works: crowds on which the speed of simulators is measured, and the measurement.
//!
//! A [`Work`] makes a [`Crowd`], a [`Flock`] or [`Insects`], plain data for any simulator, and a
//! [`World`](throng::World) of it. [`lap`] advances a world and measures the time of each stage. `throng bench`
//! measures the works, and `peers/` measures other simulators on the same crowds. `docs/performance.md` has results.
//!
//! ```
//! use throng_bench::{lap, work};
//!
//! let mut world = work("crossing").unwrap().world(100, false)?;
//! let lap = lap(&mut world, 10, || true);
//! assert_eq!(lap.agent_steps, 1000);
//! println!("{:.0} ns an agent-step", lap.ns(lap.wall));
//! # Ok::<(), throng::Error>(())
//! ```

mod building;
mod city;
pub mod clock;
mod crowd;
mod flock;
mod floor;
mod lap;
mod mixed;
mod place;
mod rng;
mod swarm;
mod work;

pub use crowd::{Crowd, Person};
pub use flock::{Bird, Flock};
pub use lap::{Lap, lap, median};
pub use rng::Dice;
pub use swarm::Insects;
pub use work::{WORKS, Work, work};
