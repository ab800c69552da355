//! The projection from points in space to pixels.

use crate::simd::{Vec2s, Vec3s};
use fearless_simd::prelude::*;
use glam::{DVec3, IVec2, Vec2, Vec3};

/// Subdivisions of a pixel: corners of triangles lie on a grid of this fineness.
pub(crate) const SUB: i32 = 16;

/// A perspective view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The viewpoint, metres.
    pub eye: DVec3,
    /// The direction to the right of the picture, of length 1.
    pub right: Vec3,
    /// The direction to the top of the picture, of length 1.
    pub up: Vec3,
    /// The direction of the view, of length 1.
    pub forward: Vec3,
    /// The pixel of the direction of the view, counted from the upper left corner.
    pub centre: Vec2,
    /// The focal length, pixels: an object as wide as it is distant has this width in the picture.
    pub focal: f32,
    /// The distance of the near plane, metres: what is nearer is cut off.
    pub near: f32,
}

impl View {
    /// Creates a view from `eye` to `target` with a vertical `angle`, radians, for a picture of `size` pixels. The axis
    /// z is up in the picture; for a view straight down, the top of the picture is along y.
    pub fn look(eye: DVec3, target: DVec3, angle: f64, [width, height]: [u32; 2]) -> Self {
        let ahead = target - eye;
        let forward = ahead.normalize_or(DVec3::Y);
        let right = forward.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
        Self {
            eye,
            right: right.as_vec3(),
            up: right.cross(forward).as_vec3(),
            forward: forward.as_vec3(),
            centre: Vec2::new(width as f32, height as f32) * 0.5,
            focal: (0.5 * f64::from(height) / libm::tan(0.5 * angle.clamp(0.01, 3.0))) as f32,
            near: (0.02 * ahead.length()).clamp(1e-3, 0.2) as f32,
        }
    }

    /// Returns the place of a point relative to the viewpoint, metres.
    pub(crate) fn relative(&self, point: DVec3) -> Vec3 {
        (point - self.eye).as_vec3()
    }

    /// Returns a place relative to the viewpoint in the axes of the picture: right, up, forward.
    pub(crate) fn turned(&self, place: Vec3) -> Vec3 {
        Vec3::new(place.dot(self.right), place.dot(self.up), place.dot(self.forward))
    }

    /// Returns the pixel of a place in the axes of the picture with a positive depth, on the grid of corners.
    pub(crate) fn corner(&self, turned: Vec3) -> IVec2 {
        let scale = self.focal / turned.z;
        let pixel = self.centre + Vec2::new(turned.x, -turned.y) * scale;
        rounded(pixel * SUB as f32)
    }

    /// Returns the direction of a pixel, with a length of 1 along the direction of the view.
    pub(crate) fn ray(&self, pixel: Vec2) -> Vec3 {
        let at = (pixel - self.centre) * (1.0 / self.focal);
        self.forward + self.right * at.x - self.up * at.y
    }

    /// As [`View::ray`], for many pixels.
    #[inline(always)]
    pub(crate) fn rays<S: Simd>(&self, simd: S, pixels: Vec2s<S>) -> Vec3s<S> {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let [forward, right, up] = [self.forward, self.right, self.up].map(|axis| Vec3s::splat(simd, axis));
        let scale = splat(1.0 / self.focal);
        let (x, y) = ((pixels.x - splat(self.centre.x)) * scale, (pixels.y - splat(self.centre.y)) * scale);
        forward + right * x - up * y
    }

    /// Returns the width of a pixel at a depth, metres.
    pub(crate) fn pixel_width(&self, depth: f32) -> f32 {
        depth * (1.0 / self.focal)
    }
}

/// Returns the nearest whole numbers, of two the one farther from zero: as `Vec2::round`, without a function call.
pub(crate) fn rounded(place: Vec2) -> IVec2 {
    // The greatest number below a half: numbers just below a half do not become one.
    const HALF: f32 = 0.499_999_97;
    (place + Vec2::splat(HALF).copysign(place)).as_ivec2()
}
