//! SIMD vectors of the plane and of space, with one agent in each element. Every operation does what `Vec2` or `Vec3`
//! does for one agent, in the same order: the bits are the same as those of the scalar path.

use fearless_simd::prelude::*;
use glam::{Vec2, Vec3};
use std::ops::{Add, Mul, Sub};

/// Largest SIMD width: elements of a vector.
pub const LANES: usize = 16;

/// A 2D vector in every element.
#[derive(Clone, Copy)]
pub(crate) struct Vec2s<S: Simd> {
    pub x: S::f32s,
    pub y: S::f32s,
}

impl<S: Simd> Vec2s<S> {
    /// Returns the same vector in every element.
    #[inline(always)]
    pub fn splat(simd: S, v: Vec2) -> Self {
        Self { x: S::f32s::splat(simd, v.x), y: S::f32s::splat(simd, v.y) }
    }

    #[inline(always)]
    pub fn load(simd: S, all: &[[f32; LANES]; 2]) -> Self {
        Self::load_from(simd, all, 0)
    }

    /// Loads a SIMD vector from arrays, starting at index `from`.
    #[inline(always)]
    pub fn load_from(simd: S, all: &[[f32; LANES]; 2], from: usize) -> Self {
        Self { x: load_from(simd, &all[0], from), y: load_from(simd, &all[1], from) }
    }

    /// Stores each component into its array.
    #[inline(always)]
    pub fn store(self, all: &mut [[f32; LANES]; 2]) {
        self.x.store_slice(&mut all[0][..S::f32s::LEN]);
        self.y.store_slice(&mut all[1][..S::f32s::LEN]);
    }

    /// Loads 2D vectors that lie side by side in memory, at most as many as the SIMD width. The remaining elements are
    /// zero.
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

    /// Stores the 2D vectors side by side in memory, as many as `all` holds.
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

    /// Divides each component.
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

/// A 3D vector in every element.
#[derive(Clone, Copy)]
pub struct Vec3s<S: Simd> {
    /// The components along x.
    pub x: S::f32s,
    /// The components along y.
    pub y: S::f32s,
    /// The components along z.
    pub z: S::f32s,
}

impl<S: Simd> Vec3s<S> {
    /// Returns the same vector in every element.
    #[inline(always)]
    pub fn splat(simd: S, v: Vec3) -> Self {
        Self { x: S::f32s::splat(simd, v.x), y: S::f32s::splat(simd, v.y), z: S::f32s::splat(simd, v.z) }
    }

    /// Loads a SIMD vector from the start of arrays, one array per component.
    #[inline(always)]
    pub fn load(simd: S, all: &[[f32; LANES]; 3]) -> Self {
        Self { x: load(simd, &all[0]), y: load(simd, &all[1]), z: load(simd, &all[2]) }
    }

    /// Stores each component into its array.
    #[inline(always)]
    pub fn store(self, all: &mut [[f32; LANES]; 3]) {
        self.x.store_slice(&mut all[0][..S::f32s::LEN]);
        self.y.store_slice(&mut all[1][..S::f32s::LEN]);
        self.z.store_slice(&mut all[2][..S::f32s::LEN]);
    }

    /// As `Vec3::dot`.
    #[inline(always)]
    pub fn dot(self, other: Self) -> S::f32s {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Returns the components along the ground.
    #[inline(always)]
    pub(crate) fn truncate(self) -> Vec2s<S> {
        Vec2s { x: self.x, y: self.y }
    }

    /// As `Vec3::length`.
    #[inline(always)]
    pub fn length(self) -> S::f32s {
        self.dot(self).sqrt()
    }

    /// As `Vec3::cross`.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - other.y * self.z,
            y: self.z * other.x - other.z * self.x,
            z: self.x * other.y - other.x * self.y,
        }
    }

    /// As `Vec3::lerp`.
    #[inline(always)]
    pub fn lerp(self, simd: S, other: Self, part: f32) -> Self {
        self * S::f32s::splat(simd, 1.0 - part) + other * S::f32s::splat(simd, part)
    }

    /// As `Vec3::reject_from_normalized`.
    #[inline(always)]
    pub fn reject_from_normalized(self, other: Self) -> Self {
        self - other * self.dot(other)
    }

    /// Divides each component.
    #[inline(always)]
    pub fn over(self, by: S::f32s) -> Self {
        Self { x: self.x / by, y: self.y / by, z: self.z / by }
    }

    /// Returns `yes` in the elements of the mask, and `no` in the other elements.
    #[inline(always)]
    pub fn select(mask: S::mask32s, yes: Self, no: Self) -> Self {
        Self { x: mask.select(yes.x, no.x), y: mask.select(yes.y, no.y), z: mask.select(yes.z, no.z) }
    }

    /// As `Vec3::try_normalize`: the elements that have a direction, and the directions. Elsewhere the direction is
    /// meaningless.
    #[inline(always)]
    pub fn try_normalize(self, simd: S) -> (S::mask32s, Self) {
        let inverse = S::f32s::splat(simd, 1.0) / self.length();
        (inverse.is_finite() & inverse.simd_gt(S::f32s::splat(simd, 0.0)), self * inverse)
    }

