//! The reference works: crowds that the speed of simulators is measured on, and how long they take.
//!
//! A [`Work`] makes a [`Crowd`], a [`Flock`] or [`Insects`], plain data that any simulator can be given, and a [`World`](throng::World) of it;
//! [`lap`] moves a world on and says where the time went. `throng bench` measures them, and `peers/` measures other
//! simulators on the same crowds. `docs/performance.md` has figures.
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

pub mod clock;
mod crowd;
mod dice;
mod flock;
mod floor;
mod lap;
mod place;
mod swarm;
mod work;

pub use crowd::{Crowd, Person};
pub use dice::Dice;
pub use flock::{Bird, Flock};
pub use lap::{Lap, lap, median};
pub use swarm::Insects;
pub use work::{WORKS, Work, work};
