//! From a scene to a picture, step by step.

use crate::coarse::Coarse;
use crate::front::{Front, Fronts};
use crate::geometry::{GROUND, Geometry, SKY, ground};
use crate::lines::Strokes;
use crate::occlusion;
use crate::raster::{BAND, Bands, Cover, Grid, SAMPLES, cover, rows_of};
use crate::shade::{Lit, Seen, Shader, Surfaces};
use crate::shadow::Shadows;
use crate::simd::{Floats, LANES, Vec3s, each, load, mask};
use crate::tone::Tone;
use crate::{Material, Scene, View, parallel};
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::{DVec3, Vec2, Vec3, Vec4};

/// The greatest width and height of a picture, pixels.
const LARGEST: u32 = 16_384;
/// The nearness, 1/m, below which the ground is part of the haze.
const HORIZON: f32 = 1e-5;

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

/// What is nearest at each sample.
struct Samples {
    near: Vec<Vec4>,
    ids: Vec<[u32; SAMPLES]>,
}

/// The light at the middle of each pixel: the shares of the sun and of the sky, 0 to 1.
struct Lights {
    sun: Vec<f32>,
    open: Vec<f32>,
}

impl Lights {
    /// Returns the light at cells, one in each element.
    #[inline(always)]
    fn at<S: Simd>(&self, simd: S, cells: &[usize; LANES]) -> Lit<S> {
        let of = |values: &[f32]| load(simd, &cells.map(|cell| values[cell]));
        Lit { sun: of(&self.sun), open: of(&self.open) }
    }
}

impl Samples {
    fn new(scene: &Scene<'_>, geometry: &Geometry<'_>, view: &View, grid: &Grid, size: [u32; 2]) -> Self {
        let mut near = vec![Vec4::ZERO; grid.cells()];
        let mut ids = vec![[SKY; SAMPLES]; grid.cells()];
        if scene.ground.is_some() && view.eye.z > 0.0 {
            let lanes = grid.lanes(ground(view));
            parallel::pairs(&mut near, &mut ids, grid.size[0], |row, near, ids| {
                for (column, (near, ids)) in near.iter_mut().zip(ids).enumerate() {
                    let found = lanes.at(column, row);
                    for sample in 0..SAMPLES {
                        if found[sample] > HORIZON {
                            (near[sample], ids[sample]) = (found[sample], GROUND);
                        }
                    }
                }
            });
        }
        let covers = geometry.covers(view, size, false);
        cover(grid, &Bands::new(grid, covers.iter().flatten()), &mut near, &mut ids);
        Self { near, ids }
    }

    /// Returns the nearness of what some samples of a pixel see: the mean.
    fn nearness(&self, cell: usize, id: u32) -> (f32, f32) {
        let near = self.near[cell];
        if self.ids[cell] == [id; SAMPLES] {
            return (near.element_sum() / SAMPLES as f32, SAMPLES as f32);
        }
        let own = (0..SAMPLES).filter(|&sample| self.ids[cell][sample] == id);
        let (sum, count) = own.fold((0.0, 0.0), |(sum, count), sample| (sum + near[sample], count + 1.0));
        (sum / count, count)
    }

    /// Returns what most samples of each pixel see: its front, and its colour in white light.
    fn fronts(&self, shader: &Shader<'_>, width: usize) -> (Fronts, Vec<Vec3>) {
        let mut all = vec![Front::SKY; self.ids.len()];
        let mut colors = vec![Vec3::ZERO; self.ids.len()];
        parallel::pairs(&mut all, &mut colors, width, |row, fronts, colors| {
            dispatch!(shader.level, simd => self.fronts_of_row(simd, shader, row, fronts, colors));
        });
        (Fronts { all, width }, colors)
    }

