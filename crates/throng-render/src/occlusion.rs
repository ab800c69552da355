//! The share of the sky that near things do not hide (ambient occlusion in the picture: McGuire, Mara, Luebke, Scalable
//! Ambient Obscurance, 2012). It is found for every other pixel of every other row, and blended for the rest.

use crate::front::{Front, Fronts, alike, blurred, turn};
use crate::{View, parallel};
use glam::{Vec2, Vec3};

/// The distance within which things hide the sky, metres.
const REACH: f32 = 0.9;
/// The number of places that are compared.
const SPOKES: usize = 9;
/// How much of the sky near things hide, at most about 1.
const STRENGTH: f32 = 1.5;
/// The greatest distance in pixels; beyond, the comparison would be slow and coarse.
const FARTHEST: f32 = 90.0;
/// The distance of the pixels that are compared, pixels.
const STRIDE: usize = 2;

/// Returns the share of the sky that each pixel sees, 0 to 1.
pub(crate) fn open(fronts: &Fronts, view: &View) -> Vec<f32> {
    let coarse = Coarse::new(fronts, view);
    let mut raw = vec![1.0; coarse.fronts.all.len()];
    let width = coarse.fronts.width;
    parallel::chunks(&mut raw, width, |row, open| {
        open.iter_mut().enumerate().for_each(|(column, open)| *open = coarse.open(column, row));
    });
    let coarse_open = blurred(&raw, &coarse.fronts);
    let mut open = vec![1.0; fronts.all.len()];
    parallel::chunks(&mut open, fronts.width, |row, open| {
        for (column, open) in open.iter_mut().enumerate() {
            let front = &fronts.all[row * fronts.width + column];
            *open = if front.near > 0.0 { coarse.blended(&coarse_open, [column, row], front) } else { 1.0 };
        }
    });
    open
}

/// What every other pixel of every other row sees.
struct Coarse<'a> {
    fronts: Fronts,
    height: usize,
    view: &'a View,
}

impl<'a> Coarse<'a> {
    fn new(fronts: &Fronts, view: &'a View) -> Self {
        let rows = fronts.all.chunks(fronts.width).step_by(STRIDE);
        let all = rows.flat_map(|row| row.iter().step_by(STRIDE).copied()).collect();
        let height = (fronts.all.len() / fronts.width).div_ceil(STRIDE);
        Self { fronts: Fronts { all, width: fronts.width.div_ceil(STRIDE) }, height, view }
    }

    /// Returns the direction of one of its pixels.
    fn ray(&self, column: usize, row: usize) -> Vec3 {
        self.view.ray(Vec2::new((column * STRIDE) as f32 + 0.5, (row * STRIDE) as f32 + 0.5))
    }

    /// Returns the share of the sky that one of its pixels sees.
    fn open(&self, column: usize, row: usize) -> f32 {
        let front = self.fronts.all[row * self.fronts.width + column];
        if front.near <= 0.0 {
            return 1.0;
        }
        let depth = 1.0 / front.near;
        let pixel = self.view.pixel_width(depth);
        let radius = (REACH / pixel).min(FARTHEST);
        if radius < 1.0 {
            return 1.0;
        }
        let reach = (radius * pixel).min(REACH);
        let fading = 1.0 / (reach * reach);
        let at = Vec2::new(column as f32, row as f32);
        let place = self.ray(column, row) * depth;
        let turn = turn(column, row);
        let mut arm = turn.direction;
        // three turns of a spiral
        const STEP: Vec2 = Vec2::new(-0.939_692_6, 0.342_020_14);
        let mut hidden = 0.0;
        for spoke in 0..SPOKES {
            let part = (spoke as f32 + 0.5 + 0.5 * turn.share) / SPOKES as f32;
            let other = at + arm * ((radius * part * part).max(1.0) / STRIDE as f32) + 0.5;
            arm = arm.rotate(STEP);
            // a negative number becomes a large one
            let (x, y) = (other.x as i32 as u32 as usize, other.y as i32 as u32 as usize);
            if x >= self.fronts.width || y >= self.height {
                continue;
            }
            let near = self.fronts.all[y * self.fronts.width + x].near;
            if near <= 0.0 {
                continue;
            }
            let offset = self.ray(x, y) * (1.0 / near) - place;
            let square = offset.length_squared().max(1e-8);
            let above = offset.dot(front.normal);
            let fade = 1.0 - square * fading;
            if above > 0.0 && fade > 0.0 {
                hidden += (above / square.sqrt() - 0.08).max(0.0) * fade;
            }
        }
        (1.0 - STRENGTH * hidden / SPOKES as f32 * 2.0).clamp(0.0, 1.0)
    }

    /// Returns the mean of the values about a pixel of the picture that belong to the same surface; without any, of the
    /// one that is most nearly as near.
    fn blended(&self, open: &[f32], [column, row]: [usize; 2], front: &Front) -> f32 {
        let columns = [column / STRIDE, column.div_ceil(STRIDE).min(self.fronts.width - 1)];
        let rows = [row / STRIDE, row.div_ceil(STRIDE).min(self.height - 1)];
        let cells = rows.map(|row| columns.map(|column| row * self.fronts.width + column));
        let cells = cells.as_flattened();
        let first = open[cells[0]];
        if cells.iter().all(|&cell| open[cell] == first) {
            return first;
        }
        let weights = cells.iter().map(|&cell| alike(&self.fronts.all[cell], front));
        let (sum, weight) = cells
            .iter()
            .zip(weights)
            .fold((0.0, 0.0), |(sum, all), (&cell, weight)| (sum + weight * open[cell], all + weight));
        if weight > 0.0 {
            return sum / weight;
        }
        let apart = |cell: &&usize| (self.fronts.all[**cell].near - front.near).abs();
        cells.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).map_or(first, |&cell| open[cell])
    }
}
