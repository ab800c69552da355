//! Playing a scene: commands go in, states come out.
//!
//! An [`Engine`] owns the scene and the world that was made of it, or a [`Reel`] read from a file of trajectories. In a window it runs in a thread of its own
//! ([`Threaded`]); in a web page, where there are none, the page lets it work a slice of each frame. Either is a [`Player`].

mod engine;
mod history;
mod live;
mod meter;
mod observed;
mod pace;
mod quantity;
mod reel;
mod run;
mod series;
mod shown;
mod stage;
#[cfg(not(target_arch = "wasm32"))]
mod threaded;

pub use engine::{Command, Engine};
pub use history::History;
pub(crate) use live::guarded;
pub use meter::{Gauge, Meter};
pub use observed::{Being, Observed};
pub use pace::{Pace, Speed};
pub use quantity::Quantity;
pub use reel::{Film, Reel};
pub(crate) use run::{models_of, title};
pub use series::{Sample, Series};
pub use shown::{Cost, Shown, Trouble};
#[cfg(not(target_arch = "wasm32"))]
pub use threaded::Threaded;

/// What plays scenes here.
#[cfg(not(target_arch = "wasm32"))]
pub type Player = Threaded;
/// What plays scenes here.
#[cfg(target_arch = "wasm32")]
pub type Player = Engine;