    /// As `Vec3::clamp_length_max`.
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

/// Loads a SIMD vector from the start of an array.
#[inline(always)]
pub fn load<S: Simd>(simd: S, all: &[f32; LANES]) -> S::f32s {
    load_from(simd, all, 0)
}

/// Loads a SIMD vector from an array, starting at index `from`.
#[inline(always)]
pub(crate) fn load_from<S: Simd>(simd: S, all: &[f32; LANES], from: usize) -> S::f32s {
    S::f32s::from_slice(simd, &all[from..from + S::f32s::LEN])
}

/// Loads numbers that lie side by side in memory, at most as many as the SIMD width. The remaining elements are zero.
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

/// Loads two 2D vectors for each element; the two lie side by side in memory.
#[inline(always)]
pub(crate) fn load_pairs<S: Simd>(simd: S, all: &[[f32; 4]; LANES]) -> [Vec2s<S>; 2] {
    let (flat, lanes) = (all.as_flattened(), S::f32s::LEN);
    let part = |at: usize| S::f32s::from_slice(simd, &flat[at * lanes..(at + 1) * lanes]);
    // memory holds x and y of the first vector, then x and y of the second
    let (a, b) = part(0).deinterleave(part(1));
    let (c, d) = part(2).deinterleave(part(3));
    let ((ax, bx), (ay, by)) = (a.deinterleave(c), b.deinterleave(d));
    [Vec2s { x: ax, y: ay }, Vec2s { x: bx, y: by }]
}

/// Words of a record.
pub(crate) const WORDS: usize = 16;

/// Transposes records: element `i` of vector `w` becomes word `w` of record `i`.
#[inline(always)]
pub(crate) fn load_records<S: Simd>(simd: S, records: &[[f32; WORDS]; LANES]) -> [S::f32s; WORDS] {
    let (flat, lanes) = (records.as_flattened(), S::f32s::LEN);
    let mut all = [S::f32s::splat(simd, 0.0); WORDS];
    for (at, vector) in all.iter_mut().enumerate() {
        *vector = S::f32s::from_slice(simd, &flat[at * lanes..(at + 1) * lanes]);
    }
    // each pass rotates the lowest bit of a word's index to the highest place
    let mut halved = 1;
    while halved < WORDS {
        let before = all;
        for at in 0..WORDS / 2 {
            (all[at], all[at + WORDS / 2]) = before[2 * at].deinterleave(before[2 * at + 1]);
        }
        halved *= 2;
    }
    all
}

/// Transposes back: the inverse of [`load_records`].
#[inline(always)]
pub(crate) fn store_records<S: Simd>(_: S, words: [S::f32s; WORDS], records: &mut [[f32; WORDS]; LANES]) {
    let (flat, lanes) = (records.as_flattened_mut(), S::f32s::LEN);
    let mut all = words;
    let mut doubled = 1;
    while doubled < WORDS {
        let before = all;
        for at in 0..WORDS / 2 {
            (all[2 * at], all[2 * at + 1]) = before[at].interleave(before[at + WORDS / 2]);
        }
        doubled *= 2;
    }
    for (at, vector) in all.into_iter().enumerate() {
        vector.store_slice(&mut flat[at * lanes..(at + 1) * lanes]);
    }
}

/// Stores a 2D vector at index `lane` of the arrays.
#[inline(always)]
pub(crate) fn set(all: &mut [[f32; LANES]; 2], lane: usize, v: Vec2) {
    (all[0][lane], all[1][lane]) = (v.x, v.y);
}

/// Stores a 3D vector at index `lane` of the arrays.
#[inline(always)]
pub fn set3(all: &mut [[f32; LANES]; 3], lane: usize, v: Vec3) {
    (all[0][lane], all[1][lane], all[2][lane]) = (v.x, v.y, v.z);
}

/// Returns the 2D vector at index `lane` of the arrays.
#[inline(always)]
pub(crate) fn get(all: &[[f32; LANES]; 2], lane: usize) -> Vec2 {
    Vec2::new(all[0][lane], all[1][lane])
}

/// Returns the 3D vector at index `lane` of the arrays.
#[inline(always)]
pub fn get3(all: &[[f32; LANES]; 3], lane: usize) -> Vec3 {
    Vec3::new(all[0][lane], all[1][lane], all[2][lane])
}

/// Returns the positions of the set bits of a word, lowest first.
#[inline]
pub fn ones(mut word: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let place = word.trailing_zeros();
        word &= word.wrapping_sub(1);
        (place < u64::BITS).then_some(place as usize)
    })
}

/// Combines ground and vertical components into 3D vectors.
#[inline(always)]
pub(crate) fn in_space<S: Simd>(simd: S, ground: &[Vec2], z: S::f32s) -> Vec3s<S> {
    let Vec2s { x, y } = Vec2s::from_side_by_side(simd, ground);
    Vec3s { x, y, z }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::perceive::SimdLevel;
    use fearless_simd::dispatch;

    #[test]
    fn records_come_to_their_lanes_and_back() {
        let all: [[f32; WORDS]; LANES] =
            std::array::from_fn(|lane| std::array::from_fn(|at| (WORDS * lane + at) as f32));
        for level in SimdLevel::ALL.into_iter().filter_map(SimdLevel::level) {
            dispatch!(level, simd => {
                let words = load_records(simd, &all);
                let mut back = [[0.0; WORDS]; LANES];
                store_records(simd, words, &mut back);
                for (lane, record) in all.iter().enumerate().take(words[0].as_slice().len()) {
                    let found: Vec<f32> = words.iter().map(|word| word.as_slice()[lane]).collect();
                    assert_eq!((&found[..], back[lane]), (&record[..], *record), "{level:?}");
                }
            });
        }
    }

    #[test]
    fn pairs_come_to_their_lanes() {
        let all: [[f32; 4]; LANES] = std::array::from_fn(|lane| std::array::from_fn(|at| (4 * lane + at) as f32));
        for level in SimdLevel::ALL.into_iter().filter_map(SimdLevel::level) {
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
