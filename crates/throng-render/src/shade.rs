//! The colours of what is seen.

use crate::geometry::{GROUND, Geometry, Hit};
use crate::{Light, Material, Pattern, View};
use glam::Vec3;

/// The light that reaches a place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lit {
    /// The share of the sun, 0 to 1.
    pub sun: f32,
    /// The share of the sky, 0 to 1.
    pub open: f32,
}

impl Lit {
    /// The light where nothing is near.
    pub const WHOLE: Self = Self { sun: 1.0, open: 1.0 };
}

/// What colours depend on.
pub(crate) struct Shader<'a> {
    pub view: &'a View,
    pub light: &'a Light,
    pub geometry: &'a Geometry<'a>,
    pub ground: Option<Material>,
    /// The direction to the sun.
    pub towards: Vec3,
    /// The viewpoint, for patterns that stay where they are.
    pub eye: Vec3,
}

impl Shader<'_> {
    /// Returns what is seen of a triangle or of the ground, and its colour with its pattern.
    pub fn surface(&self, id: u32, near: f32, ray: Vec3) -> (Hit, Vec3) {
        let hit = if id == GROUND {
            let material = self.ground.unwrap_or(Material::plain(Vec3::ZERO));
            Hit { normal: Vec3::Z, face: Vec3::Z, color: Vec3::ONE, material }
        } else {
            self.geometry.hit(id, ray)
        };
        let plain = hit.color * hit.material.color;
        if hit.material.pattern == Pattern::Plain {
            return (hit, plain);
        }
        let depth = 1.0 / near;
        // the width of a pixel on the surface, at most 50 times that of a pixel
        let square = hit.face.length_squared() * ray.length_squared();
        let slope = (square.sqrt() / hit.face.dot(ray).abs()).min(50.0);
        let width = self.view.pixel_width(depth) * slope;
        let color = plain * hit.material.shade(ray * depth + self.eye, hit.face, width);
        (hit, color)
    }

    /// Returns the light that a surface reflects, with haze.
    pub fn lit(&self, normal: Vec3, color: Vec3, Lit { sun, open }: Lit, near: f32, ray: Vec3) -> Vec3 {
        let sky = &self.light.sky;
        let up = 0.5 + 0.5 * normal.z;
        let around = sky.bounce.lerp(sky.light, up) * open;
        let direct = self.light.sun.color * (normal.dot(self.towards).max(0.0) * sun);
        self.hazed(color * (direct + around), near, ray)
    }

    /// Returns what clear glass adds: the sky that it mirrors, more at flat angles; and its opacity.
    pub fn glass(&self, hit: &Hit, lit: Vec3, ray: Vec3) -> (Vec3, f32) {
        let out = ray.normalize_or(Vec3::X);
        let facing = hit.normal.dot(-out).clamp(0.0, 1.0);
        let flat = (1.0 - facing) * (1.0 - facing);
        // Schlick's approximation of Fresnel's equations
        let mirrored = hit.material.gloss * (0.04 + 0.96 * flat * flat * (1.0 - facing));
        let opacity = hit.material.opacity;
        let whole = opacity + (1.0 - opacity) * mirrored;
        let reflected = self.light.sky.color(out - hit.normal * (2.0 * out.dot(hit.normal)));
        (lit.lerp(reflected, mirrored / whole.max(1e-6)), whole)
    }

    /// Returns a colour behind haze.
    pub fn hazed(&self, color: Vec3, near: f32, ray: Vec3) -> Vec3 {
        let clear = self.light.haze.clear(ray.length() / near);
        self.light.sky.horizon.lerp(color, clear)
    }

    /// Returns the colour of the sky.
    pub fn sky(&self, ray: Vec3) -> Vec3 {
        self.light.sky.color(ray.normalize_or(Vec3::Z))
    }
}
