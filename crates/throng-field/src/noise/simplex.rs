//! Simplex noise and its gradient at many places at once, one place in each element of a SIMD vector.
//!
//! Perlin, *Noise Hardware*, SIGGRAPH 2001 course notes; Gustavson, *Simplex noise demystified*, 2005. Every corner of
//! a lattice of simplices has a random gradient `g`. A corner contributes `t^4 (g . d)` with `t = 1/2 - |d|^2`, where
//! `d` is the offset from it, where `t` is above zero. With 1/2 a corner reaches exactly as far as the simplices around
//! it, so the noise and its first three derivatives are continuous in any number of dimensions. The components of
//! gradients are bytes of the corner's hash: this needs no tables and no SIMD gathers.
//!
//! The position in the lattice is computed in `f64`: the noise is as smooth far from the origin as near it. The lattice
//! repeats after 2^32 cells.

use fearless_simd::prelude::*;

/// Odd factors that hash the coordinates of a corner, one for each axis.
const FACTORS: [u32; 4] = [0x9e37_79b1, 0x85eb_ca77, 0xc2b2_ae3d, 0x27d4_eb2f];

/// The mean of a byte.
const MIDDLE: f32 = 127.5;

/// The variance of a component of a gradient: that of a byte.
pub(super) const VARIANCE: f64 = 65_535.0 / 12.0;

/// Numbers in `f64`, for the lower and the upper half of a vector.
pub(super) type Wide<S> = (<S as Simd>::f64s, <S as Simd>::f64s);

/// `K` noises with independent gradients, and their derivatives along each axis.
#[derive(Clone, Copy)]
pub(super) struct Jets<S: Simd, const D: usize, const K: usize> {
    pub value: [S::f32s; K],
    pub slope: [[S::f32s; D]; K],
}

/// Returns the factors that skew a place to the lattice and back, for this number of dimensions.
const fn skews(dimensions: usize) -> (f64, f64) {
    // the square roots of 4 and 5, for 3 and 4 dimensions
    let root = if dimensions == 3 { 2.0 } else { 2.236_067_977_499_79 };
    ((root - 1.0) / dimensions as f64, (1.0 - 1.0 / root) / dimensions as f64)
}

/// Computes `K` noises of 3 or 4 dimensions at places in units of the length. Components of gradients are from -127.5
/// to 127.5 in steps of 1.
#[inline(always)]
pub(super) fn simplex<S: Simd, const D: usize, const K: usize>(
    simd: S,
    at: [Wide<S>; D],
    seed: S::u32s,
) -> Jets<S, D, K> {
    let splat = |value: f32| S::f32s::splat(simd, value);
    let (zero, one) = (splat(0.0), splat(1.0));
    let (_, unskew) = skews(D);
    let (cell, from) = locate(simd, at);
    // the order in which the path from the lowest to the highest corner of the simplex takes the axes: the largest
    // offset first
    let mut rank = [zero; D];
    for high in 1..D {
        for low in 0..high {
            let first = from[low].simd_ge(from[high]);
            rank[low] = first.select(rank[low] + one, rank[low]);
            rank[high] = first.select(rank[high], rank[high] + one);
        }
    }
    let (mut here, mut next) = ([seed; D], [seed; D]);
    for axis in 0..D {
        here[axis] = cell[axis] * S::u32s::splat(simd, FACTORS[axis]);
        next[axis] = here[axis] + S::u32s::splat(simd, FACTORS[axis]);
    }
    let mut jets = Jets { value: [zero; K], slope: [[zero; D]; K] };
    for corner in 0..=D {
        let mut offset = from;
        let mut hash = seed;
        let mut square = zero;
        for axis in 0..D {
            let taken = rank[axis].simd_ge(splat((D - corner) as f32));
            let step = taken.select(one, zero);
            offset[axis] = from[axis] - step + splat((corner as f64 * unskew) as f32);
            square += offset[axis] * offset[axis];
            hash ^= taken.select(next[axis], here[axis]);
        }
        let t = (splat(0.5) - square).max(zero);
        let t2 = t * t;
        let (t3, t4) = (t2 * t, t2 * t2);
        hash = mix(simd, hash);
        for k in 0..K {
            if k > 0 {
                hash = mix_again(simd, hash);
            }
            let mut ahead = zero;
            let mut gradient = [zero; D];
            for axis in 0..D {
                let byte: S::i32s = ((hash >> (8 * axis as u32)) & S::u32s::splat(simd, 0xff)).bitcast();
                gradient[axis] = byte.to_float::<S::f32s>() - splat(MIDDLE);
                ahead += gradient[axis] * offset[axis];
            }
            jets.value[k] += t4 * ahead;
            let fall = splat(8.0) * t3 * ahead;
            for axis in 0..D {
                jets.slope[k][axis] += t4 * gradient[axis] - fall * offset[axis];
            }
        }
    }
    jets
}

