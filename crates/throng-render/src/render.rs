//! From a scene to a picture, step by step.

use crate::coarse::Coarse;
use crate::geometry::Geometry;
use crate::layers::above;
use crate::occlusion;
use crate::raster::Grid;
use crate::samples::{Lights, Samples};
use crate::shade::Shader;
use crate::shadow::Shadows;
use crate::tone::Tone;
use crate::{Material, Scene, View, parallel};
use fearless_simd::Level;
use glam::{DVec3, Vec2, Vec3};

/// The greatest width and height of a picture, pixels.
const LARGEST: u32 = 16_384;

/// A rendered picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    size: [u32; 2],
    view: View,
    bytes: Vec<u8>,
    /// The nearness at the middle of each pixel, 1/m.
    near: Vec<f32>,
}

/// The size of a picture is not possible.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a picture of {width} by {height} pixels: give 1 to 16384 for both")]
pub struct SizeError {
    /// The width, pixels.
    pub width: u32,
    /// The height, pixels.
    pub height: u32,
}

impl Picture {
    /// Renders a scene. Bodies and areas with coordinates that are not finite are left out where they are not.
    ///
    /// The bytes are the same for any number of threads, and for all SIMD instructions.
    ///
    /// # Errors
    /// The size is 0 or above 16,384 pixels.
    ///
    /// ```
    /// use glam::{DVec3, Vec3};
    /// use throng_render::{Body, Material, Mesh, Picture, Scene, View};
    /// let ball = Mesh::capsule(Vec3::Z, Vec3::Z, [1.0; 2], 24);
    /// let red = Material::plain(throng_render::linear(0xc04030));
    /// let scene = Scene {
    ///     ground: Some(Material::paving()),
    ///     bodies: vec![Body::standing(&ball, DVec3::ZERO, 0.0, red)],
    ///     ..Scene::default()
    /// };
    /// let view = View::look(DVec3::new(0.0, -8.0, 3.0), DVec3::Z, 0.6, [64, 48]);
    /// let picture = Picture::render(&scene, &view, [64, 48])?;
    /// let middle = &picture.bytes()[4 * (24 * 64 + 32)..][..4];
    /// assert!(middle[0] > 2 * middle[2], "the ball is red: {middle:?}");
    /// # Ok::<(), throng_render::SizeError>(())
    /// ```
    pub fn render(scene: &Scene<'_>, view: &View, size: [u32; 2]) -> Result<Self, SizeError> {
        let [width, height] = size;
        if !(1..=LARGEST).contains(&width) || !(1..=LARGEST).contains(&height) {
            return Err(SizeError { width, height });
        }
        Ok(Self::with(Level::new(), scene, view, size))
    }

    /// Renders a scene with these SIMD instructions.
    fn with(level: Level, scene: &Scene<'_>, view: &View, size: [u32; 2]) -> Self {
        let width = size[0];
        let grid = Grid::picture(size);
        let geometry = Geometry::new(scene, view);
        let samples = Samples::new(scene, &geometry, view, &grid, size);
        let shader = Shader {
            view,
            light: &scene.light,
            geometry: &geometry,
            ground: scene.ground.unwrap_or(Material::plain(Vec3::ZERO)),
            towards: scene.light.sun.direction(),
            eye: view.eye.as_vec3(),
            level,
        };
        let (fronts, mut colors) = samples.fronts(&shader, width as usize);
        let coarse = Coarse::new(&fronts);
        let open = occlusion::open(&fronts, &coarse, view);
        let shadows = Shadows::new(&geometry, &scene.light.sun, level);
        let sun = shadows.map_or_else(|| vec![1.0; open.len()], |shadows| shadows.lights(&fronts, &coarse, view));
        samples.light(&shader, &fronts, &Lights { sun, open }, &mut colors);
        above(&mut colors, scene, &shader, &samples, (&grid, size));
        let tone = Tone::new(scene.light.exposure);
        let mut near = vec![0.0; grid.cells()];
        let mut pixels = vec![[0; 4]; grid.cells()];
        parallel::pairs(&mut pixels, &mut near, width as usize, |row, pixels, near| {
            let row = row * width as usize..(row + 1) * width as usize;
            let seen = fronts.all[row.clone()].iter().zip(&colors[row]);
            for ((pixel, near), (front, color)) in pixels.iter_mut().zip(near).zip(seen) {
                (*pixel, *near) = (tone.pixel(*color), front.near);
            }
        });
        Self { size, view: *view, bytes: pixels.into_flattened(), near }
    }

    /// Returns the pixels in rows from the upper left corner: red, green, blue, and an opacity of 255.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Returns the pixels.
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    /// Returns the width and the height, pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Whether bodies or the ground hide a point that is in the picture. Points outside of the picture are not hidden.
    pub fn hides(&self, point: DVec3) -> bool {
        let turned = self.view.turned(self.view.relative(point));
        if turned.z.is_nan() || turned.z <= 0.0 {
            return false;
        }
        let pixel = self.view.centre + Vec2::new(turned.x, -turned.y) * (self.view.focal / turned.z);
        let [width, height] = self.size;
        let inside = pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < width as f32 && pixel.y < height as f32;
        inside && self.near[pixel.y as usize * width as usize + pixel.x as usize] * turned.z > 1.0
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;
    use crate::{Area, Body, Line, LineEnd, Mesh};
    use fearless_simd::prelude::*;
    use glam::{DVec2, Mat3};

    #[test]
    fn pictures_are_the_same_for_all_instructions() {
        let ball = Mesh::capsule(Vec3::Z, 1.6 * Vec3::Z, [0.4, 0.7], 40);
        let square = |half: f32| [[-half, -half], [half, -half], [half, half], [-half, half]].map(Vec2::from);
        let wall = Mesh::prism(&[square(0.9).to_vec()], 0.0, 1.4);
        let materials =
            [Material::plaster(), Material::concrete(), Material::wood(), Material::paving(), Material::glass()];
        let body = |k: usize| {
            let turn = Mat3::from_rotation_z(0.4 * k as f32);
            let place = DVec3::new(2.5 * k as f64 - 5.0, 0.7 * k as f64, 0.0);
            Body {
                mesh: if k.is_multiple_of(2) { &ball } else { &wall },
                place,
                turn,
                material: materials[k % 5],
                thin: k == 7,
            }
        };
        let end = |k: u32| LineEnd { at: DVec3::new(f64::from(k) - 5.0, -1.0, 0.1), width: 5.0, opacity: 0.7 };
        let lawn = square(2.0).map(|corner| corner.as_dvec2() - DVec2::Y).to_vec();
        let scene = Scene {
            ground: Some(Material::paving()),
            areas: vec![Area::new(&[lawn], Material::plain(Vec3::new(0.2, 0.5, 0.1)))],
            bodies: (0..10).map(body).collect(),
            lines: vec![Line { ends: (0..9).map(end).collect(), color: Vec3::X, flat: false }],
            ..Scene::default()
        };
        let size = [333, 171];
        let view = View::look(DVec3::new(-1.0, -11.0, 3.0), DVec3::new(0.0, 0.0, 0.8), 0.7, size);
        let best = Level::new();
        let picture = Picture::with(best, &scene, &view, size);
        let levels =
            [best.as_sse2().map(|s| s.level()), best.as_sse4_2().map(|s| s.level()), best.as_avx2().map(|s| s.level())];
        for level in levels.into_iter().flatten() {
            assert!(Picture::with(level, &scene, &view, size) == picture, "{level:?}");
        }
    }
}