    #[inline(always)]
    fn fronts_of_row<S: Simd>(
        &self,
        simd: S,
        shader: &Shader<'_>,
        row: usize,
        fronts: &mut [Front],
        colors: &mut [Vec3],
    ) {
        let width = fronts.len();
        for first in (0..width).step_by(S::f32s::LEN) {
            let columns = first..(first + S::f32s::LEN).min(width);
            let mut seen = Seen::SKY;
            for (k, column) in columns.clone().enumerate() {
                let cell = row * width + column;
                let id = most(self.ids[cell]);
                if id != SKY {
                    seen.set(k, id, self.nearness(cell, id).0, middle(column, row));
                }
            }
            if seen.ids == Seen::SKY.ids {
                continue;
            }
            let surfaces = shader.surfaces(simd, &seen, shader.view.rays(simd, seen.places(simd)));
            let (normals, own) = (surfaces.normal.each(), surfaces.color.each());
            for (k, column) in columns.enumerate().filter(|(k, _)| seen.ids[*k] != SKY) {
                (fronts[column], colors[column]) = (Front { near: seen.near[k], normal: normals[k] }, own[k]);
            }
        }
    }

    /// Lights the colours of all pixels, and mixes those of the samples of a pixel.
    fn light(&self, shader: &Shader<'_>, fronts: &Fronts, lights: &Lights, colors: &mut [Vec3]) {
        parallel::chunks(colors, fronts.width, |row, colors| {
            dispatch!(shader.level, simd => {
                self.light_row(simd, shader, (fronts, lights), row, colors);
                self.mix_row(simd, shader, (fronts, lights), row, colors);
            });
        });
    }

    /// Lights what most samples of each pixel see.
    #[inline(always)]
    fn light_row<S: Simd>(
        &self,
        simd: S,
        shader: &Shader<'_>,
        (fronts, lights): (&Fronts, &Lights),
        row: usize,
        colors: &mut [Vec3],
    ) {
        let width = fronts.width;
        for first in (0..width).step_by(S::f32s::LEN) {
            let columns = first..(first + S::f32s::LEN).min(width);
            let (mut seen, mut cells) = (Seen::SKY, [row * width; LANES]);
            let (mut normals, mut own) = ([[0.0; LANES]; 3], [[0.0; LANES]; 3]);
            for (k, column) in columns.clone().enumerate() {
                let front = &fronts.all[row * width + column];
                let id = if front.near > 0.0 { GROUND } else { SKY };
                seen.set(k, id, front.near, middle(column, row));
                cells[k] = row * width + column;
                for (to, value) in normals.iter_mut().zip(front.normal.to_array()) {
                    to[k] = value;
                }
                for (to, value) in own.iter_mut().zip(colors[column].to_array()) {
                    to[k] = value;
                }
            }
            let surfaces = Surfaces { normal: Vec3s::load(simd, &normals), color: Vec3s::load(simd, &own) };
            let lit = lit(simd, shader, &seen, surfaces, lights.at(simd, &cells)).each();
            colors[columns.clone()].copy_from_slice(&lit[..columns.len()]);
        }
    }

