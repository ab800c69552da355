//! Floor plans and other programs' scenarios, as plain scenes; meshes, as surfaces.

mod exits;
pub mod jupedsim;
#[cfg(feature = "menge")]
pub mod menge;
mod notes;
pub mod obj;
mod open;
pub mod plan;
pub mod vectors;
pub mod wkt;
#[cfg(any(feature = "menge", feature = "svg"))]
mod xml;

pub use open::open;

use crate::scene::Scene;
use exits::roomy;
#[cfg(any(feature = "menge", feature = "svg"))]
use xml::no_xml;

/// A scene made from something else, and what of it a scene cannot say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Imported {
    /// The scene.
    pub scene: Scene,
    /// What was left out or changed, a sentence each.
    pub notes: Vec<String>,
}

/// As much of what a file says as a message shows.
fn short(said: &str) -> String {
    said.chars().take(30).collect()
}
