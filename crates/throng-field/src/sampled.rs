//! Fields stored at the corners of a grid.

use super::grid::ValueGrid;
use glam::{DVec2, Vec2, Vec3};
use throng::Error;
use throng::field::Field;
use throng::parallel;

/// Velocities at the corners of square cells, interpolated bilinearly between them; zero beyond the rim. The cost of an
/// evaluation does not depend on the field that was sampled.
///
/// ```
/// use glam::{DVec2, Vec2, Vec3};
/// use throng::field::Field;
/// use throng_field::Sampled;
/// let whirl = |place: Vec3, _: f64| Vec3::Z.cross(place);
/// let mut field = Sampled::of(&whirl, DVec2::splat(-10.0), DVec2::splat(10.0), 0.5, 0.0)?;
/// assert!(field.velocity(Vec3::new(1.2, 3.4, 0.0), 7.0).distance(Vec3::new(-3.4, 1.2, 0.0)) < 1e-5);
/// assert_eq!(field.velocity(Vec3::X * 11.0, 0.0), Vec3::ZERO);
/// // the field becomes zero near the middle
/// field.sample(&|_: Vec3, _: f64| Vec3::ZERO, DVec2::splat(-1.0), DVec2::splat(1.0), 0.0);
/// assert_eq!(field.velocity(Vec3::splat(0.3), 0.0), Vec3::ZERO);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    pub(super) grid: ValueGrid<Vec2>,
}

impl Sampled {
    /// Creates a field from the velocities at the corners of cells, row by row from `low`, towards +x, then +y; `cell`
    /// is the width of a cell, metres.
    ///
    /// # Errors
    /// A width that is not greater than 0 and finite; values that are not finite; incomplete rows, or fewer than two;
    /// more than 16 million corners.
    pub fn new(low: DVec2, cell: f64, columns: usize, velocities: Vec<Vec2>) -> Result<Self, Error> {
        Ok(Self { grid: ValueGrid::new(low, cell, columns, velocities)? })
    }

    /// Creates a field of zeros over the box between two corners, metres from the origin, rounded up to whole
    /// cells.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn over(low: DVec2, high: DVec2, cell: f64) -> Result<Self, Error> {
        Ok(Self { grid: ValueGrid::over(low, high, cell)? })
    }

    /// Samples a field at a time, over a box.
    ///
    /// # Errors
    /// As [`over`](Self::over).
    pub fn of(field: &dyn Field, low: DVec2, high: DVec2, cell: f64, time: f64) -> Result<Self, Error> {
        let mut sampled = Self::over(low, high, cell)?;
        sampled.sample(field, low, sampled.high(), time);
        Ok(sampled)
    }

    /// Samples a field again at the corners in a box, for example where the field has changed. Values that are not
    /// finite become zero.
    pub fn sample(&mut self, field: &dyn Field, low: DVec2, high: DVec2, time: f64) {
        let ValueGrid { low: corner, cell, columns, .. } = self.grid;
        let (across, up) = self.grid.within(low, high);
        if across.is_empty() || up.is_empty() {
            return;
        }
        parallel::ranges(&mut self.grid.values[..], |places, velocities| {
            // a part of the corners can begin and end within rows
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

    /// Returns the width of a cell, metres.
    pub fn cell(&self) -> f64 {
        self.grid.cell
    }

    /// Returns the corner with the least coordinates, metres from the origin.
    pub fn low(&self) -> DVec2 {
        self.grid.low
    }

    /// Returns the corner with the greatest coordinates.
    pub fn high(&self) -> DVec2 {
        self.grid.high()
    }

    /// Returns the number of corners in a row.
    pub fn columns(&self) -> usize {
        self.grid.columns
    }

    /// Returns the number of rows of corners.
    pub fn rows(&self) -> usize {
        self.grid.rows()
    }

    /// Returns the velocities at the corners, row by row.
    pub fn velocities(&self) -> &[Vec2] {
        &self.grid.values
    }
}

impl Field for Sampled {
    fn velocity(&self, place: Vec3, _: f64) -> Vec3 {
        self.grid.at(place.truncate().as_dvec2()).unwrap_or_default().extend(0.0)
    }
}
