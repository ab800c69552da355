//! Vectors of the plane, a lane an agent. Every operation is that of one agent's `Vec2`, in the same order: so lanes
//! have the same bits as agents one by one.

use fearless_simd::prelude::*;
use glam::Vec2;
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

    /// Those that lie side by side in memory, at most a vector; zero in the lanes that are left.
    #[inline(always)]
    pub fn from_side_by_side(simd: S, all: &[Vec2]) -> Self {
        let lanes = S::f32s::LEN;
        let mut padded = [0.0; 2 * LANES];
        let mut flat: &[f32] = bytemuck::cast_slice(all);
        if all.len() < lanes {
            padded[..flat.len()].copy_from_slice(flat);
            flat = &padded;
        }
        let (x, y) =
            S::f32s::from_slice(simd, &flat[..lanes]).deinterleave(S::f32s::from_slice(simd, &flat[lanes..2 * lanes]));
        Self { x, y }
    }

    /// Puts as many as there are places side by side in memory.
    #[inline(always)]
    pub fn put_side_by_side(self, all: &mut [Vec2]) {
        let lanes = S::f32s::LEN;
        let (low, high) = self.x.interleave(self.y);
        let flat: &mut [f32] = bytemuck::cast_slice_mut(all);
        if flat.len() == 2 * lanes {
            low.store_slice(&mut flat[..lanes]);
            high.store_slice(&mut flat[lanes..]);
        } else {
            let mut padded = [0.0; 2 * LANES];
            low.store_slice(&mut padded[..lanes]);
            high.store_slice(&mut padded[lanes..2 * lanes]);
            flat.copy_from_slice(&padded[..flat.len()]);
        }
    }

    /// As `Vec2::normalize_or_zero`.
    #[inline(always)]
    pub fn normalize_or_zero(self, simd: S) -> Self {
        let zero = S::f32s::splat(simd, 0.0);
        let inverse = S::f32s::splat(simd, 1.0) / self.dot(self).sqrt();
        let is_some = inverse.is_finite() & inverse.simd_gt(zero);
        Self::select(is_some, self * inverse, Self { x: zero, y: zero })
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

/// Numbers side by side in memory, at most a vector; zero in the lanes that are left.
#[inline(always)]
pub(crate) fn from_side_by_side<S: Simd>(simd: S, all: &[f32]) -> S::f32s {
    if all.len() == S::f32s::LEN {
        S::f32s::from_slice(simd, all)
    } else {
        let mut padded = [0.0; LANES];
        padded[..all.len()].copy_from_slice(all);
        load(simd, &padded)
    }
}

/// Two vectors of each lane that lie side by side in memory.
#[inline(always)]
pub(crate) fn load_pairs<S: Simd>(simd: S, all: &[[f32; 4]; LANES]) -> [Vec2s<S>; 2] {
    let (flat, lanes) = (all.as_flattened(), S::f32s::LEN);
    let part = |at: usize| S::f32s::from_slice(simd, &flat[at * lanes..(at + 1) * lanes]);
    // x and y of the first and the second vector take turns
    let (a, b) = part(0).deinterleave(part(1));
    let (c, d) = part(2).deinterleave(part(3));
    let ((ax, bx), (ay, by)) = (a.deinterleave(c), b.deinterleave(d));
    [Vec2s { x: ax, y: ay }, Vec2s { x: bx, y: by }]
}

/// Puts a vector into a lane of arrays.
#[inline(always)]
pub(crate) fn set(all: &mut [[f32; LANES]; 2], lane: usize, v: Vec2) {
    (all[0][lane], all[1][lane]) = (v.x, v.y);
}

/// The places of the ones in a word, the lowest first.
#[inline]
pub(crate) fn ones(mut word: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let place = word.trailing_zeros();
        word &= word.wrapping_sub(1);
        (place < u64::BITS).then_some(place as usize)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::perceive::Instructions;
    use fearless_simd::dispatch;

    #[test]
    fn pairs_come_to_their_lanes() {
        let all: [[f32; 4]; LANES] = std::array::from_fn(|lane| std::array::from_fn(|at| (4 * lane + at) as f32));
        for level in Instructions::ALL.into_iter().filter_map(Instructions::level) {
            dispatch!(level, simd => {
                let [a, b] = load_pairs(simd, &all);
                let lanes = a.x.as_slice().iter().zip(a.y.as_slice()).zip(b.x.as_slice().iter().zip(b.y.as_slice()));
                for (((&ax, &ay), (&bx, &by)), expected) in lanes.zip(&all) {
                    assert_eq!([ax, ay, bx, by], *expected, "{level:?}");
                }
            });
        }
    }
}
