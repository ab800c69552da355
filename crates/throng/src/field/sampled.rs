//! A field known at the corners of a grid.

use super::Field;
use super::grid::Grid;
use crate::Error;
use crate::parallel;
use glam::{DVec2, Vec2, Vec3};

/// Velocities at the corners of square cells, and between them by bilinear interpolation; zero beyond its rim. Asking costs the
/// same however dear the field was that it was sampled from.
///
/// ```
/// use glam::{DVec2, Vec2, Vec3};
/// use throng::field::{Field, Sampled};
/// let whirl = |place: Vec3, _: f64| Vec3::Z.cross(place);
/// let mut field = Sampled::of(&whirl, DVec2::splat(-10.0), DVec2::splat(10.0), 0.5, 0.0)?;
/// assert!(field.velocity(Vec3::new(1.2, 3.4, 0.0), 7.0).distance(Vec3::new(-3.4, 1.2, 0.0)) < 1e-5);
/// assert_eq!(field.velocity(Vec3::X * 11.0, 0.0), Vec3::ZERO);
/// // somebody stops it near the middle
/// field.sample(&|_: Vec3, _: f64| Vec3::ZERO, DVec2::splat(-1.0), DVec2::splat(1.0), 0.0);
/// assert_eq!(field.velocity(Vec3::splat(0.3), 0.0), Vec3::ZERO);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    pub(super) grid: Grid<Vec2>,
}

impl Sampled {
    /// A field at the corners of cells, row by row from `low` on, towards +x, then +y; `cell` is the width of cells, metres.
    ///
    /// # Errors
    /// A width that is not greater than 0 and finite; numbers that are not finite; rows that are not whole, or fewer than two;
    /// more than 16 million corners.
    pub fn new(low: DVec2, cell: f64, columns: usize, velocities: Vec<Vec2>) -> Result<Self, Error> {
        Ok(Self { grid: Grid::new(low, cell, columns, velocities)? })
    }

    /// A field that says nothing yet, over the box between two corners, metres from the world's origin: rounded up to whole
    /// cells.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn over(low: DVec2, high: DVec2, cell: f64) -> Result<Self, Error> {
        Ok(Self { grid: Grid::over(low, high, cell)? })
    }

    /// Another field as it is at a time, over a box.
    ///
    /// # Errors
    /// As [`over`](Self::over).
    pub fn of(field: &dyn Field, low: DVec2, high: DVec2, cell: f64, time: f64) -> Result<Self, Error> {
        let mut sampled = Self::over(low, high, cell)?;
        sampled.sample(field, low, sampled.high(), time);
        Ok(sampled)
    }

    /// Samples another field anew at those of its corners that lie in a box: where it has changed. What is not finite becomes
    /// zero.
    pub fn sample(&mut self, field: &dyn Field, low: DVec2, high: DVec2, time: f64) {
        let Grid { low: corner, cell, columns, .. } = self.grid;
        let (across, up) = self.grid.within(low, high);
        if across.is_empty() || up.is_empty() {
            return;
        }
        parallel::ranges(&mut self.grid.values[..], |places, velocities| {
            // a part of the corners begins and ends within rows
            let mut at = places.start;
            while at < places.end {
                let (row, column) = (at / columns, at % columns);
                let end = places.end.min((row + 1) * columns);
                let from = column.max(across.start);
                let to = (column + end - at).min(across.end);
                if up.contains(&row) && from < to {
                    let first = corner + DVec2::Y * (row as f64 * cell);
                    let out = &mut velocities[at - column + from - places.start..at - column + to - places.start];
                    field.row((first, cell), from, time, out);
                    out.iter_mut().filter(|v| !v.is_finite()).for_each(|v| *v = Vec2::ZERO);
                }
                at = end;
            }
        });
    }

    /// The width of its cells, metres.
    pub fn cell(&self) -> f64 {
        self.grid.cell
    }

    /// Its corner with the least coordinates, metres from the world's origin.
    pub fn low(&self) -> DVec2 {
        self.grid.low
    }

    /// Its corner with the greatest coordinates.
    pub fn high(&self) -> DVec2 {
        self.grid.high()
    }

    /// Corners in a row.
    pub fn columns(&self) -> usize {
        self.grid.columns
    }

    /// Rows of corners.
    pub fn rows(&self) -> usize {
        self.grid.rows()
    }

    /// The velocities at its corners, row by row.
    pub fn velocities(&self) -> &[Vec2] {
        &self.grid.values
    }
}

impl Field for Sampled {
    fn velocity(&self, place: Vec3, _: f64) -> Vec3 {
        self.grid.at(place.truncate().as_dvec2()).unwrap_or_default().extend(0.0)
    }
}
