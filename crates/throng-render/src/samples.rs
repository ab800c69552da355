//! What the samples of each pixel see, and their colours.

use crate::View;
use crate::front::{Front, Fronts};
use crate::geometry::{GROUND, Geometry, SKY, ground};
use crate::raster::{Bands, Grid, SAMPLES, cover};
use crate::shade::{Lit, Seen, Shader, Surfaces};
use crate::simd::{LANES, Vec3s, load, mask, set3};
use crate::{Scene, parallel};
use fearless_simd::dispatch;
use fearless_simd::prelude::*;
use glam::{Vec2, Vec3, Vec4};

/// The nearness, 1/m, below which the ground is part of the haze.
pub(crate) const HORIZON: f32 = 1e-5;

/// What is nearest at each sample.
pub(crate) struct Samples {
    pub near: Vec<Vec4>,
    ids: Vec<[u32; SAMPLES]>,
}

/// The light at the middle of each pixel: the shares of the sun and of the sky, 0 to 1.
pub(crate) struct Lights {
    pub sun: Vec<f32>,
    pub open: Vec<f32>,
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
    pub fn new(scene: &Scene<'_>, geometry: &Geometry<'_>, view: &View, grid: &Grid, size: [u32; 2]) -> Self {
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
    pub fn fronts(&self, shader: &Shader<'_>, width: usize) -> (Fronts, Vec<Vec3>) {
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
    pub fn light(&self, shader: &Shader<'_>, fronts: &Fronts, lights: &Lights, colors: &mut [Vec3]) {
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
                set3(&mut normals, k, front.normal);
                set3(&mut own, k, colors[column]);
            }
            let surfaces = Surfaces { normal: Vec3s::load(simd, &normals), color: Vec3s::load(simd, &own) };
            let rays = shader.view.rays(simd, seen.places(simd));
            let lit = lit(simd, shader, (&seen, rays), surfaces, lights.at(simd, &cells)).each();
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
            let rays = shader.view.rays(simd, seen.places(simd));
            let surfaces = shader.surfaces(simd, &seen, rays);
            let lit = lit(simd, shader, (&seen, rays), surfaces, lights.at(simd, &cells));
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
fn lit<S: Simd>(
    simd: S,
    shader: &Shader<'_>,
    (seen, rays): (&Seen, Vec3s<S>),
    surfaces: Surfaces<S>,
    light: Lit<S>,
) -> Vec3s<S> {
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

/// Returns the place of the middle of a pixel.
pub(crate) fn middle(column: usize, row: usize) -> Vec2 {
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
