//! Playback of a scene: commands in, states out.
//!
//! An [`Engine`] owns the scene and its world, or a [`Reel`] read from a trajectory file. In a window it runs in its
//! own thread ([`ThreadedEngine`]). In a web page, which has no threads, it works for a time slice of each frame. Both are a
//! [`Player`].

mod engine;
mod figures;
mod history;
mod intervened;
mod live;
mod meter;
mod observed;
mod pace;
mod people;
mod playable;
mod quantity;
mod reel;
mod run;
mod run_moment;
mod series;
#[cfg(not(target_arch = "wasm32"))]
mod threaded;
mod wake;

pub use engine::{Command, Engine};
pub use figures::Figures;
pub use history::StateHistory;
pub use intervened::{Act, Held};
pub(crate) use live::guarded;
pub use meter::{Gauge, Meter};
pub use observed::{AgentMoment, Observed};
pub use pace::{Pace, Speed};
pub use people::{Joints, Poses, PosesBetween, ROWS, person};
pub use quantity::Quantity;
pub use reel::{Film, Reel};
pub(crate) use run::{models_of, title};
pub use run_moment::{Cost, RunMoment, Trouble};
pub use series::{Sample, Series};
#[cfg(not(target_arch = "wasm32"))]
pub use threaded::ThreadedEngine;

/// The player of this platform.
#[cfg(not(target_arch = "wasm32"))]
pub type Player = ThreadedEngine;
/// The player of this platform.
#[cfg(target_arch = "wasm32")]
pub type Player = Engine;
