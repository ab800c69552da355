//! Sun, sky and haze.

use crate::linear;
use crate::simd::Vec3s;
use fearless_simd::prelude::*;
use glam::Vec3;

/// The light of the sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// The direction to the sun, anticlockwise from the axis x, radians.
    pub azimuth: f32,
    /// The height of the sun above the horizon, radians, 0.05 to 1.57; values beyond are limited.
    pub elevation: f32,
    /// The light on a surface that faces the sun, linear.
    pub color: Vec3,
    /// The angle that the sun spans, radians, 0 to 0.2. Larger is softer; the real sun spans 0.0093.
    pub size: f32,
}

impl Sun {
    /// Returns the direction to the sun, of length 1.
    pub fn direction(&self) -> Vec3 {
        let elevation = if self.elevation.is_finite() { self.elevation } else { 0.7 };
        let azimuth = if self.azimuth.is_finite() { self.azimuth } else { 0.0 };
        let (up, out) = libm::sincosf(elevation.clamp(0.05, 1.57));
        let (y, x) = libm::sincosf(azimuth);
        Vec3::new(x * out, y * out, up)
    }
}

/// The light of the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sky {
    /// The colour at the horizon, linear light.
    pub horizon: Vec3,
    /// The colour straight above, linear light.
    pub zenith: Vec3,
    /// The light on a horizontal surface under an open sky.
    pub light: Vec3,
    /// The light from below, which the ground reflects.
    pub bounce: Vec3,
}

impl Sky {
    /// Returns the colours of the sky in directions of length 1.
    #[inline(always)]
    pub(crate) fn color<S: Simd>(&self, simd: S, directions: Vec3s<S>) -> Vec3s<S> {
        let [zero, one] = [0.0, 1.0].map(|value| S::f32s::splat(simd, value));
        let flat = one - directions.z.max(zero).min(one);
        Vec3s::splat(simd, self.horizon).lerp(simd, Vec3s::splat(simd, self.zenith), one - flat * flat)
    }
}

/// Haze: distant surfaces fade to the colour of the horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Haze {
    /// The distance at which a surface has lost 63 % of its colour, metres; infinity for none.
    pub distance: f32,
}

impl Haze {
    /// Returns the share of its colour that a surface keeps.
    #[inline(always)]
    pub(crate) fn clear<S: Simd>(&self, simd: S, distance: S::f32s) -> S::f32s {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let one = splat(1.0);
        let x = distance / splat(self.distance.max(1e-3));
        // the exponential by its series: cheap, and the same bits on all machines
        one / (one + x * (one + x * (splat(0.5) + x * splat(1.0 / 6.0))))
    }
}

/// All light of a scene. The default is a clear afternoon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// The sun.
    pub sun: Sun,
    /// The sky.
    pub sky: Sky,
    /// The haze.
    pub haze: Haze,
    /// The factor from light to the brightness of the picture.
    pub exposure: f32,
}

impl Default for Light {
    fn default() -> Self {
        Self {
            sun: Sun { azimuth: 2.5, elevation: 0.68, color: Vec3::new(1.0, 0.93, 0.82) * 1.5, size: 0.05 },
            sky: Sky {
                horizon: linear(0xe9eef2),
                zenith: linear(0x9fbfdd),
                light: Vec3::new(0.37, 0.42, 0.51),
                bounce: Vec3::new(0.24, 0.22, 0.2),
            },
            haze: Haze { distance: 220.0 },
            exposure: 0.8,
        }
    }
}
