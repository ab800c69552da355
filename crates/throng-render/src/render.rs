//! From a scene to a picture, step by step.

use crate::coarse::Coarse;
use crate::front::{Front, Fronts};
use crate::geometry::{GROUND, Geometry, SKY, ground};
use crate::lines::Strokes;
use crate::occlusion;
use crate::raster::{BAND, Bands, Grid, SAMPLES, cover, rows_of};
use crate::shade::{Lit, Shader};
use crate::shadow::Shadows;
use crate::tone::Tone;
use crate::{Scene, View, parallel};
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
    /// The bytes are the same for any number of threads.
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
        let grid = Grid::picture(size);
        let geometry = Geometry::new(scene, view);
        let samples = Samples::new(scene, &geometry, view, &grid, size);
        let shader = Shader {
            view,
            light: &scene.light,
            geometry: &geometry,
            ground: scene.ground,
            towards: scene.light.sun.direction(),
            eye: view.eye.as_vec3(),
        };
        let (fronts, mut colors) = samples.fronts(&shader, width as usize);
        let coarse = Coarse::new(&fronts);
        let open = occlusion::open(&fronts, &coarse, view);
        let shadows = Shadows::new(&geometry, &scene.light.sun);
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
        Ok(Self { size, view: *view, bytes: pixels.into_flattened(), near })
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
    fn at(&self, cell: usize) -> Lit {
        Lit { sun: self.sun[cell], open: self.open[cell] }
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
            for (column, (front, color)) in fronts.iter_mut().zip(colors).enumerate() {
                let cell = row * width + column;
                let id = most(self.ids[cell]);
                if id == SKY {
                    continue;
                }
                let (near, _) = self.nearness(cell, id);
                let (hit, own) = shader.surface(id, near, shader.view.ray(middle(column, row)));
                (*front, *color) = (Front { near, normal: hit.normal }, own);
            }
        });
        (Fronts { all, width }, colors)
    }

    /// Lights the colours of all pixels, and mixes those of the samples of a pixel.
    fn light(&self, shader: &Shader<'_>, fronts: &Fronts, lights: &Lights, colors: &mut [Vec3]) {
        let width = fronts.width;
        parallel::chunks(colors, width, |row, colors| {
            for (column, color) in colors.iter_mut().enumerate() {
                let cell = row * width + column;
                let ray = shader.view.ray(middle(column, row));
                let ids = self.ids[cell];
                let id = most(ids);
                let front = fronts.all[cell];
                let main = match id {
                    SKY => shader.sky(ray),
                    _ => shader.lit(front.normal, *color, lights.at(cell), front.near, ray),
                };
                if ids == [id; SAMPLES] {
                    *color = main;
                    continue;
                }
                *color = Vec3::ZERO;
                for sample in 0..SAMPLES {
                    let other = ids[sample];
                    if ids[..sample].contains(&other) {
                        continue;
                    }
                    let (near, count) = self.nearness(cell, other);
                    let part = match other {
                        _ if other == id => main,
                        SKY => shader.sky(ray),
                        _ => {
                            let (hit, color) = shader.surface(other, near, ray);
                            let light = lights.at(neighbour(fronts, [column, row], near));
                            shader.lit(hit.normal, color, light, near, ray)
                        }
                    };
                    *color += part * (count / SAMPLES as f32);
                }
            }
        });
    }
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
        let mut layers = vec![Layer::default(); colors.len()];
        let seen = |bits: u32, near: Vec4, cell: usize| near.cmpge(samples.near[cell]).bitmask() & bits;
        for line in lines.of(band) {
            let stroke = &strokes.all[line.id as usize];
            line.scan(grid, rows_of(band), |row, column, bits, near| {
                let cell = row * width + column;
                let (layer, under) = (&mut layers[cell - first], &mut colors[cell - first]);
                let share = layer.share((true, stroke.line), seen(bits, near, cell), *under);
                if share > 0.0 {
                    let at = middle(column, row);
                    let color = shader.hazed(stroke.color, near.max_element().max(HORIZON), shader.view.ray(at));
                    *under += (color - layer.under) * (stroke.opacity.value(at).clamp(0.0, 1.0) * share);
                }
            });
        }
        for pane in clear.of(band) {
            let owner = shader.geometry.owner(pane.id);
            pane.scan(grid, rows_of(band), |row, column, bits, near| {
                let cell = row * width + column;
                let (layer, under) = (&mut layers[cell - first], &mut colors[cell - first]);
                let share = layer.share((false, owner), seen(bits, near, cell), *under);
                if share > 0.0 {
                    let ray = shader.view.ray(middle(column, row));
                    let near = near.max_element();
                    let (hit, color) = shader.surface(pane.id, near, ray);
                    let lit = shader.lit(hit.normal, color, Lit::WHOLE, near, ray);
                    let (color, opacity) = shader.glass(&hit, lit, ray);
                    *under += (color - layer.under) * (opacity * share);
                }
            });
        }
    });
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
