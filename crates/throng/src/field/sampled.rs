//! A field known at the corners of a grid.

use super::Field;
use crate::Error;
use crate::parallel;
use glam::{DVec2, Vec2, Vec3};
use std::ops::Range;

/// Corners that a grid has at most.
const MOST: usize = 1 << 24;

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
    low: DVec2,
    cell: f64,
    columns: usize,
    /// At corners, row by row towards +y, in a row towards +x.
    velocities: Vec<Vec2>,
}

impl Sampled {
    /// A field at the corners of cells, row by row from `low` on, towards +x, then +y; `cell` is the width of cells, metres.
    ///
    /// # Errors
    /// A width that is not greater than 0 and finite; numbers that are not finite; rows that are not whole, or fewer than two;
    /// more than 16 million corners.
    pub fn new(low: DVec2, cell: f64, columns: usize, velocities: Vec<Vec2>) -> Result<Self, Error> {
        Self::check(cell, low)?;
        let whole = columns > 1 && velocities.len().is_multiple_of(columns) && velocities.len() >= 2 * columns;
        if !whole || velocities.len() > MOST {
            let count = velocities.len();
            let why = format!("{count} corners are not two or more whole rows of {columns}, or are more than {MOST}");
            return Err(Error::Shape { what: "the grid of the field".into(), why });
        }
        if let Some(at) = velocities.iter().position(|v| !v.is_finite()) {
            let why = format!("the velocity in row {}, column {} is not finite", at / columns, at % columns);
            return Err(Error::Shape { what: "the grid of the field".into(), why });
        }
        Ok(Self { low, cell, columns, velocities })
    }

    /// A field that says nothing yet, over the box between two corners, metres from the world's origin: rounded up to whole
    /// cells.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn over(low: DVec2, high: DVec2, cell: f64) -> Result<Self, Error> {
        Self::check(cell, low + high)?;
        // who lies on the rim by rounding needs no other cell
        let cells = |length: f64| (length / cell - 1e-9).ceil().max(1.0) as usize;
        let [columns, rows] = (high - low).to_array().map(|length| cells(length).saturating_add(1));
        if columns.saturating_mul(rows) > MOST {
            let why = format!("{columns} by {rows} corners are more than {MOST}: make its cells wider");
            return Err(Error::Shape { what: "the grid of the field".into(), why });
        }
        Ok(Self { low, cell, columns, velocities: vec![Vec2::ZERO; columns * rows] })
    }

    /// Whether cells have a width, and corners, added up, a place.
    fn check(cell: f64, corners: DVec2) -> Result<(), Error> {
        let limit = "greater than 0 and finite";
        Error::unless(cell > 0.0 && cell.is_finite(), "width of a cell of the field", cell, limit)?;
        Error::unless_finite("corner of the field", corners.element_sum())
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
        let Self { low: corner, cell, columns, .. } = *self;
        let rows = self.rows();
        // `as` saturates
        let range = |from: f64, to: f64, count: usize| -> Range<usize> {
            (from / cell).ceil() as usize..((to / cell).floor() + 1.0).min(count as f64) as usize
        };
        let (low, high) = (low - corner - cell * 1e-6, high - corner + cell * 1e-6);
        let (across, up) = (range(low.x, high.x, columns), range(low.y, high.y, rows));
        if across.is_empty() || up.is_empty() {
            return;
        }
        parallel::ranges(&mut self.velocities[..], |places, velocities| {
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
        self.cell
    }

    /// Its corner with the least coordinates, metres from the world's origin.
    pub fn low(&self) -> DVec2 {
        self.low
    }

    /// Its corner with the greatest coordinates.
    pub fn high(&self) -> DVec2 {
        self.low + self.last() * self.cell
    }

    /// Corners in a row.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Rows of corners.
    pub fn rows(&self) -> usize {
        self.velocities.len() / self.columns
    }

    /// Column and row of the last corner.
    fn last(&self) -> DVec2 {
        DVec2::new((self.columns - 1) as f64, (self.rows() - 1) as f64)
    }

    /// The velocities at its corners, row by row.
    pub fn velocities(&self) -> &[Vec2] {
        &self.velocities
    }
}

impl Field for Sampled {
    fn velocity(&self, place: Vec3, _: f64) -> Vec3 {
        let at = (place.truncate().as_dvec2() - self.low) / self.cell;
        let last = self.last();
        if !(at.cmpge(DVec2::ZERO).all() && at.cmple(last).all()) {
            return Vec3::ZERO;
        }
        let corner = at.floor().min(last - 1.0);
        let part = (at - corner).as_vec2();
        let first = corner.y as usize * self.columns + corner.x as usize;
        let along = |first: usize| self.velocities[first].lerp(self.velocities[first + 1], part.x);
        along(first).lerp(along(first + self.columns), part.y).extend(0.0)
    }
}
