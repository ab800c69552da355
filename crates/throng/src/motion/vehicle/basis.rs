//! Orientation of a body: Reynolds' local space.

use crate::motion::angle;
use glam::{Mat3, Quat, Vec3};
use serde::{Deserialize, Serialize};
use std::f32::consts::PI;

/// Three orthogonal unit vectors, right-handed. Upright and facing +x is the identity.
///
/// Reynolds, Steering behaviors for autonomous characters, GDC 1999, "A simple vehicle model". In the paper the side
/// vector points to the right. Here it points to the left, so that counter-clockwise turns are positive.
///
/// ```
/// use glam::Vec3;
/// use throng::motion::Basis;
/// let north = Basis::facing(Vec3::Y);
/// assert_eq!((north.side, north.up), (-Vec3::X, Vec3::Z));
/// assert_eq!(north.to_local(Vec3::Y), Vec3::X);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Basis {
    /// Unit vector ahead.
    pub forward: Vec3,
    /// Unit vector to the left.
    pub side: Vec3,
    /// Unit vector upwards.
    pub up: Vec3,
}

impl Default for Basis {
    fn default() -> Self {
        Self { forward: Vec3::X, side: Vec3::Y, up: Vec3::Z }
    }
}

impl Basis {
    /// Returns the basis that faces a direction of any length, as upright as possible. A direction of length zero faces
    /// +x. For straight up or down the side is +y.
    pub fn facing(direction: Vec3) -> Self {
        Self::default().turned_to(direction.normalize_or(Vec3::X), Vec3::Z)
    }

    /// Returns this basis turned to a forward vector of length 1, with its up vector as near as possible to `up`. If
    /// the two are parallel, the side vector stays as near as possible to the present one.
    pub fn turned_to(&self, forward: Vec3, up: Vec3) -> Self {
        let least = 1e-6 * up.length_squared();
        let across = up.cross(forward);
        let side = if across.length_squared() > least { across } else { self.side.reject_from_normalized(forward) };
        let side = side.try_normalize().unwrap_or_else(|| forward.any_orthonormal_vector());
        Self { forward, side, up: forward.cross(side) }
    }

    /// Returns the components of a vector ahead, to the left, and up.
    #[inline]
    pub fn to_local(&self, vector: Vec3) -> Vec3 {
        Vec3::new(vector.dot(self.forward), vector.dot(self.side), vector.dot(self.up))
    }

    /// Returns the vector with these components ahead, to the left, and up.
    #[inline]
    pub fn to_world(&self, local: Vec3) -> Vec3 {
        self.forward * local.x + self.side * local.y + self.up * local.z
    }

    /// Returns the part of a vector orthogonal to forward.
    #[inline]
    pub fn lateral(&self, vector: Vec3) -> Vec3 {
        vector.reject_from_normalized(self.forward)
    }

    /// Returns the rotation that maps x to forward, y to the side, and z to up.
    pub fn rotation(&self) -> Quat {
        Quat::from_mat3(&Mat3::from_cols(self.forward, self.side, self.up))
    }

    /// Returns the horizontal direction of forward, radians counter-clockwise from +x.
    pub fn heading(&self) -> f32 {
        angle(self.forward.truncate())
    }
}

/// Returns a vector rotated by `angle` radians about an axis of length 1, counter-clockwise as seen from the tip of the
/// axis.
pub fn turned(vector: Vec3, axis: Vec3, angle: f32) -> Vec3 {
    let (sin, cos) = libm::sincosf(angle);
    vector * cos + axis.cross(vector) * sin + axis * (axis.dot(vector) * (1.0 - cos))
}

/// Returns the angle between two vectors, radians, 0 to pi.
pub fn angle_between(a: Vec3, b: Vec3) -> f32 {
    libm::atan2f(a.cross(b).length(), a.dot(b))
}

/// Returns the direction `from` turned towards `to` by at most `most` radians. Both have length 1. Opposite directions
/// turn about `up`.
pub fn turned_towards(from: Vec3, to: Vec3, most: f32, up: Vec3) -> Vec3 {
    if most >= PI || angle_between(from, to) <= most {
        return to;
    }
    let axis = from.cross(to).try_normalize().unwrap_or_else(|| {
        let across = up.reject_from_normalized(from);
        across.try_normalize().unwrap_or_else(|| from.any_orthonormal_vector())
    });
    turned(from, axis, most).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn unit() -> impl Strategy<Value = Vec3> {
        let any = (-1.0f32..1.0, -1.0f32..1.0, -1.0f32..1.0).prop_map(Vec3::from);
        any.prop_filter_map("too short", |v| (v.length() > 0.1).then(|| v.normalize()))
    }

    proptest! {
        #[test]
        fn a_basis_is_right_handed_and_orthonormal(forward in unit(), up in unit(), v in unit()) {
            let basis = Basis::default().turned_to(forward, up);
            prop_assert!(basis.forward.cross(basis.side).distance(basis.up) < 1e-5);
            prop_assert!(basis.forward.dot(basis.side).abs() < 1e-5 && (basis.side.length() - 1.0).abs() < 1e-5);
            prop_assert!(basis.up.dot(up) > -1e-5);
            prop_assert!(basis.to_world(basis.to_local(v)).distance(v) < 1e-5);
            prop_assert!((basis.rotation() * basis.to_local(v)).distance(v) < 1e-5);
        }

        #[test]
        fn turning_towards_turns_by_the_angle(from in unit(), to in unit(), most in 0.0f32..3.0) {
            let between = angle_between(from, to);
            let turned = turned_towards(from, to, most, Vec3::Z);
            prop_assert!((angle_between(from, turned) - most.min(between)).abs() < 2e-3);
            prop_assert!((angle_between(turned, to) - (between - most).max(0.0)).abs() < 2e-3);
        }
    }

    #[test]
    fn straight_up_is_a_direction_too() {
        let basis = Basis::facing(Vec3::Z);
        assert_eq!((basis.forward, basis.side, basis.up), (Vec3::Z, Vec3::Y, -Vec3::X));
        assert!((turned_towards(Vec3::X, -Vec3::X, 1.0, Vec3::Z).y - 1.0f32.sin()).abs() < 1e-6, "to the left");
    }
}
