//! Materials of surfaces. Patterns are computed; there are no textures.

use crate::linear;
use crate::simd::{Floats, LANES, Vec2s, Vec3s, load, mask};
use fearless_simd::prelude::*;
use glam::Vec3;

/// The material of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// The colour, linear light, 0 to 1.
    pub color: Vec3,
    /// How much the surface mirrors the sun and the sky, 0 to 1.
    pub gloss: f32,
    /// The opacity, 0 to 1. Surfaces below 1 are glass: they mirror more at grazing angles, have clearer edges, and cast
    /// no shadow.
    pub opacity: f32,
    /// What varies over the surface.
    pub pattern: Pattern,
}

/// What varies over a surface, in the coordinates of the world.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
#[non_exhaustive]
pub enum Pattern {
    /// Nothing.
    #[default]
    Plain,
    /// Fine and coarse grain.
    Grain {
        /// The strength, 0 to 1.
        strength: f32,
    },
    /// Square slabs with joints, slightly different in tone, with grain.
    Slabs {
        /// The edge of a slab, metres.
        size: f32,
        /// The strength of joints and tones, 0 to 1.
        strength: f32,
    },
    /// Boards along the horizontal direction, with grain along them.
    Boards {
        /// The height of a board, metres.
        size: f32,
        /// The strength of joints and grain, 0 to 1.
        strength: f32,
    },
}

impl Material {
    /// Returns a smooth material of a colour, linear light.
    pub fn plain(color: Vec3) -> Self {
        Self { color, gloss: 0.0, opacity: 1.0, pattern: Pattern::Plain }
    }

    /// Whether one can see through it.
    pub(crate) fn is_clear(&self) -> bool {
        self.opacity < 1.0
    }

    /// Returns white plaster.
    pub fn plaster() -> Self {
        Self { pattern: Pattern::Grain { strength: 0.05 }, ..Self::plain(linear(0xf1eee8)) }
    }

    /// Returns bright concrete.
    pub fn concrete() -> Self {
        Self { pattern: Pattern::Grain { strength: 0.16 }, ..Self::plain(linear(0xc9c6c0)) }
    }

    /// Returns boards of oak.
    pub fn wood() -> Self {
        let pattern = Pattern::Boards { size: 0.14, strength: 0.3 };
        Self { gloss: 0.15, pattern, ..Self::plain(linear(0xc39a6b)) }
    }

    /// Returns slabs of bright stone.
    pub fn paving() -> Self {
        Self { pattern: Pattern::Slabs { size: 1.5, strength: 0.16 }, ..Self::plain(linear(0xd6d1c8)) }
    }

    /// Returns clear glass with a green tint.
    pub fn glass() -> Self {
        Self { gloss: 1.0, opacity: 0.16, ..Self::plain(linear(0xb7d3cd)) }
    }
}

/// What varies over the surfaces that some pixels see, one in each element.
pub(crate) struct Patterns {
    kinds: [Pattern; LANES],
}

impl Patterns {
    /// Nothing varies.
    pub const NONE: Self = Self { kinds: [Pattern::Plain; LANES] };

    /// Sets what varies in an element.
    pub fn set(&mut self, element: usize, pattern: Pattern) {
        self.kinds[element] = pattern;
    }

    /// Returns the elements in which a pattern has numbers, with those; `None` if there are none.
    fn of<S: Simd>(&self, simd: S, numbers: impl Fn(Pattern) -> Option<[f32; 2]>) -> Option<Of<S>> {
        let (mut flags, mut all): ([bool; LANES], [Floats; 2]) = ([false; LANES], [[1.0; LANES]; 2]);
        for (k, pattern) in self.kinds.into_iter().enumerate() {
            if let Some([size, strength]) = numbers(pattern) {
                (flags[k], all[0][k], all[1][k]) = (true, size, strength);
            }
        }
        let [size, strength] = all;
        flags.contains(&true).then(|| Of {
            mask: mask(simd, &flags),
            size: load(simd, &size),
            strength: load(simd, &strength),
        })
    }

    /// Returns the share of the colour that places of surfaces reflect; `None` if nothing varies. Normals may have any
    /// length. `footprint` is the width of a pixel on the surface, metres: what is finer is left out.
    #[inline(always)]
    pub fn shade<S: Simd>(&self, simd: S, places: Vec3s<S>, normals: Vec3s<S>, footprint: S::f32s) -> Option<S::f32s> {
        if self.kinds == Self::NONE.kinds {
            return None;
        }
        let splat = |value: f32| S::f32s::splat(simd, value);
        let (one, half) = (splat(1.0), splat(0.5));
        let place = flat(simd, places, normals);
        let mut shade = one;
        let grained = self.of(simd, |pattern| match pattern {
            Pattern::Grain { strength } => Some([1.0, strength]),
            _ => None,
        });
        let slabs = self.of(simd, |pattern| match pattern {
            Pattern::Slabs { size, strength } => Some([size, strength]),
            _ => None,
        });
        let boards = self.of(simd, |pattern| match pattern {
            Pattern::Boards { size, strength } => Some([size, strength]),
            _ => None,
        });
        let grain = if grained.is_some() || slabs.is_some() { grain(simd, place, footprint) } else { splat(0.0) };
        if let Some(Of { mask, strength, .. }) = grained {
            shade = mask.select(one + strength * grain, shade);
        }
        if let Some(Of { mask, size, strength }) = slabs {
            let across = place * (one / size);
            let tone = hash(simd, [across.x.floor(), across.y.floor()].map(whole::<S>), 7) - half;
            let [x, y] = [across.x, across.y].map(|across| joint(simd, across, size, footprint));
            let seen = visible(simd, size, footprint);
            let sum = splat(0.6) * tone * seen - splat(1.6) * x.max(y) + half * grain;
            shade = mask.select(one + strength * sum, shade);
        }
        if let Some(Of { mask, size, strength }) = boards {
            let across = place * (one / size);
            let board = across.y.floor();
            let tone = hash(simd, [whole::<S>(board), S::u32s::splat(simd, 3)], 11) - half;
            let along = across.x * splat(0.12) + board * splat(7.3);
            let fibre = noise(simd, Vec2s { x: along, y: across.y * splat(6.0) });
            let seen = visible(simd, size, footprint);
            let sum = tone * seen + splat(0.7) * fibre * seen - splat(1.4) * joint(simd, across.y, size, footprint);
            shade = mask.select(one + strength * sum, shade);
        }
        Some(shade)
    }
}

