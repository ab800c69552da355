//! Mathematics with the same bits on every machine: transcendental functions come from `libm`.

use glam::{DQuat, DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Returns the rotation by `angle` (rad) about the x axis.
pub(crate) fn about_x(angle: f64) -> DQuat {
    let (sin, cos) = libm::sincos(angle / 2.0);
    DQuat::from_xyzw(sin, 0.0, 0.0, cos)
}

/// Returns the rotation by `angle` (rad) about the y axis.
pub(crate) fn about_y(angle: f64) -> DQuat {
    let (sin, cos) = libm::sincos(angle / 2.0);
    DQuat::from_xyzw(0.0, sin, 0.0, cos)
}

/// Returns the rotation by `angle` (rad) about the z axis.
pub(crate) fn about_z(angle: f64) -> DQuat {
    let (sin, cos) = libm::sincos(angle / 2.0);
    DQuat::from_xyzw(0.0, 0.0, sin, cos)
}

/// Returns the largest whole number up to `x`, which is within the range of `i64`: faster than `libm::floor`.
pub(crate) fn floor(x: f64) -> f64 {
    let whole = x as i64 as f64;
    if whole > x { whole - 1.0 } else { whole }
}

/// Returns the direction of `heading` (rad, counterclockwise from the x axis).
pub(crate) fn direction(heading: f64) -> DVec2 {
    let (sin, cos) = libm::sincos(heading);
    DVec2::new(cos, sin)
}

/// Returns `angle` less the whole turns, in -π..=π.
pub(crate) fn wrapped(angle: f64) -> f64 {
    let turns = libm::round(angle / TAU);
    (angle - turns * TAU).clamp(-PI, PI)
}

/// Returns the smooth step of third degree: 0 for x <= 0, 1 for x >= 1, with zero slope at both.
pub(crate) fn smooth(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// Returns the mixture of `a` (at 0) and `b` (at 1).
pub(crate) fn mix(a: f64, b: f64, share: f64) -> f64 {
    a + (b - a) * share
}

/// Returns the greater number, rounded off where the two differ by less than `width`.
pub(crate) fn smooth_max(a: f64, b: f64, width: f64) -> f64 {
    let overlap = (width - (a - b).abs()).max(0.0);
    a.max(b) + overlap * overlap / (4.0 * width)
}

/// The bump 64 u³ (1-u)³: 1 in the middle; value, slope and curvature are 0 at both ends.
pub(crate) fn bump(u: f64) -> f64 {
    let x = 4.0 * u * (1.0 - u);
    x * x * x
}

/// A polynomial of fifth degree between two values with given slopes and no curvature at the ends.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Quintic {
    start: f64,
    start_slope: f64,
    third: f64,
    fourth: f64,
    fifth: f64,
}

impl Quintic {
    /// Returns the polynomial over u in 0..=1 from `start` to `end`. Slopes are per unit of u.
    pub fn new(start: f64, start_slope: f64, end: f64, end_slope: f64) -> Quintic {
        let way = end - start - start_slope;
        let slope = end_slope - start_slope;
        Quintic {
            start,
            start_slope,
            third: 10.0 * way - 4.0 * slope,
            fourth: -15.0 * way + 7.0 * slope,
            fifth: 6.0 * way - 3.0 * slope,
        }
    }

    /// Returns the value at `u`.
    pub fn at(&self, u: f64) -> f64 {
        self.start + u * (self.start_slope + u * u * (self.third + u * (self.fourth + u * self.fifth)))
    }
}

/// Returns a number in 0..1 that is a function of the arguments only (SplitMix64).
pub(crate) fn uniform(seed: u64, number: u64, purpose: u64) -> f64 {
    let mut x = seed ^ number.wrapping_mul(0xD134_2543_DE82_EF95) ^ purpose.wrapping_mul(0x9E37_79B9_7F4A_7C15);
    for _ in 0..2 {
        x = x.wrapping_add(0x9E37_79B9_7F4A_7C15);
        x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        x ^= x >> 31;
    }
    (x >> 11) as f64 / (1u64 << 53) as f64
}

/// Returns a number with mean 0 and standard deviation 1, within 3.5 of 0: the sum of four uniform numbers.
pub(crate) fn normal(seed: u64, number: u64, purpose: u64) -> f64 {
    let sum: f64 = (0..4).map(|part| uniform(seed, number, purpose * 8 + part)).sum();
    (sum - 2.0) * 3.0_f64.sqrt()
}

/// Returns the rotation with the given orthonormal vectors as x, y and z axes.
pub(crate) fn from_axes(x: DVec3, y: DVec3, z: DVec3) -> DQuat {
    DQuat::from_mat3(&glam::DMat3::from_cols(x, y, z)).normalize()
}

/// Returns the least rotation from one unit vector to another. Opposite vectors are apart by half a turn about the x axis,
/// or about the y axis where they are along x.
pub(crate) fn arc(from: DVec3, to: DVec3) -> DQuat {
    let (axis, dot) = (from.cross(to), from.dot(to));
    if dot < -0.999_999_999 {
        let across = if from.x.abs() < 0.9 { DVec3::X } else { DVec3::Y };
        let axis = (across - from * from.dot(across)).normalize();
        return DQuat::from_xyzw(axis.x, axis.y, axis.z, 0.0);
    }
    DQuat::from_xyzw(axis.x, axis.y, axis.z, 1.0 + dot).normalize()
}

/// Returns the rotation a share of the way from `a` to `b`, along the shorter arc, at constant angular speed.
pub fn slerp(a: DQuat, b: DQuat, share: f64) -> DQuat {
    let dot = a.dot(b);
    let b = if dot < 0.0 { -b } else { b };
    let angle = libm::acos(dot.abs().min(1.0));
    if angle < 1e-6 {
        return (a * (1.0 - share) + b * share).normalize();
    }
    let sin = libm::sin(angle);
    (a * (libm::sin((1.0 - share) * angle) / sin) + b * (libm::sin(share * angle) / sin)).normalize()
}

#[cfg(test)]
mod tests {
    use super::{arc, floor};
    use glam::DVec3;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn an_arc_turns_one_vector_to_the_other(a in -1.0..1.0f64, b in -1.0..1.0f64, c in -3.0..3.0f64, d in -1.0..1.0f64) {
            let from = DVec3::new(a, b, c + 0.01).normalize();
            for to in [DVec3::new(d, c, a + 0.01).normalize(), from, -from, DVec3::Z, -DVec3::X] {
                prop_assert!((arc(from, to) * from).distance(to) < 1e-4);
                prop_assert!((arc(from, to).length() - 1.0).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn floor_is_that_of_libm() {
        for step in -1000..1000 {
            let x = f64::from(step) / 8.0;
            assert_eq!(floor(x), libm::floor(x));
        }
    }
}
