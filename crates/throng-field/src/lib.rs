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
mod covered;
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
pub use covered::Covered;
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

use around::AroundAllWalls;
use glam::DVec2;
use guide::ThroughSpace;
use keyframes::KeyframeSequence;
use throng::Error;
use throng::field::Field;
use throng::parameters::Parameters;
use throng::space::Place;

/// A collection of fields by name.
pub trait Fields {
    /// Adds a field that is made of parameters: its own, or a type of their own. Its name is [`Parameters::NAME`].
    fn add<P: Parameters + 'static, F: Field + TryFrom<P, Error: Into<Error>> + 'static>(&mut self);

    /// Adds parameters from which a field is made for a place.
    fn add_for_place<P: ForPlace + 'static>(&mut self);
}

/// Parameters from which a field is made for the ground and the obstacles of a scene.
pub trait ForPlace: Parameters {
    /// Makes the field. The place is in world coordinates; those of the field are relative to `origin`.
    ///
    /// # Errors
    /// The field cannot be made of these parameters.
    fn for_place(self, place: &Place, origin: DVec2) -> Result<impl Field + 'static, Error>;
}

/// Adds the fields of this crate that are made of parameters to a collection.
pub fn register(fields: &mut impl Fields) {
    fields.add::<Uniform, Uniform>();
    fields.add::<Whirl, Whirl>();
    fields.add::<Towards, Towards>();
    fields.add::<Noise, CurlNoise>();
    fields.add::<Sum, Sum>();
    fields.add::<Blend, Blend>();
    fields.add::<KeyframeSequence, Keyframes>();
    fields.add::<ThroughSpace, SwarmGuide>();
    fields.add_for_place::<AroundAllWalls>();
}

/// The code of `docs/fields.md`, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/fields.md")]
struct FieldsPage;
