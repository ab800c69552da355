//! The angle of a vector, computed with basic arithmetic only: the scalar and SIMD versions give the same bits on every
//! machine.

use crate::simd::Vec2s;
use fearless_simd::prelude::*;
use glam::Vec2;
use std::f32::consts::{FRAC_PI_2, PI};

/// Coefficients of `atan(a) / a` in powers of `a * a`, for `a` from 0 to 1: the minimax polynomial, with an error of at
/// most 1.4e-8. With rounding an angle has an error of at most 4e-7.
const ARC: [f32; 9] = [
    1.0,
    -0.333_330_93,
    0.199_930_53,
    -0.142_071_32,
    0.106_546_71,
    -0.075_336_61,
    0.043_039_18,
    -0.016_282_884,
    0.002_903_520_4,
];

/// Returns the angle of a vector, radians counter-clockwise from +x, -pi to pi; 0 or pi for a vector of length zero.
pub fn angle(v: Vec2) -> f32 {
    let (x, y) = (v.x.abs(), v.y.abs());
    let steep = y > x;
    let (low, high) = if steep { (x, y) } else { (y, x) };
    let part = if high > 0.0 { low / high } else { 0.0 };
    let square = part * part;
    let series = ARC.iter().rev().fold(0.0, |sum, term| sum * square + term);
    let arc = part * series;
    let arc = if steep { FRAC_PI_2 - arc } else { arc };
    let arc = if v.x < 0.0 { PI - arc } else { arc };
    arc.copysign(v.y)
}

/// SIMD version of [`angle`].
#[inline(always)]
pub(crate) fn angles<S: Simd>(simd: S, v: Vec2s<S>) -> S::f32s {
    let splat = |value: f32| S::f32s::splat(simd, value);
    let zero = splat(0.0);
    let (x, y) = (v.x.abs(), v.y.abs());
    let steep = y.simd_gt(x);
    let (low, high) = (steep.select(x, y), steep.select(y, x));
    let part = high.simd_gt(zero).select(low / high, zero);
    let square = part * part;
    let mut series = zero;
    for &term in ARC.iter().rev() {
        series = series * square + splat(term);
    }
    let arc = part * series;
    let arc = steep.select(splat(FRAC_PI_2) - arc, arc);
    let arc = v.x.simd_lt(zero).select(splat(PI) - arc, arc);
    arc.copysign(v.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn it_is_that_of_the_library(x in -1e3f32..1e3, y in -1e3f32..1e3, scale in -20i32..20) {
            let v = Vec2::new(x, y) * libm::exp2f(scale as f32);
            let expected = libm::atan2(f64::from(v.y), f64::from(v.x));
            prop_assert!((f64::from(angle(v)) - expected).abs() < 4e-7, "{} {expected}", angle(v));
        }
    }

    #[test]
    fn along_the_axes_it_is_exact() {
        let all = [(1.0, 0.0), (0.0, 2.0), (-3.0, 0.0), (0.0, -4.0), (0.0, 0.0), (-1.0, -0.0), (1.0, -0.0)];
        for (x, y) in all {
            assert_eq!(angle(Vec2::new(x, y)).to_bits(), libm::atan2f(y, x).to_bits(), "{x} {y}");
        }
    }
}
