//! What happened in a world.

mod frame;

pub use frame::{Body, Frame, Setting};
