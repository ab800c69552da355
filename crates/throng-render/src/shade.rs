//! The colours of what is seen.

use crate::geometry::{Geometry, SKY};
use crate::simd::{Floats, LANES, Vec2s, Vec3s, load};
use crate::{Light, Material, View};
use fearless_simd::Level;
use fearless_simd::prelude::*;
use glam::{Vec2, Vec3};

/// Places in the picture, and what they see: one in each element.
#[derive(Clone, Copy)]
pub(crate) struct Seen {
    /// The triangle, or the ground, or the sky.
    pub ids: [u32; LANES],
    /// The nearness, 1/m.
    pub near: Floats,
    /// The place in the picture, pixels.
    at: [Floats; 2],
}

impl Seen {
    /// The sky in all elements.
    pub const SKY: Self = Self { ids: [SKY; LANES], near: [1.0; LANES], at: [[0.0; LANES]; 2] };

    /// Sets an element.
    #[inline(always)]
    pub fn set(&mut self, element: usize, id: u32, near: f32, at: Vec2) {
        (self.ids[element], self.near[element]) = (id, near);
        (self.at[0][element], self.at[1][element]) = (at.x, at.y);
    }

    /// Returns the places in the picture as vectors of the plane.
    pub fn each_place(&self) -> [Vec2; LANES] {
        std::array::from_fn(|k| Vec2::new(self.at[0][k], self.at[1][k]))
    }

    /// Returns the places in the picture.
    #[inline(always)]
    pub fn places<S: Simd>(&self, simd: S) -> Vec2s<S> {
        Vec2s { x: load(simd, &self.at[0]), y: load(simd, &self.at[1]) }
    }
}

/// Surfaces.
#[derive(Clone, Copy)]
pub(crate) struct Surfaces<S: Simd> {
    /// The normals, of length 1.
    pub normal: Vec3s<S>,
    /// The colours in white light.
    pub color: Vec3s<S>,
}

/// The light that reaches places.
#[derive(Clone, Copy)]
pub(crate) struct Lit<S: Simd> {
    /// The shares of the sun, 0 to 1.
    pub sun: S::f32s,
    /// The shares of the sky, 0 to 1.
    pub open: S::f32s,
}

impl<S: Simd> Lit<S> {
    /// The light where nothing is near.
    #[inline(always)]
    pub fn whole(simd: S) -> Self {
        let one = S::f32s::splat(simd, 1.0);
        Self { sun: one, open: one }
    }
}

/// What colours depend on.
pub(crate) struct Shader<'a> {
    pub view: &'a View,
    pub light: &'a Light,
    pub geometry: &'a Geometry<'a>,
    pub ground: Material,
    /// The direction to the sun.
    pub towards: Vec3,
    /// The viewpoint, for patterns that stay where they are.
    pub eye: Vec3,
    /// The SIMD instructions.
    pub level: Level,
}

impl Shader<'_> {
    /// Returns the surfaces that are seen in the directions `rays`. Elements of the sky are meaningless.
    #[inline(always)]
    pub fn surfaces<S: Simd>(&self, simd: S, seen: &Seen, rays: Vec3s<S>) -> Surfaces<S> {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let hits = self.geometry.hits(simd, &seen.ids, rays, &self.ground);
        let depth = splat(1.0) / load(simd, &seen.near);
        // the width of a pixel on the surface, at most 50 times that of a pixel
        let square = hits.face.length_squared() * rays.length_squared();
        let slope = (square.sqrt() / hits.face.dot(rays).abs()).min(splat(50.0));
        let width = depth * splat(self.view.pixel_width(1.0)) * slope;
        let place = rays * depth + Vec3s::splat(simd, self.eye);
        let shade = hits.patterns.shade(simd, place, hits.face, width);
        Surfaces { normal: hits.normal, color: shade.map_or(hits.color, |shade| hits.color * shade) }
    }

    /// Returns the light that surfaces reflect, with haze.
    #[inline(always)]
    pub fn lit<S: Simd>(
        &self,
        simd: S,
        surfaces: Surfaces<S>,
        Lit { sun, open }: Lit<S>,
        near: S::f32s,
        rays: Vec3s<S>,
    ) -> Vec3s<S> {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let each = |vector: Vec3| Vec3s::splat(simd, vector);
        let Surfaces { normal, color } = surfaces;
        let sky = &self.light.sky;
        let up = splat(0.5) + splat(0.5) * normal.z;
        let around = each(sky.bounce).lerp(simd, each(sky.light), up) * open;
        let facing = normal.dot(each(self.towards)).max(splat(0.0));
        let direct = each(self.light.sun.color) * (facing * sun);
        self.hazed(simd, color.times(direct + around), near, rays)
    }

    /// Returns what clear glass of a material adds: the sky that it mirrors, more at flat angles; and its opacity.
    #[inline(always)]
    pub fn glass<S: Simd>(
        &self,
        simd: S,
        material: &Material,
        (normal, lit): (Vec3s<S>, Vec3s<S>),
        rays: Vec3s<S>,
    ) -> (Vec3s<S>, S::f32s) {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let one = splat(1.0);
        let out = rays.normalize_or(simd, Vec3s::splat(simd, Vec3::X));
        let facing = normal.dot(out.negated()).max(splat(0.0)).min(one);
        let flat = (one - facing) * (one - facing);
        // Schlick's approximation of Fresnel's equations
        let mirrored = splat(material.gloss) * (splat(0.04) + splat(0.96) * flat * flat * (one - facing));
        let opacity = splat(material.opacity);
        let whole = opacity + (one - opacity) * mirrored;
        let reflected = self.light.sky.color(simd, out - normal * (splat(2.0) * out.dot(normal)));
        (lit.lerp(simd, reflected, mirrored / whole.max(splat(1e-6))), whole)
    }

    /// Returns colours behind haze.
    #[inline(always)]
    pub fn hazed<S: Simd>(&self, simd: S, color: Vec3s<S>, near: S::f32s, rays: Vec3s<S>) -> Vec3s<S> {
        let clear = self.light.haze.clear(simd, rays.length_squared().sqrt() / near);
        Vec3s::splat(simd, self.light.sky.horizon).lerp(simd, color, clear)
    }

    /// Returns the colours of the sky.
    #[inline(always)]
    pub fn sky<S: Simd>(&self, simd: S, rays: Vec3s<S>) -> Vec3s<S> {
        self.light.sky.color(simd, rays.normalize_or(simd, Vec3s::splat(simd, Vec3::Z)))
    }
}
