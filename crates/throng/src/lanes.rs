//! Vectors of the plane, a lane an agent. Every operation is that of one agent's `Vec2`, in the same order: so lanes
//! have the same bits as agents one by one.

use fearless_simd::prelude::*;
use std::ops::{Add, Mul, Sub};

/// Lanes that a vector has at most.
pub(crate) const LANES: usize = 16;

/// A vector of the plane in every lane.
#[derive(Clone, Copy)]
pub(crate) struct Vec2s<S: Simd> {
    pub x: S::f32s,
    pub y: S::f32s,
}

impl<S: Simd> Vec2s<S> {
    #[inline(always)]
    pub fn load(simd: S, all: &[[f32; LANES]; 2]) -> Self {
        Self { x: load(simd, &all[0]), y: load(simd, &all[1]) }
    }

    #[inline(always)]
    pub fn dot(self, other: Self) -> S::f32s {
        self.x * other.x + self.y * other.y
    }

    #[inline(always)]
    pub fn perp_dot(self, other: Self) -> S::f32s {
        self.x * other.y - self.y * other.x
    }

    #[inline(always)]
    pub fn perp(self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    /// Divided, each component.
    #[inline(always)]
    pub fn over(self, by: S::f32s) -> Self {
        Self { x: self.x / by, y: self.y / by }
    }

    #[inline(always)]
    pub fn select(mask: S::mask32s, yes: Self, no: Self) -> Self {
        Self { x: mask.select(yes.x, no.x), y: mask.select(yes.y, no.y) }
    }

    /// As `Vec2::clamp_length_max`.
    #[inline(always)]
    pub fn clamp_length_max(self, most: S::f32s) -> Self {
        let length_squared = self.dot(self);
        let longer = length_squared.simd_gt(most * most);
        if !longer.any_true() {
            return self;
        }
        Self::select(longer, self.over(length_squared.sqrt()) * most, self)
    }
}

impl<S: Simd> Add for Vec2s<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl<S: Simd> Sub for Vec2s<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl<S: Simd> Mul<S::f32s> for Vec2s<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, by: S::f32s) -> Self {
        Self { x: self.x * by, y: self.y * by }
    }
}

/// The first lanes of an array.
#[inline(always)]
pub(crate) fn load<S: Simd>(simd: S, all: &[f32; LANES]) -> S::f32s {
    S::f32s::from_slice(simd, &all[..S::f32s::LEN])
}