/// The elements of one kind of pattern, and its numbers.
struct Of<S: Simd> {
    mask: S::mask32s,
    size: S::f32s,
    strength: S::f32s,
}

/// Returns the coordinates of places along surfaces: horizontal, and up the surface or across it.
#[inline(always)]
fn flat<S: Simd>(simd: S, places: Vec3s<S>, normals: Vec3s<S>) -> Vec2s<S> {
    let level = (normals.z * normals.z).simd_gt(S::f32s::splat(simd, 0.5) * normals.length_squared());
    let along = normals.x.abs().simd_gt(normals.y.abs()).select(places.y, places.x);
    Vec2s::select(level, Vec2s { x: places.x, y: places.y }, Vec2s { x: along, y: places.z })
}

/// Returns how much of a detail of `size` metres is left where a pixel covers `footprint` metres.
#[inline(always)]
fn visible<S: Simd>(simd: S, size: S::f32s, footprint: S::f32s) -> S::f32s {
    let splat = |value: f32| S::f32s::splat(simd, value);
    (splat(1.5) - footprint * (splat(3.0) / size)).max(splat(0.0)).min(splat(1.0))
}

/// Returns the share of the pixel at `across`, in units of `size` metres, that a joint of 12 mm covers.
#[inline(always)]
fn joint<S: Simd>(simd: S, across: S::f32s, size: S::f32s, footprint: S::f32s) -> S::f32s {
    const WIDTH: f32 = 0.012;
    let splat = |value: f32| S::f32s::splat(simd, value);
    let [zero, half, one] = [0.0, 0.5, 1.0].map(splat);
    let distance = (across - (across + half).floor()).abs() * size;
    let pixels = one / footprint.max(splat(1e-6));
    let share = |edge: f32| ((splat(edge) - distance) * pixels + half).max(zero).min(one);
    (share(WIDTH * 0.5) - share(-WIDTH * 0.5)) * visible(simd, size, footprint)
}

/// Returns grain of three sizes, about -1 to 1.
#[inline(always)]
fn grain<S: Simd>(simd: S, place: Vec2s<S>, footprint: S::f32s) -> S::f32s {
    let splat = |value: f32| S::f32s::splat(simd, value);
    let mut sum = splat(0.0);
    for (size, strength) in [(3.1, 0.5), (0.43, 0.4), (0.037, 0.5)] {
        let seen = visible(simd, splat(size), footprint);
        if seen.simd_gt(splat(0.0)).any_true() {
            sum += splat(strength) * (seen * noise(simd, place * splat(1.0 / size)));
        }
    }
    sum
}

/// Odd factors that hash whole numbers.
const FACTORS: [u32; 3] = [0x8da6_b343, 0xd816_3841, 0xcb1a_b31f];

/// Returns smooth noise, -1 to 1: values at the points of a lattice, blended.
#[inline(always)]
fn noise<S: Simd>(simd: S, place: Vec2s<S>) -> S::f32s {
    let splat = |value: f32| S::f32s::splat(simd, value);
    let (x, y) = (place.x.floor(), place.y.floor());
    let smooth = |part: S::f32s| part * part * (splat(3.0) - splat(2.0) * part);
    let (along, across) = (smooth(place.x - x), smooth(place.y - y));
    let [x, y] = [x, y].map(whole::<S>);
    let one = S::u32s::splat(simd, 1);
    let upper = mixed::<S>(hash(simd, [x, y], 0), hash(simd, [x + one, y], 0), along);
    let lower = mixed::<S>(hash(simd, [x, y + one], 0), hash(simd, [x + one, y + one], 0), along);
    splat(2.0) * mixed::<S>(upper, lower, across) - splat(1.0)
}

#[inline(always)]
fn mixed<S: Simd>(a: S::f32s, b: S::f32s, part: S::f32s) -> S::f32s {
    a + (b - a) * part
}

/// Returns whole numbers as such.
#[inline(always)]
fn whole<S: Simd>(value: S::f32s) -> S::u32s {
    value.to_int::<S::i32s>().bitcast()
}

/// Returns a number from 0 to 1 that whole numbers determine.
#[inline(always)]
fn hash<S: Simd>(simd: S, [x, y]: [S::u32s; 2], z: u32) -> S::f32s {
    let splat = |value: u32| S::u32s::splat(simd, value);
    let mut bits = (x * splat(FACTORS[0])) ^ (y * splat(FACTORS[1])) ^ splat(z.wrapping_mul(FACTORS[2]));
    bits = (bits ^ (bits >> 15)) * splat(0x2c1b_3c6d);
    bits = (bits ^ (bits >> 13)) * splat(0x297a_2d39);
    let short: S::i32s = ((bits ^ (bits >> 16)) >> 8).bitcast();
    short.to_float::<S::f32s>() * S::f32s::splat(simd, 1.0 / (1 << 24) as f32)
}
