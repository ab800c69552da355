//! Rotations as angles about axes.

use glam::{DMat3, DQuat, DVec3};
use std::f64::consts::{PI, TAU};

/// The order of the axes of three rotations: the first is the outermost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// z, x, y.
    Zxy,
    /// z, y, x.
    Zyx,
}

impl Order {
    /// Returns the channels, as the file names them.
    pub fn channels(self) -> &'static str {
        match self {
            Self::Zxy => "Zrotation Xrotation Yrotation",
            Self::Zyx => "Zrotation Yrotation Xrotation",
        }
    }

    /// Returns the angles (rad) of a rotation, in the order of the channels. Of all angles of the rotation, they are the
    /// nearest to `before`.
    pub fn angles(self, rotation: DQuat, before: [f64; 3]) -> [f64; 3] {
        let m = DMat3::from_quat(rotation);
        let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
        let [first, middle, last] = match self {
            Self::Zxy => [libm::atan2(-y.x, y.y), asin(y.z), libm::atan2(-x.z, z.z)],
            Self::Zyx => [libm::atan2(x.y, x.x), asin(-x.z), libm::atan2(y.z, z.z)],
        };
        let near = |angles: [f64; 3]| -> [f64; 3] {
            std::array::from_fn(|k| angles[k] + TAU * libm::round((before[k] - angles[k]) / TAU))
        };
        let away = |angles: &[f64; 3]| -> f64 { angles.iter().zip(before).map(|(a, b)| (a - b) * (a - b)).sum() };
        let (own, other) = (near([first, middle, last]), near([first + PI, PI - middle, last + PI]));
        if away(&other) < away(&own) { other } else { own }
    }
}

/// Returns the arc sine of a number that rounding may have put beyond 1.
fn asin(sine: f64) -> f64 {
    libm::asin(sine.clamp(-1.0, 1.0))
}

/// Returns the rotation by `angle` (rad) about an axis of unit length.
pub fn about(axis: DVec3, angle: f64) -> DQuat {
    let (sin, cos) = libm::sincos(angle / 2.0);
    let [x, y, z] = (axis * sin).to_array();
    DQuat::from_xyzw(x, y, z, cos)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn angles_make_the_rotation_and_are_near_those_before(
            axis in (-1.0..1.0f64, -1.0..1.0f64, 0.1..1.0f64), angle in -3.0..3.0f64, before in prop::array::uniform3(-9.0..9.0f64),
        ) {
            let rotation = DQuat::from_axis_angle(DVec3::from(axis).normalize(), angle);
            for (order, axes) in [(Order::Zxy, [DVec3::Z, DVec3::X, DVec3::Y]), (Order::Zyx, [DVec3::Z, DVec3::Y, DVec3::X])] {
                let angles = order.angles(rotation, before);
                let again = axes.iter().zip(angles).fold(DQuat::IDENTITY, |all, (&axis, angle)| all * DQuat::from_axis_angle(axis, angle));
                prop_assert!(again.angle_between(rotation) < 1e-6, "{order:?} {angles:?}");
                // the sum of squares of all others that make the rotation is larger
                prop_assert!(angles.iter().zip(before).all(|(a, b)| (a - b).abs() <= TAU));
                // half a turn about the outer axes and the supplement of the middle angle is the only other solution
                let other = [angles[0] + PI, PI - angles[1], angles[2] + PI];
                let best = |angles: [f64; 3]| -> f64 {
                    angles.iter().zip(before).map(|(a, b)| ((a - b + PI).rem_euclid(TAU) - PI).powi(2)).sum()
                };
                prop_assert!(best(angles) <= best(other) + 1e-9);
            }
        }
    }
}
