//! Every other pixel of every other row, for what is found for some pixels and blended for the rest.

use crate::front::{Front, Fronts, Like};
use crate::parallel;

/// The distance of the pixels that are chosen, pixels.
pub(crate) const STRIDE: usize = 2;

/// What every other pixel of every other row sees.
pub(crate) struct Coarse {
    pub fronts: Fronts,
    pub height: usize,
}

impl Coarse {
    pub fn new(fronts: &Fronts) -> Self {
        let width = fronts.width.div_ceil(STRIDE);
        let height = (fronts.all.len() / fronts.width).div_ceil(STRIDE);
        let mut all = vec![Front::SKY; width * height];
        parallel::chunks(&mut all, width, |row, all| {
            let seen = fronts.all[row * STRIDE * fronts.width..].iter().step_by(STRIDE);
            all.iter_mut().zip(seen).for_each(|(front, seen)| *front = *seen);
        });
        Self { fronts: Fronts { all, width }, height }
    }

    /// Returns the chosen pixels about a pixel of the picture.
    fn about(&self, [column, row]: [usize; 2]) -> [usize; 4] {
        let columns = [column / STRIDE, column.div_ceil(STRIDE).min(self.fronts.width - 1)];
        let rows = [row / STRIDE, row.div_ceil(STRIDE).min(self.height - 1)];
        let [upper, lower] = [rows[0] * self.fronts.width, rows[1] * self.fronts.width];
        [upper + columns[0], upper + columns[1], lower + columns[0], lower + columns[1]]
    }

    /// Returns the value that all chosen pixels about a pixel have, if they see the same surface.
    pub fn agreed(&self, values: &[f32], pixel: [usize; 2], front: &Front) -> Option<f32> {
        let cells = self.about(pixel);
        let first = values[cells[0]];
        let like = Like::new(front);
        let same = |cell: usize| values[cell] == first && like.share(&self.fronts.all[cell]) > 0.0;
        cells.into_iter().all(same).then_some(first)
    }

    /// Returns the mean of the values about a pixel that belong to the same surface; without any, of the one that is
    /// most nearly as near.
    pub fn blended(&self, values: &[f32], pixel: [usize; 2], front: &Front) -> f32 {
        let cells = self.about(pixel);
        let first = values[cells[0]];
        if cells.iter().all(|&cell| values[cell] == first) {
            return first;
        }
        self.fronts.mean(values, cells, front).unwrap_or_else(|| {
            let apart = |cell: &usize| (self.fronts.all[*cell].near - front.near).abs();
            cells.into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).map_or(first, |cell| values[cell])
        })
    }
}
