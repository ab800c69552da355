//! The light that reaches what is seen: the share of the sun, and the share of the sky that is not hidden by what is
//! near (ambient occlusion in the picture: McGuire, Mara, Luebke, Scalable Ambient Obscurance, 2012).

use crate::parallel;
use crate::shadow::Shadows;
use crate::{Sun, View};
use glam::{Vec2, Vec3};

/// The distance within which things hide the sky, metres.
const REACH: f32 = 0.9;
/// The number of pixels that are compared.
const SPOKES: usize = 9;
/// How much of the sky near things hide, at most about 1.
const STRENGTH: f32 = 1.5;
/// The greatest distance in pixels; beyond, the comparison would be slow and coarse.
const FARTHEST: f32 = 90.0;
/// The radius of the blur that evens out the comparisons, pixels.
const BLUR: usize = 2;

/// What is seen in the middle of a pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Front {
    /// The nearness, 1/m; 0 for the sky.
    pub near: f32,
    /// The normal of the surface.
    pub normal: Vec3,
}

/// The light at the front of each pixel: the shares of the sun and of the sky.
pub(crate) type Light = [f32; 2];

/// Returns the light of each pixel of a picture of `width` pixels.
pub(crate) fn lights(fronts: &[Front], width: usize, view: &View, sun: &Sun, shadows: Option<&Shadows>) -> Vec<Light> {
    let height = fronts.len() / width;
    let towards = sun.direction();
    let mut raw: Vec<Light> = vec![[1.0; 2]; fronts.len()];
    parallel::chunks(&mut raw, width, |row, lights| {
        for (column, light) in lights.iter_mut().enumerate() {
            let front = fronts[row * width + column];
            if front.near <= 0.0 {
                continue;
            }
            let place = view.ray(middle(column, row)) / front.near;
            let turn = turn(column, row);
            let faces = front.normal.dot(towards) > 0.0;
            let sun = if faces { shadows.map_or(1.0, |map| map.light(place, front.normal, turn)) } else { 0.0 };
            *light = [sun, open(fronts, [width, height], view, [column, row], turn)];
        }
    });
    blurred(&blurred(&raw, fronts, width, false), fronts, width, true)
}

fn middle(column: usize, row: usize) -> Vec2 {
    Vec2::new(column as f32 + 0.5, row as f32 + 0.5)
}

/// Returns a number from 0 to 1 that differs between the pixels of a small square (interleaved gradient noise: Jimenez,
/// 2014).
fn turn(column: usize, row: usize) -> f32 {
    let value = 52.982_918 * (0.067_110_56 * column as f32 + 0.005_837_15 * row as f32).fract();
    value.fract()
}

/// Returns the share of the sky that near things do not hide.
fn open(fronts: &[Front], [width, height]: [usize; 2], view: &View, [column, row]: [usize; 2], turn: f32) -> f32 {
    let front = fronts[row * width + column];
    let depth = 1.0 / front.near;
    let radius = (REACH / view.pixel_width(depth)).min(FARTHEST);
    if radius < 1.0 {
        return 1.0;
    }
    let reach = (radius * view.pixel_width(depth)).min(REACH);
    let at = middle(column, row);
    let place = view.ray(at) * depth;
    let (sine, cosine) = libm::sincosf(turn * std::f32::consts::TAU);
    let mut arm = Vec2::new(cosine, sine);
    // three turns of a spiral with 9 spokes
    const STEP: Vec2 = Vec2::new(-0.939_692_6, 0.342_020_14);
    let mut hidden = 0.0;
    for spoke in 0..SPOKES {
        let part = (spoke as f32 + 0.5 + 0.5 * turn) / SPOKES as f32;
        let pixel = at + arm * (radius * part * part).max(1.0);
        arm = arm.rotate(STEP);
        if pixel.x < 0.0 || pixel.y < 0.0 {
            continue;
        }
        let (x, y) = (pixel.x as usize, pixel.y as usize);
        if x >= width || y >= height {
            continue;
        }
        let other = fronts[y * width + x].near;
        if other <= 0.0 {
            continue;
        }
        let offset = view.ray(middle(x, y)) / other - place;
        let square = offset.length_squared().max(1e-8);
        let fade = (1.0 - square / (reach * reach)).max(0.0);
        let height = offset.dot(front.normal) / square.sqrt();
        hidden += (height - 0.08).max(0.0) * fade;
    }
    (1.0 - STRENGTH * hidden / SPOKES as f32 * 2.0).clamp(0.0, 1.0)
}

/// Returns the mean of the light of neighbours along a row or a column that belong to the same surface.
fn blurred(lights: &[Light], fronts: &[Front], width: usize, vertical: bool) -> Vec<Light> {
    let height = lights.len() / width;
    let mut out = vec![[1.0; 2]; lights.len()];
    parallel::chunks(&mut out, width, |row, out| {
        for (column, out) in out.iter_mut().enumerate() {
            let here = row * width + column;
            let front = fronts[here];
            if front.near <= 0.0 {
                continue;
            }
            let (at, most, stride) = if vertical { (row, height, width) } else { (column, width, 1) };
            let (mut sum, mut weights) = ([0.0; 2], 0.0);
            for k in at.saturating_sub(BLUR)..(at + BLUR + 1).min(most) {
                let index = here - at * stride + k * stride;
                let other = fronts[index];
                // the same surface has about the same depth and direction
                let apart = (other.near - front.near).abs() / front.near;
                let weight = (1.0 - 25.0 * apart).max(0.0) * (other.normal.dot(front.normal) * 4.0 - 3.0).max(0.0);
                sum = [sum[0] + weight * lights[index][0], sum[1] + weight * lights[index][1]];
                weights += weight;
            }
            *out = if weights > 0.0 { sum.map(|sum| sum / weights) } else { lights[here] };
        }
    });
    out
}