/// Returns the cells that contain the places, and the offsets from each cell's lowest corner.
#[inline(always)]
fn locate<S: Simd, const D: usize>(simd: S, at: [Wide<S>; D]) -> ([S::u32s; D], [S::f32s; D]) {
    let splat = |value: f64| S::f64s::splat(simd, value);
    let (skew, unskew) = skews(D);
    // added to a whole number, this puts the number into the last bits of the sum
    let whole = splat(1.5 * (1_u64 << 52) as f64);
    let mut sum = (splat(0.0), splat(0.0));
    for axis in &at {
        sum = (sum.0 + axis.0, sum.1 + axis.1);
    }
    let diagonal = (sum.0 * splat(skew), sum.1 * splat(skew));
    let mut floors = at;
    let mut sum = (splat(0.0), splat(0.0));
    for axis in 0..D {
        floors[axis] = ((at[axis].0 + diagonal.0).floor(), (at[axis].1 + diagonal.1).floor());
        sum = (sum.0 + floors[axis].0, sum.1 + floors[axis].1);
    }
    let back = (sum.0 * splat(unskew), sum.1 * splat(unskew));
    let mut cell = [S::u32s::splat(simd, 0); D];
    let mut from = [S::f32s::splat(simd, 0.0); D];
    for axis in 0..D {
        let floor = floors[axis];
        let (low, high): (S::u64s, S::u64s) = ((floor.0 + whole).bitcast(), (floor.1 + whole).bitcast());
        cell[axis] = low.narrow(high);
        from[axis] = (at[axis].0 - floor.0 + back.0).narrow(at[axis].1 - floor.1 + back.1);
    }
    (cell, from)
}

/// Returns a hash: every bit depends on all bits of the input.
#[inline(always)]
fn mix<S: Simd>(simd: S, mut bits: S::u32s) -> S::u32s {
    bits = (bits ^ (bits >> 16)) * S::u32s::splat(simd, 0x7feb_352d);
    bits = (bits ^ (bits >> 15)) * S::u32s::splat(simd, 0x846c_a68b);
    bits ^ (bits >> 16)
}

/// Returns a further hash from a hash.
#[inline(always)]
fn mix_again<S: Simd>(simd: S, bits: S::u32s) -> S::u32s {
    let bits = (bits + S::u32s::splat(simd, 0x9e37_79b9)) * S::u32s::splat(simd, 0x21f0_aaad);
    let bits = (bits ^ (bits >> 15)) * S::u32s::splat(simd, 0x735a_2d97);
    bits ^ (bits >> 15)
}

/// Returns the seeds of individuals from their numbers.
#[inline(always)]
pub(super) fn individual<S: Simd>(simd: S, numbers: S::u32s) -> S::u32s {
    // the hash of zero is zero, which is the seed of noise without individuals
    mix(simd, numbers + S::u32s::splat(simd, 1))
}
