//! Vector fields that govern crowds.
//!
//! A [`Field`] of the engine is a velocity at every place and time. Here are fields that are
//! [sketched](Anchors) at some places, [painted](Sampled), made of [other fields](Blend), [flows to goals](ToGoal),
//! [guidance of swarms](SwarmGuide) and [noise](CurlNoise). They use nothing of the engine that a field of a program's
//! own cannot use.

mod about_place;
mod anchors;
mod anchors_in_space;
mod around;
mod brush;
mod combine;
mod cost;
mod critical;
mod eikonal;
mod goal;
mod grid;
mod guide;
mod hull;
mod jams;
mod keyframes;
mod map;
mod noise;
mod paint;
mod plate;
mod plate_simd;
mod sampled;
mod slope;

pub use about_place::{Towards, Whirl};
pub use anchors::{Anchor, Anchors, Note, Sketch};
pub use anchors_in_space::AnchorsInSpace;
pub use around::AroundWalls;
pub use brush::{Stamp, Stroke, erase};
pub use combine::{Blend, FieldPart, Sum, Uniform};
pub use critical::{Critical, CriticalPoint};
pub use goal::{Density, Destination, Terrain, TerrainSettings, ToGoal};
pub use guide::{Smoothing, Spine, SwarmGuide, Tube, VoxelSettings, Voxels};
pub use jams::RoundJams;
pub use keyframes::Keyframes;
pub use map::Map;
pub use noise::{Amplitude, CurlNoise, FadeOut, Noise, NoiseWall, Octave, Potential, Rigid, RigidMotion};
pub use paint::Brush;
pub use plate::Kernel;
pub use sampled::Sampled;

use throng::Error;
use throng::field::Field;
use throng::parameters::Parameters;

/// A collection of fields by name.
pub trait Fields {
    /// Adds a field that is made of parameters: its own, or a type of their own. Its name is [`Parameters::NAME`].
    fn add<P: Parameters + 'static, F: Field + TryFrom<P, Error: Into<Error>> + 'static>(&mut self);
}

/// Adds the fields of this crate that need nothing but their parameters to a collection.
pub fn register(fields: &mut impl Fields) {
    fields.add::<Uniform, Uniform>();
    fields.add::<Whirl, Whirl>();
    fields.add::<Towards, Towards>();
    fields.add::<Noise, CurlNoise>();
}

/// The code of `docs/fields.md`, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/fields.md")]
struct FieldsPage;
