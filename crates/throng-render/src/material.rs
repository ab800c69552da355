//! Materials of surfaces. Patterns are computed; there are no textures.

use crate::linear;
use glam::{Vec2, Vec3};

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

    /// Returns the share of the colour that a place of a surface reflects. The normal may have any length. `footprint` is
    /// the width of a pixel on the surface, metres: what is finer is left out.
    pub(crate) fn shade(&self, place: Vec3, normal: Vec3, footprint: f32) -> f32 {
        match self.pattern {
            Pattern::Plain => 1.0,
            Pattern::Grain { strength } => 1.0 + strength * grain(flat(place, normal), footprint),
            Pattern::Slabs { size, strength } => {
                let place = flat(place, normal);
                let across = place * (1.0 / size);
                let tone = hash(whole(across.x), whole(across.y), 7) - 0.5;
                let joints = joint(across.x, size, footprint).max(joint(across.y, size, footprint));
                let seen = visible(size, footprint);
                1.0 + strength * (0.6 * tone * seen - 1.6 * joints + 0.5 * grain(place, footprint))
            }
            Pattern::Boards { size, strength } => {
                let across = flat(place, normal) * (1.0 / size);
                let board = whole(across.y);
                let tone = hash(board, 3, 11) - 0.5;
                let fibre = noise(Vec2::new(across.x * 0.12 + board as f32 * 7.3, across.y * 6.0));
                let seen = visible(size, footprint);
                1.0 + strength * (tone * seen + 0.7 * fibre * seen - 1.4 * joint(across.y, size, footprint))
            }
        }
    }
}

/// Returns the coordinates of a place along a surface: horizontal, and up the surface or across it.
fn flat(place: Vec3, normal: Vec3) -> Vec2 {
    if normal.z * normal.z > 0.5 * normal.length_squared() {
        return place.truncate();
    }
    let along = if normal.x.abs() > normal.y.abs() { place.y } else { place.x };
    Vec2::new(along, place.z)
}

/// Returns how much of a detail of `size` metres is left where a pixel covers `footprint` metres.
fn visible(size: f32, footprint: f32) -> f32 {
    (1.5 - footprint * (3.0 / size)).clamp(0.0, 1.0)
}

/// Returns the share of the pixel at `across`, in units of `size` metres, that a joint of 12 mm covers.
fn joint(across: f32, size: f32, footprint: f32) -> f32 {
    const WIDTH: f32 = 0.012;
    let distance = (across - whole(across + 0.5) as f32).abs() * size;
    let pixels = 1.0 / footprint.max(1e-6);
    let covered = ((WIDTH * 0.5 - distance) * pixels + 0.5).clamp(0.0, 1.0)
        - ((-WIDTH * 0.5 - distance) * pixels + 0.5).clamp(0.0, 1.0);
    covered * visible(size, footprint)
}

/// Returns grain of three sizes, about -1 to 1.
fn grain(place: Vec2, footprint: f32) -> f32 {
    let layer = |size: f32| {
        let seen = visible(size, footprint);
        if seen > 0.0 { seen * noise(place * (1.0 / size)) } else { 0.0 }
    };
    0.5 * layer(3.1) + 0.4 * layer(0.43) + 0.5 * layer(0.037)
}

/// Returns smooth noise, -1 to 1: values at the points of a lattice, blended.
fn noise(place: Vec2) -> f32 {
    let [x, y] = place.to_array().map(whole);
    let part = place - Vec2::new(x as f32, y as f32);
    let t = part * part * (Vec2::splat(3.0) - 2.0 * part);
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    let line = |y: i32| mix(hash(x, y, 0), hash(x.wrapping_add(1), y, 0), t.x);
    2.0 * mix(line(y), line(y.wrapping_add(1)), t.y) - 1.0
}

/// Returns the greatest whole number that is not above a value.
fn whole(value: f32) -> i32 {
    let whole = value as i32;
    whole.wrapping_sub(i32::from(whole as f32 > value))
}

/// Returns a number from 0 to 1 that whole numbers determine.
fn hash(x: i32, y: i32, z: i32) -> f32 {
    let mut bits = (x as u32).wrapping_mul(0x8da6_b343)
        ^ (y as u32).wrapping_mul(0xd816_3841)
        ^ (z as u32).wrapping_mul(0xcb1a_b31f);
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x2c1b_3c6d);
    bits = (bits ^ (bits >> 13)).wrapping_mul(0x297a_2d39);
    ((bits ^ (bits >> 16)) >> 8) as f32 / (1 << 24) as f32
}
