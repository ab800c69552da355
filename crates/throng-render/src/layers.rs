//! What lies above what samples see: lines, and bodies that one can see through.

use crate::Scene;
use crate::lines::Strokes;
use crate::parallel;
use crate::raster::{BAND, Bands, Cover, Grid, SAMPLES, rows_of};
use crate::samples::{HORIZON, Samples, middle};
use crate::shade::{Lit, Seen, Shader};
use crate::simd::{Floats, LANES, Vec3s, each, load};
use fearless_simd::dispatch;
use fearless_simd::prelude::*;
use glam::Vec3;

/// Adds what lies above: lines, and then bodies that one can see through.
pub(crate) fn above(
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
        let all = vec![Layer::default(); colors.len()];
        let mut layers = Layers { samples, grid, first, all, colors, parts: Vec::new() };
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
    /// The pixels of a triangle, the shares of them that it covers anew, and their nearness.
    parts: Vec<(usize, f32, f32)>,
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
        self.parts.clear();
        cover.scan(self.grid, rows_of(band), |row, column, bits, near| {
            let cell = row * width + column;
            let own = cell - self.first;
            let bits = near.cmpge(self.samples.near[cell]).bitmask() & bits;
            let share = self.all[own].share(of, bits, self.colors[own]);
            if share > 0.0 {
                self.parts.push((cell, share, near.max_element().max(HORIZON)));
            }
        });
        for parts in self.parts.chunks(S::f32s::LEN) {
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
