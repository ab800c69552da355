//! Evaluates a plate at many places at once with SIMD. It computes in `f32`, so it is less exact than [the scalar
//! path](super::plate), but has the same bits with every instruction set. Where single precision loses too many digits,
//! the scalar path is used.

use super::plate::{Center, Kernel, Plate};
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::{DVec2, Mat2, Vec2};

/// The coefficients of `atanh(s) / s` in powers of `s * s`, for the logarithm between the square roots of 1/2 and 2.
/// There `s` is at most 0.172 and the first missing term 2e-9.
const SERIES: [f32; 5] = [1.0, 1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0, 1.0 / 9.0];
/// The difference between the bits of 1 and those of the square root of 1/2.
const BELOW_ONE: u32 = 0x3f80_0000 - 0x3f35_04f3;
/// The bits of a mantissa, and the bias of exponents.
const MANTISSA: u32 = f32::MANTISSA_DIGITS - 1;
const BIAS: u32 = 127;

/// Returns the natural logarithm of a positive number; of zero, a finite number.
#[inline(always)]
fn ln<S: Simd>(simd: S, x: S::f32s) -> S::f32s {
    let splat = |value: f32| S::f32s::splat(simd, value);
    let bits: S::u32s = x.bitcast();
    let exponent = (bits + S::u32s::splat(simd, BELOW_ONE)) >> MANTISSA;
    let mantissa: S::f32s = (bits + S::u32s::splat(simd, BIAS << MANTISSA) - (exponent << MANTISSA)).bitcast();
    let exponent: S::f32s = exponent.to_float();
    let s = (mantissa - splat(1.0)) / (mantissa + splat(1.0));
    let square = s * s;
    let mut series = splat(0.0);
    for &term in SERIES.iter().rev() {
        series = series * square + splat(term);
    }
    (exponent - splat(BIAS as f32)) * splat(std::f32::consts::LN_2) + splat(2.0) * s * series
}

/// A centre and its weight, in `f32`.
type Single = (Vec2, Mat2, Vec2);

/// Gain above which single precision loses too many digits.
const GAIN: f64 = 2e4;

impl Plate<DVec2> {
    /// Computes the velocities at places in a row: `row.0` plus a multiple of `row.1` along +x, from index `from` on.
    pub fn row(&self, row: (DVec2, f64), from: usize, out: &mut [Vec2]) {
        if self.gain() > GAIN {
            let place = |index: usize| row.0 + DVec2::X * (index as f64 * row.1);
            return out.iter_mut().zip(from..).for_each(|(out, index)| *out = self.velocity(place(index)).as_vec2());
        }
        let weighted = self.weights().iter().zip(self.centers());
        let single = |(weight, center): (&DVec2, &Center<DVec2>)| {
            (center.place.as_vec2(), center.metric.as_mat2(), weight.as_vec2())
        };
        let centers: Vec<Single> = weighted.map(single).collect();
        dispatch!(Level::new(), simd => self.row_of(simd, &centers, row, from, out));
    }

    #[inline(always)]
    fn row_of<S: Simd>(&self, simd: S, centers: &[Single], (first, step): (DVec2, f64), from: usize, out: &mut [Vec2]) {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let (zero, one) = (splat(0.0), splat(1.0));
        // the linear part where the row crosses x = 0, and its slope along the row
        let cross = self.linear(first.with_x(0.0)).as_vec2();
        let slope = (self.linear(DVec2::X) - self.linear(DVec2::ZERO)).as_vec2();
        let y = splat(first.y as f32);
        for (part, out) in out.chunks_mut(S::f32s::LEN).enumerate() {
            let start = from + part * S::f32s::LEN;
            let x = S::f32s::from_fn(simd, |lane| (first.x + (start + lane) as f64 * step) as f32);
            let (mut vx, mut vy) = (x * splat(slope.x) + splat(cross.x), x * splat(slope.y) + splat(cross.y));
            for &(place, metric, weight) in centers {
                let (dx, dy) = (x - splat(place.x), y - splat(place.y));
                let p = dx * splat(metric.x_axis.x) + dy * splat(metric.y_axis.x);
                let q = dx * splat(metric.x_axis.y) + dy * splat(metric.y_axis.y);
                let squared = p * p + q * q;
                let influence = match self.kernel() {
                    Kernel::ThinPlate => splat(0.5) * squared * ln(simd, squared),
                    Kernel::Wendland { reach } => {
                        let r = squared.sqrt() / splat(reach as f32);
                        let left = (one - r).max(zero);
                        let left = left * left;
                        left * left * (splat(4.0) * r + one)
                    }
                };
                vx += influence * splat(weight.x);
                vy += influence * splat(weight.y);
            }
            let (vx, vy) = (vx.as_slice(), vy.as_slice());
            out.iter_mut().zip(vx.iter().zip(vy)).for_each(|(out, (&x, &y))| *out = Vec2::new(x, y));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn logarithms_are_logarithms(x in prop_oneof![f32::MIN_POSITIVE..1e-6, 1e-6f32..2.0, 2.0f32..1e9]) {
            let exact = f64::from(x).ln();
            dispatch!(Level::new(), simd => {
                let found = f64::from(ln(simd, prelude_splat(simd, x)).as_slice()[0]);
                assert!((found - exact).abs() <= 3e-7 * exact.abs().max(1.0), "{found} and {exact} of {x}");
            });
        }
    }

    fn prelude_splat<S: Simd>(simd: S, x: f32) -> S::f32s {
        S::f32s::splat(simd, x)
    }
}
