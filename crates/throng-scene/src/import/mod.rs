//! Floor plans and other programs' scenarios, as plain scenes; meshes, as surfaces.

pub mod jupedsim;
pub mod obj;
mod open;
pub mod vectors;
pub mod wkt;

pub use open::open;

use crate::scene::Scene;

/// A scene made from something else, and what of it a scene cannot say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Imported {
    /// The scene.
    pub scene: Scene,
    /// What was left out or changed, a sentence each.
    pub notes: Vec<String>,
}
