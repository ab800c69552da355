//! Counts points near a position by means of a grid on the ground.

use glam::{DVec2, Vec2};

/// The maximum number of cells per point.
const MOST: f64 = 4.0;

/// A uniform grid over points on the ground, in square cells.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    low: DVec2,
    cell: f64,
    columns: usize,
    rows: usize,
    /// The index of the first point of each cell, followed by the number of points.
    starts: Vec<u32>,
    /// The points relative to the corner with the least coordinates.
    points: Vec<Vec2>,
}

impl Cells {
    /// Sorts points into cells at least `reach` metres wide.
    pub fn new(points: impl Iterator<Item = DVec2> + Clone, reach: f64) -> Self {
        let points = points.filter(|point| point.is_finite());
        let (low, high) =
            points.clone().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
        let count = points.clone().count();
        if count == 0 {
            return Self::default();
        }
        // Distant points make cells wider, so that the number of cells stays limited.
        let room = (high - low).max_element() / (MOST * count as f64).sqrt();
        let cell = reach.max(room);
        let [columns, rows] = ((high - low) / cell).to_array().map(|cells| cells as usize + 1);
        let mut cells =
            Self { low, cell, columns, rows, starts: vec![0; columns * rows + 1], points: vec![Vec2::ZERO; count] };
        points.clone().for_each(|at| {
            let cell = cells.of(at);
            cells.starts[cell] += 1;
        });
        let mut sum = 0;
        cells.starts.iter_mut().for_each(|start| {
            sum += *start;
            *start = sum;
        });
        for at in points {
            let cell = cells.of(at);
            cells.starts[cell] -= 1;
            cells.points[cells.starts[cell] as usize] = (at - low).as_vec2();
        }
        cells
    }

    fn of(&self, at: DVec2) -> usize {
        let [column, row] = ((at - self.low) / self.cell).to_array().map(|x| x as usize);
        row * self.columns + column
    }

    /// Returns the number of points within `reach` metres of a position. `reach` must not exceed that of `new`.
    pub fn count(&self, at: DVec2, reach: f64) -> usize {
        let place = at - self.low;
        let range = |x: f64, count: usize| {
            // The cast maps negative numbers to 0.
            let [first, last] = [x - reach, x + reach].map(|x| x / self.cell);
            (first as usize).min(count)..if last < 0.0 { 0 } else { (last as usize).min(count - 1) + 1 }
        };
        if !place.is_finite() || self.points.is_empty() {
            return 0;
        }
        let (columns, rows) = (range(place.x, self.columns), range(place.y, self.rows));
        let (place, reach) = (place.as_vec2(), (reach * reach) as f32);
        let in_row = |row: usize| {
            let [first, last] = [columns.start, columns.end].map(|column| row * self.columns + column);
            let points = &self.points[self.starts[first] as usize..self.starts[last] as usize];
            points.iter().filter(|other| other.distance_squared(place) <= reach).count()
        };
        if columns.is_empty() { 0 } else { rows.map(in_row).sum() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_equal_brute_force() {
        let place = |k: i32| DVec2::new(-1800.0 + f64::from(k * 37 % 101) * 0.13, f64::from(k * 53 % 89) * 0.11);
        for far in [None, Some(DVec2::splat(4e5)), Some(DVec2::NAN)] {
            let points: Vec<DVec2> = (0..200).map(place).chain(far).collect();
            let cells = Cells::new(points.iter().copied(), 1.5);
            for &at in points.iter().chain(&[DVec2::new(-1801.0, -1.0), DVec2::splat(-1e9), DVec2::splat(1e9)]) {
                let near = points.iter().filter(|other| other.distance(at) <= 1.5).count();
                assert_eq!(cells.count(at, 1.5), near, "{at}");
            }
        }
        assert_eq!(Cells::new(std::iter::empty(), 1.5).count(DVec2::ZERO, 1.5), 0);
    }
}
