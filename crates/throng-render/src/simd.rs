//! SIMD vectors of the plane and of space, with one pixel in each element. Every operation does what `Vec2` or `Vec3` does
//! for one pixel, in the same order: the bits are the same for all instructions.

use fearless_simd::prelude::*;
use glam::Vec3;
use std::ops::{Add, Mul, Sub};

/// Largest SIMD width: elements of a vector.
pub const LANES: usize = 16;
/// A number in each element.
pub type Floats = [f32; LANES];

/// A 2D vector in every element.
#[derive(Clone, Copy)]
pub struct Vec2s<S: Simd> {
    pub x: S::f32s,
    pub y: S::f32s,
}

impl<S: Simd> Vec2s<S> {
    #[inline(always)]
    pub fn select(mask: S::mask32s, yes: Self, no: Self) -> Self {
        Self { x: mask.select(yes.x, no.x), y: mask.select(yes.y, no.y) }
    }
}

impl<S: Simd> Mul<S::f32s> for Vec2s<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, by: S::f32s) -> Self {
        Self { x: self.x * by, y: self.y * by }
    }
}

/// A 3D vector in every element.
#[derive(Clone, Copy)]
pub struct Vec3s<S: Simd> {
    pub x: S::f32s,
    pub y: S::f32s,
    pub z: S::f32s,
}

impl<S: Simd> Vec3s<S> {
    /// Returns the same vector in every element.
    #[inline(always)]
    pub fn splat(simd: S, v: Vec3) -> Self {
        Self { x: S::f32s::splat(simd, v.x), y: S::f32s::splat(simd, v.y), z: S::f32s::splat(simd, v.z) }
    }

    #[inline(always)]
    pub fn load(simd: S, all: &[Floats; 3]) -> Self {
        Self { x: load(simd, &all[0]), y: load(simd, &all[1]), z: load(simd, &all[2]) }
    }

    /// Returns the vectors of the elements. Those beyond the SIMD width are zero.
    #[inline(always)]
    pub fn each(self) -> [Vec3; LANES] {
        let mut all = [[0.0; LANES]; 3];
        for (part, all) in [self.x, self.y, self.z].into_iter().zip(&mut all) {
            part.store_slice(&mut all[..S::f32s::LEN]);
        }
        std::array::from_fn(|k| Vec3::new(all[0][k], all[1][k], all[2][k]))
    }

    #[inline(always)]
    pub fn dot(self, other: Self) -> S::f32s {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub fn length_squared(self) -> S::f32s {
        self.dot(self)
    }

    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - other.y * self.z,
            y: self.z * other.x - other.z * self.x,
            z: self.x * other.y - other.x * self.y,
        }
    }

    /// Multiplies each component with that of another vector.
    #[inline(always)]
    pub fn times(self, other: Self) -> Self {
        Self { x: self.x * other.x, y: self.y * other.y, z: self.z * other.z }
    }

    #[inline(always)]
    pub fn negated(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }

    #[inline(always)]
    pub fn lerp(self, simd: S, other: Self, part: S::f32s) -> Self {
        self * (S::f32s::splat(simd, 1.0) - part) + other * part
    }

    #[inline(always)]
    pub fn normalize_or(self, simd: S, other: Self) -> Self {
        let inverse = S::f32s::splat(simd, 1.0) / self.dot(self).sqrt();
        let has_direction = inverse.is_finite() & inverse.simd_gt(S::f32s::splat(simd, 0.0));
        Self::select(has_direction, self * inverse, other)
    }

    /// Returns `yes` in the elements of the mask, and `no` in the other elements.
    #[inline(always)]
    pub fn select(mask: S::mask32s, yes: Self, no: Self) -> Self {
        Self { x: mask.select(yes.x, no.x), y: mask.select(yes.y, no.y), z: mask.select(yes.z, no.z) }
    }
}

impl<S: Simd> Add for Vec3s<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<S: Simd> Sub for Vec3s<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<S: Simd> Mul<S::f32s> for Vec3s<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, by: S::f32s) -> Self {
        Self { x: self.x * by, y: self.y * by, z: self.z * by }
    }
}

/// Sets an element of arrays, one array per component.
#[inline(always)]
pub fn set3(all: &mut [Floats; 3], element: usize, v: Vec3) {
    (all[0][element], all[1][element], all[2][element]) = (v.x, v.y, v.z);
}

/// Loads a SIMD vector from the start of an array.
#[inline(always)]
pub fn load<S: Simd>(simd: S, all: &Floats) -> S::f32s {
    S::f32s::from_slice(simd, &all[..S::f32s::LEN])
}

/// Returns the elements. Those beyond the SIMD width are zero.
#[inline(always)]
pub fn each<S: Simd>(values: S::f32s) -> Floats {
    let mut all = [0.0; LANES];
    values.store_slice(&mut all[..S::f32s::LEN]);
    all
}

/// Returns the elements in which a flag is set.
#[inline(always)]
pub fn mask<S: Simd>(simd: S, flags: &[bool; LANES]) -> S::mask32s {
    let numbers = flags.map(|flag| f32::from(u8::from(flag)));
    load(simd, &numbers).simd_gt(S::f32s::splat(simd, 0.0))
}
