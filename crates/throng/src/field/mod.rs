//! Vector fields that govern crowds: a velocity at every place and time.
//!
//! Everything that returns a velocity at a place and time is a [`Field`]: a function, for example. The crate
//! `throng-field` has fields that are sketched, painted, or lead to goals, and noise.

mod adaptive;
mod governed;
mod interaction;

pub use adaptive::Adaptive;
pub(crate) use governed::blend;
pub use governed::{FactorMap, Governed};
pub use interaction::Interaction;
pub(crate) use interaction::Source;

use glam::{DVec2, Vec2, Vec3};
use std::sync::Arc;

/// A velocity at every place and time: currents, wind, sketched and painted routes. Functions of a place and a time are
/// fields.
///
/// Places are in metres from the [origin of the group](crate::Group::origin) that the field is for: world coordinates,
/// unless the group says otherwise.
///
/// ```
/// use glam::Vec3;
/// use throng::field::Field;
/// // a rotation about the origin, one turn in 2 pi seconds
/// let whirl = |place: Vec3, _: f64| Vec3::Z.cross(place);
/// assert_eq!(whirl.velocity(Vec3::X * 2.0, 0.0), Vec3::Y * 2.0);
/// ```
pub trait Field: Send + Sync {
    /// Returns the velocity, m/s, at a place, metres from the origin, and a time, seconds since the start. Zero
    /// means that the field has no effect there.
    fn velocity(&self, place: Vec3, time: f64) -> Vec3;

    /// Computes the velocities along the ground at places in a row: `first` plus a multiple of `step` along +x, from
    /// index `from` on. An implementation may be faster than [`velocity`](Self::velocity) and round differently, but
    /// the result at a place must not depend on where the row begins.
    fn row(&self, (first, step): (DVec2, f64), from: usize, time: f64, out: &mut [Vec2]) {
        for (out, index) in out.iter_mut().zip(from..) {
            let place = first + DVec2::X * (index as f64 * step);
            *out = self.velocity(place.as_vec2().extend(0.0), time).truncate();
        }
    }

    /// Returns how the field changes with the positions of the agents, if it does.
    fn adaptive(&self) -> Option<&dyn Adaptive> {
        None
    }

    /// Returns how much the field counts at each place, if not the same everywhere: a painted field counts only in part
    /// where the paint is thin. Scenes multiply the share of the field in the guidance of a group by it
    /// ([`Governed::map`]).
    fn cover(&self) -> Option<Arc<dyn FactorMap>> {
        None
    }

    /// Returns the curve along which the field leads, if it does: pictures show it.
    fn spine(&self) -> Option<FieldSpine> {
        None
    }
}

/// The curve along which a field leads, and the tube around the curve within which it does.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldSpine {
    /// The points of the curve in order, metres from the origin of the field.
    pub points: Vec<Vec3>,
    /// The radius of the tube, metres.
    pub radius: f32,
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

    fn cover(&self) -> Option<Arc<dyn FactorMap>> {
        (**self).cover()
    }

    fn spine(&self) -> Option<FieldSpine> {
        (**self).spine()
    }
}