    /// Mixes the colours of what the samples of each pixel see.
    #[inline(always)]
    fn mix_row<S: Simd>(
        &self,
        simd: S,
        shader: &Shader<'_>,
        (fronts, lights): (&Fronts, &Lights),
        row: usize,
        colors: &mut [Vec3],
    ) {
        let width = fronts.width;
        // What some samples of a pixel see: its column, its share of the pixel, and whether it is what most of them see.
        let mut parts: Vec<(usize, f32, bool)> = Vec::new();
        let mut others: Vec<(u32, f32, usize)> = Vec::new();
        for column in 0..width {
            let ids = self.ids[row * width + column];
            let id = most(ids);
            if ids == [id; SAMPLES] {
                continue;
            }
            for sample in 0..SAMPLES {
                let other = ids[sample];
                if ids[..sample].contains(&other) {
                    continue;
                }
                let (near, count) = self.nearness(row * width + column, other);
                parts.push((column, count / SAMPLES as f32, other == id));
                if other != id {
                    others.push((other, near, column));
                }
            }
        }
        let mut lit_others = Vec::with_capacity(others.len());
        for others in others.chunks(S::f32s::LEN) {
            let (mut seen, mut cells) = (Seen::SKY, [row * width; LANES]);
            for (k, &(id, near, column)) in others.iter().enumerate() {
                seen.set(k, id, near, middle(column, row));
                if id != SKY {
                    cells[k] = neighbour(fronts, [column, row], near);
                }
            }
            let surfaces = shader.surfaces(simd, &seen, shader.view.rays(simd, seen.places(simd)));
            let lit = lit(simd, shader, &seen, surfaces, lights.at(simd, &cells));
            lit_others.extend_from_slice(&lit.each()[..others.len()]);
        }
        let mut lit_others = lit_others.into_iter();
        for pixel in parts.chunk_by(|a, b| a.0 == b.0) {
            let main = colors[pixel[0].0];
            let part = |&(_, share, is_main): &(usize, f32, bool)| {
                let color = if is_main { main } else { lit_others.next().unwrap_or(main) };
                color * share
            };
            colors[pixel[0].0] = pixel.iter().map(part).fold(Vec3::ZERO, |sum, part| sum + part);
        }
    }
}

/// Returns the light of surfaces or of the sky.
#[inline(always)]
fn lit<S: Simd>(simd: S, shader: &Shader<'_>, seen: &Seen, surfaces: Surfaces<S>, light: Lit<S>) -> Vec3s<S> {
    let rays = shader.view.rays(simd, seen.places(simd));
    let sky = seen.ids.map(|id| id == SKY);
    if sky[..S::f32s::LEN].iter().all(|sky| *sky) {
        return shader.sky(simd, rays);
    }
    let lit = shader.lit(simd, surfaces, light, load(simd, &seen.near), rays);
    if sky[..S::f32s::LEN].contains(&true) {
        return Vec3s::select(mask(simd, &sky), shader.sky(simd, rays), lit);
    }
    lit
}

/// Returns what most samples of a pixel see; of two that are seen by as many samples, the first.
fn most(ids: [u32; SAMPLES]) -> u32 {
    let first = ids[0];
    if ids == [first; SAMPLES] {
        return first;
    }
    let of = |id: u32| ids.iter().filter(|&&other| other == id).count();
    ids.into_iter().fold(first, |most, id| if of(id) > of(most) { id } else { most })
}

fn middle(column: usize, row: usize) -> Vec2 {
    Vec2::new(column as f32 + 0.5, row as f32 + 0.5)
}

/// Returns the pixel about a pixel that is most nearly as near.
fn neighbour(fronts: &Fronts, [column, row]: [usize; 2], near: f32) -> usize {
    let (width, height) = (fronts.width, fronts.all.len() / fronts.width);
    let columns = column.saturating_sub(1)..(column + 2).min(width);
    let rows = row.saturating_sub(1)..(row + 2).min(height);
    let all = rows.flat_map(|row| columns.clone().map(move |column| row * width + column));
    let apart = |cell: &usize| (fronts.all[*cell].near - near).abs();
    all.min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap_or(row * width + column)
}

