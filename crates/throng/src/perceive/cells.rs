//! The cells of many points at once, with SIMD. The results equal those of the [scalar functions](Grid::row).

use super::grid::Grid;
use crate::simd::Vec2s;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::Vec2;

/// Returns the least and the greatest coordinates of points; infinite if there are no points.
pub(super) fn bounds(level: Level, points: &[Vec2]) -> (Vec2, Vec2) {
    dispatch!(level, simd => bounds_of(simd, points))
}

#[inline(always)]
fn bounds_of<S: Simd>(simd: S, points: &[Vec2]) -> (Vec2, Vec2) {
    let (whole, left) = points.split_at(points.len() - points.len() % S::f32s::LEN);
    let all = |value| Vec2s::<S> { x: S::f32s::splat(simd, value), y: S::f32s::splat(simd, value) };
    let (mut low, mut high) = (all(f32::INFINITY), all(f32::NEG_INFINITY));
    for points in whole.chunks_exact(S::f32s::LEN) {
        let p = Vec2s::<S>::from_side_by_side(simd, points);
        low = Vec2s { x: low.x.min(p.x), y: low.y.min(p.y) };
        high = Vec2s { x: high.x.max(p.x), y: high.y.max(p.y) };
    }
    let low = Vec2::new(low.x.reduce_min(), low.y.reduce_min());
    let high = Vec2::new(high.x.reduce_max(), high.y.reduce_max());
    left.iter().fold((low, high), |(low, high), &p| (low.min(p), high.max(p)))
}

impl Grid {
    /// Finds the cell of each point.
    pub(super) fn find_cells(&self, level: Level, points: &[Vec2], cells: &mut [u32]) {
        dispatch!(level, simd => self.find_all(simd, points, cells));
    }

    #[inline(always)]
    fn find_all<S: Simd>(&self, simd: S, points: &[Vec2], cells: &mut [u32]) {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let (left, bottom) = (splat(self.low.x), splat(self.low.y));
        let (along, across) = (splat(self.inverse.x), splat(self.inverse.y));
        let integer = |value: usize| S::i32s::splat(simd, value as i32);
        let (zero, columns) = (integer(0), integer(self.columns));
        let (last_column, last_row) = (integer(self.columns - 1), integer(self.rows() - 1));
        for (points, cells) in points.chunks(S::f32s::LEN).zip(cells.chunks_mut(S::f32s::LEN)) {
            let p = Vec2s::<S>::from_side_by_side(simd, points);
            let column = ((p.x - left) * along).to_int_precise::<S::i32s>().max(zero).min(last_column);
            let row = ((p.y - bottom) * across).to_int_precise::<S::i32s>().max(zero).min(last_row);
            let cell = row * columns + column;
            cells.iter_mut().zip(cell.as_slice()).for_each(|(out, &cell)| *out = cell as u32);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::perceive::SimdLevel;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn all_instructions_find_the_same_cells(
            points in prop::collection::vec((-20.0f32..20.0, -2e3f32..20.0), 1..100), cell in 0.1f32..20.0,
        ) {
            let points: Vec<Vec2> = points.into_iter().map(Vec2::from).collect();
            let numbers: Vec<u32> = (0..points.len() as u32).collect();
            let mut grid = Grid::default();
            grid.rebuild(&points, &numbers, cell);
            let first = points[0];
            let box_round = points.iter().fold((first, first), |(low, high), &p| (low.min(p), high.max(p)));
            // points outside the grid too
            let all: Vec<Vec2> = points.iter().flat_map(|&p| [p, p * 1e9]).collect();
            let expected: Vec<u32> =
                all.iter().map(|p| (grid.row(p.y) * grid.columns + grid.column(p.x)) as u32).collect();
            for level in SimdLevel::ALL.into_iter().filter_map(SimdLevel::level) {
                let mut cells = vec![0; all.len()];
                grid.find_cells(level, &all, &mut cells);
                prop_assert_eq!(&cells, &expected, "{:?}", level);
                prop_assert_eq!(bounds(level, &points), box_round, "{:?}", level);
            }
        }
    }
}
