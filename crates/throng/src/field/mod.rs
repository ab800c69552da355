//! 2c. Where does the crowd flow: a velocity at every place and time.
//!
//! Anything that gives a velocity at a place is a [`Field`]: a function, velocities [sketched](Anchors) at some places. Who
//! [follows a flow](crate::steer::FollowFlow) goes with one.

mod adaptive;
mod anchors;
mod anchors_in_space;
mod around;
mod brush;
mod combine;
mod cost;
mod critical;
mod eikonal;
mod goal;
mod governed;
mod grid;
mod guide;
mod hull;
mod interaction;
mod jams;
mod keyframes;
mod map;
mod noise;
mod paint;
mod plate;
mod plate_lanes;
mod sampled;
mod slope;

pub use adaptive::Adaptive;
pub use anchors::{Anchor, Anchors, Note, Sketch};
pub use anchors_in_space::AnchorsInSpace;
pub use around::AroundWalls;
pub use brush::{Stamp, Stroke, erase};
pub use combine::{Blend, Part, Sum, Uniform};
pub use critical::{Critical, CriticalPoint};
pub use goal::{Density, Destination, Survey, Terrain, ToGoal};
pub use governed::Governed;
pub(crate) use governed::blend;
pub use guide::{Guide, Scan, Smoothing, Spine, Tube, Voxels};
pub use interaction::Interaction;
pub(crate) use interaction::Source;
pub use jams::RoundJams;
pub use keyframes::Keyframes;
pub use map::Map;
pub use noise::{Amplitude, CurlNoise, FadeOut, Motion, Octave, Potential, Rigid, Wall};
pub use paint::Brush;
pub use plate::Kernel;
pub use sampled::Sampled;

use glam::{DVec2, Vec2, Vec3};
use std::sync::Arc;

/// A velocity at every place and time: currents, wind, sketched and painted ways. Functions of a place and a time are such
/// fields.
///
/// ```
/// use glam::Vec3;
/// use throng::field::Field;
/// // round the origin, once in 2 pi seconds
/// let whirl = |place: Vec3, _: f64| Vec3::Z.cross(place);
/// assert_eq!(whirl.velocity(Vec3::X * 2.0, 0.0), Vec3::Y * 2.0);
/// ```
pub trait Field: Send + Sync {
    /// The velocity, m/s, at a place, metres from the world's origin, and a time, seconds since the start. Zero: the field says
    /// nothing there.
    fn velocity(&self, place: Vec3, time: f64) -> Vec3;

    /// The velocities along the ground at places there that lie side by side: `first`, then each a step further towards +x, from the
    /// one with this index on. Fields that are faster where they are asked for many may round otherwise than one by one, but in the
    /// same way wherever they begin.
    fn row(&self, (first, step): (DVec2, f64), from: usize, time: f64, out: &mut [Vec2]) {
        for (out, index) in out.iter_mut().zip(from..) {
            let place = first + DVec2::X * (index as f64 * step);
            *out = self.velocity(place.as_vec2().extend(0.0), time).truncate();
        }
    }

    /// How it changes with where people are, if it does.
    fn adaptive(&self) -> Option<&dyn Adaptive> {
        None
    }
}

impl<F: Fn(Vec3, f64) -> Vec3 + Send + Sync> Field for F {
    fn velocity(&self, place: Vec3, time: f64) -> Vec3 {
        self(place, time)
    }
}

impl Field for Arc<dyn Field> {
    fn velocity(&self, place: Vec3, time: f64) -> Vec3 {
        (**self).velocity(place, time)
    }

    fn row(&self, row: (DVec2, f64), from: usize, time: f64, out: &mut [Vec2]) {
        (**self).row(row, from, time, out);
    }

    fn adaptive(&self) -> Option<&dyn Adaptive> {
        (**self).adaptive()
    }
}

/// `docs/fields.md`, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../../docs/fields.md")]
struct Page;