/// Adds what lies above: lines, and then bodies that one can see through.
fn above(
    colors: &mut [Vec3],
    scene: &Scene<'_>,
    shader: &Shader<'_>,
    samples: &Samples,
    (grid, size): (&Grid, [u32; 2]),
) {
    let width = grid.size[0];
    let strokes = Strokes::new(&scene.lines, shader.view, size);
    let lines = Bands::new(grid, &strokes.covers);
    let clear = shader.geometry.covers(shader.view, size, true);
    let clear = Bands::new(grid, clear.iter().flatten());
    parallel::chunks(colors, width * BAND, |band, colors| {
        let first = band * BAND * width;
        let mut layers = Layers { samples, grid, first, all: vec![Layer::default(); colors.len()], colors };
        dispatch!(shader.level, simd => {
            for line in lines.of(band) {
                let stroke = &strokes.all[line.id as usize];
                layers.lay(line, (true, stroke.line), band, |seen| {
                    let (near, places) = (load(simd, &seen.near), seen.places(simd));
                    let opacity = seen.each_place().map(|at| stroke.opacity.value(at).clamp(0.0, 1.0));
                    let color = Vec3s::splat(simd, stroke.color);
                    (shader.hazed(simd, color, near, shader.view.rays(simd, places)), load(simd, &opacity))
                });
            }
            for pane in clear.of(band) {
                let material = &shader.geometry.surface(pane.id).material;
                layers.lay(pane, (false, shader.geometry.owner(pane.id)), band, |seen| {
                    let rays = shader.view.rays(simd, seen.places(simd));
                    let surfaces = shader.surfaces(simd, seen, rays);
                    let lit = shader.lit(simd, surfaces, Lit::whole(simd), load(simd, &seen.near), rays);
                    shader.glass(simd, material, (surfaces.normal, lit), rays)
                });
            }
        });
    });
}

/// What is laid over the pixels of a band.
struct Layers<'a> {
    samples: &'a Samples,
    grid: &'a Grid,
    /// The first pixel of the band.
    first: usize,
    all: Vec<Layer>,
    colors: &'a mut [Vec3],
}

impl Layers<'_> {
    /// Lays a triangle of a line or of a body over the pixels. `color` returns the colours of some places, and their
    /// opacity.
    #[inline(always)]
    fn lay<S: Simd>(
        &mut self,
        cover: &Cover,
        of: (bool, u32),
        band: usize,
        color: impl Fn(&Seen) -> (Vec3s<S>, S::f32s),
    ) {
        let width = self.grid.size[0];
        let mut parts: Vec<(usize, f32, f32)> = Vec::new();
        cover.scan(self.grid, rows_of(band), |row, column, bits, near| {
            let cell = row * width + column;
            let own = cell - self.first;
            let bits = near.cmpge(self.samples.near[cell]).bitmask() & bits;
            let share = self.all[own].share(of, bits, self.colors[own]);
            if share > 0.0 {
                parts.push((cell, share, near.max_element().max(HORIZON)));
            }
        });
        for parts in parts.chunks(S::f32s::LEN) {
            let mut seen = Seen::SKY;
            for (k, &(cell, _, near)) in parts.iter().enumerate() {
                seen.set(k, cover.id, near, middle(cell % width, cell / width));
            }
            let (colors, opacity) = color(&seen);
            let (colors, opacity): ([Vec3; LANES], Floats) = (colors.each(), each::<S>(opacity));
            for (k, &(cell, share, _)) in parts.iter().enumerate() {
                let own = cell - self.first;
                self.colors[own] += (colors[k] - self.all[own].under) * (opacity[k] * share);
            }
        }
    }
}

/// What was last laid over a pixel. The triangles of one line, or of one body, cover a sample once.
#[derive(Clone, Copy, Default)]
struct Layer {
    /// Whether it is a line, and its number; `None` for nothing.
    of: Option<(bool, u32)>,
    /// The samples that it covers.
    bits: u32,
    /// The colour under it.
    under: Vec3,
}

impl Layer {
    /// Adds samples of a line or a body over a colour; returns the share of the pixel that it covers anew.
    fn share(&mut self, of: (bool, u32), bits: u32, under: Vec3) -> f32 {
        if bits == 0 {
            return 0.0;
        }
        if self.of != Some(of) {
            *self = Self { of: Some(of), bits: 0, under };
        }
        let new = bits & !self.bits;
        self.bits |= bits;
        new.count_ones() as f32 / SAMPLES as f32
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;
    use crate::{Area, Body, Line, LineEnd, Mesh};
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
            Body { mesh: if k % 2 == 0 { &ball } else { &wall }, place, turn, material: materials[k % 5], thin: k == 7 }
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
