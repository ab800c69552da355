//! Importers: floor plans and other programs' scenarios become scenes, meshes become surfaces.

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

/// An imported scene, and what of the source a scene cannot represent.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Imported {
    /// The scene.
    pub scene: Scene,
    /// What was left out or changed, a sentence each.
    pub notes: Vec<String>,
}

/// Returns the start of a text from a file, for messages.
fn short(said: &str) -> String {
    said.chars().take(30).collect()
}
