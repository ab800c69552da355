//! Playing a scene: commands go in, states come out.
//!
//! An [`Engine`] owns the scene and the world that was made of it. In a window it runs in a thread of its own
//! ([`Threaded`]); in a web page, where there are none, the page lets it work a slice of each frame. Either is a [`Player`].

mod engine;
mod history;
mod meter;
mod pace;
mod quantity;
mod run;
mod series;
mod shown;
#[cfg(not(target_arch = "wasm32"))]
mod threaded;

pub use engine::{Command, Engine};
pub use history::History;
pub use meter::{Gauge, Meter};
pub use pace::{Pace, Speed};
pub use quantity::Quantity;
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
