//! Simplex noise and its gradient, many places at once, a lane a place.
//!
//! Perlin, *Noise Hardware*, SIGGRAPH 2001 course notes; Gustavson, *Simplex noise demystified*, 2005. At every corner of a lattice of
//! simplices sits a random gradient `g`; a corner adds `t^4 (g . d)` with `t = 1/2 - |d|^2`, `d` the offset from it, as far as `t` is
//! above zero. With this 1/2 a corner reaches exactly as far as the simplices round it do, so that the noise and three derivatives of
//! it are continuous in any number of dimensions. Gradients are bytes of hashes of the corner: no tables, so lanes need not gather.
//!
//! Where a place lies in the lattice is found in `f64`: far from the origin the noise is as smooth as near it. The lattice repeats
//! after 2^32 cells.

use fearless_simd::prelude::*;

/// Which corner of the lattice: a factor of its own for every axis. Odd.
const FACTORS: [u32; 4] = [0x9e37_79b1, 0x85eb_ca77, 0xc2b2_ae3d, 0x27d4_eb2f];

/// What bytes of hashes are about.
const MIDDLE: f32 = 127.5;

/// The variance of a component of a gradient: that of a byte.
pub(super) const VARIANCE: f64 = 65_535.0 / 12.0;

/// Numbers in `f64`, of the lower and the upper half of the lanes.
pub(super) type Wide<S> = (<S as Simd>::f64s, <S as Simd>::f64s);

/// Noises, each of gradients of its own, and how they change along each axis.
#[derive(Clone, Copy)]
pub(super) struct Jets<S: Simd, const D: usize, const K: usize> {
    pub value: [S::f32s; K],
    pub slope: [[S::f32s; D]; K],
}

/// How much longer the diagonal of a skewed cell is, and a cell that is not.
const fn skews(dimensions: usize) -> (f64, f64) {
    // of 3 and 4 dimensions: the roots of 4 and 5
    let root = if dimensions == 3 { 2.0 } else { 2.236_067_977_499_79 };
    ((root - 1.0) / dimensions as f64, (1.0 - 1.0 / root) / dimensions as f64)
}

/// `K` noises of 3 or 4 dimensions at places given in lengths of the lattice. Gradients are whole numbers from -127.5 to 127.5.
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
    // the order in which a walk from the lowest corner of the simplex to the highest takes the axes: the farthest first
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

/// In which cell places lie, and their offsets from its lowest corner.
#[inline(always)]
fn locate<S: Simd, const D: usize>(simd: S, at: [Wide<S>; D]) -> ([S::u32s; D], [S::f32s; D]) {
    let splat = |value: f64| S::f64s::splat(simd, value);
    let (skew, unskew) = skews(D);
    // whole numbers added to it are the last bits of the sum
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

/// Bits that depend on all bits.
#[inline(always)]
fn mix<S: Simd>(simd: S, mut bits: S::u32s) -> S::u32s {
    bits = (bits ^ (bits >> 16)) * S::u32s::splat(simd, 0x7feb_352d);
    bits = (bits ^ (bits >> 15)) * S::u32s::splat(simd, 0x846c_a68b);
    bits ^ (bits >> 16)
}

/// Further bits, from bits that are mixed.
#[inline(always)]
fn mix_again<S: Simd>(simd: S, bits: S::u32s) -> S::u32s {
    let bits = (bits + S::u32s::splat(simd, 0x9e37_79b9)) * S::u32s::splat(simd, 0x21f0_aaad);
    let bits = (bits ^ (bits >> 15)) * S::u32s::splat(simd, 0x735a_2d97);
    bits ^ (bits >> 15)
}

/// Seeds of individuals, by their numbers.
#[inline(always)]
pub(super) fn individual<S: Simd>(simd: S, numbers: S::u32s) -> S::u32s {
    // of zero the hash is zero, and that is everybody's seed
    mix(simd, numbers + S::u32s::splat(simd, 1))
}
