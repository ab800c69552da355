//! Grids of values at the corners of cells, with bilinear interpolation between them.

use glam::DVec2;
use std::ops::{Add, Mul, Range, Sub};
use throng::Error;

/// Maximum number of corners of a grid.
const MOST: usize = 1 << 24;

/// A value that can be interpolated.
pub(super) trait Interpolate: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f32, Output = Self> {
    /// The value of corners that are not set.
    const NOTHING: Self;

    /// Whether all components are finite.
    fn is_number(self) -> bool;
}

impl Interpolate for f32 {
    const NOTHING: Self = 0.0;

    fn is_number(self) -> bool {
        self.is_finite()
    }
}

impl Interpolate for glam::Vec2 {
    const NOTHING: Self = Self::ZERO;

    fn is_number(self) -> bool {
        self.is_finite()
    }
}

/// Values at the corners of square cells.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ValueGrid<T> {
    pub low: DVec2,
    pub cell: f64,
    pub columns: usize,
    /// Row by row towards +y, in a row towards +x.
    pub values: Vec<T>,
}

impl<T: Interpolate> ValueGrid<T> {
    pub fn new(low: DVec2, cell: f64, columns: usize, values: Vec<T>) -> Result<Self, Error> {
        Self::check(cell, low)?;
        let fail = |why| Err(Error::Shape { what: "the grid of the field".into(), why });
        let whole = columns > 1 && values.len().is_multiple_of(columns) && values.len() >= 2 * columns;
        if !whole || values.len() > MOST {
            let count = values.len();
            return fail(format!(
                "{count} corners are not two or more whole rows of {columns}, or are more than {MOST}"
            ));
        }
        if let Some(at) = values.iter().position(|value| !value.is_number()) {
            return fail(format!("the value in row {}, column {} is not finite", at / columns, at % columns));
        }
        Ok(Self { low, cell, columns, values })
    }

    /// Creates a grid of [`NOTHING`](Interpolate::NOTHING) over the box between two corners, rounded up to whole cells.
    pub fn over(low: DVec2, high: DVec2, cell: f64) -> Result<Self, Error> {
        Self::check(cell, low + high)?;
        // a rim that exceeds the last cell by rounding only needs no other cell
        let cells = |length: f64| (length / cell - 1e-9).ceil().max(1.0) as usize;
        let [columns, rows] = (high - low).to_array().map(|length| cells(length).saturating_add(1));
        if columns.saturating_mul(rows) > MOST {
            let why = format!("{columns} by {rows} corners are more than {MOST}: make its cells wider");
            return Err(Error::Shape { what: "the grid of the field".into(), why });
        }
        Ok(Self { low, cell, columns, values: vec![T::NOTHING; columns * rows] })
    }

    /// Checks the width of the cells and the sum of the corners.
    fn check(cell: f64, corners: DVec2) -> Result<(), Error> {
        let limit = "greater than 0 and finite";
        Error::unless(cell > 0.0 && cell.is_finite(), "width of a cell of the field", cell, limit)?;
        Error::unless_finite("corner of the field", corners.element_sum())
    }

    /// Returns the corner with the greatest coordinates.
    pub fn high(&self) -> DVec2 {
        self.low + self.last() * self.cell
    }

    /// Returns the number of rows of corners.
    pub fn rows(&self) -> usize {
        self.values.len() / self.columns
    }

    /// Returns column and row of the last corner.
    fn last(&self) -> DVec2 {
        DVec2::new((self.columns - 1) as f64, (self.rows() - 1) as f64)
    }

    /// Returns the place of a corner.
    pub fn place(&self, column: usize, row: usize) -> DVec2 {
        self.low + DVec2::new(column as f64, row as f64) * self.cell
    }

    /// Returns columns and rows of the corners in a box.
    pub fn within(&self, low: DVec2, high: DVec2) -> (Range<usize>, Range<usize>) {
        // `as` saturates
        let range = |from: f64, to: f64, count: usize| -> Range<usize> {
            (from / self.cell).ceil() as usize..((to / self.cell).floor() + 1.0).min(count as f64) as usize
        };
        let margin = self.cell * 1e-6;
        let (low, high) = (low - self.low - margin, high - self.low + margin);
        (range(low.x, high.x, self.columns), range(low.y, high.y, self.rows()))
    }

    /// Returns the value at a place; none beyond the rim.
    pub fn at(&self, place: DVec2) -> Option<T> {
        let at = (place - self.low) / self.cell;
        let last = self.last();
        if !(at.cmpge(DVec2::ZERO).all() && at.cmple(last).all()) {
            return None;
        }
        let corner = at.floor().min(last - 1.0);
        let part = (at - corner).as_vec2();
        let first = corner.y as usize * self.columns + corner.x as usize;
        let between = |from: T, to: T, part: f32| from + (to - from) * part;
        let along = |first: usize| between(self.values[first], self.values[first + 1], part.x);
        Some(between(along(first), along(first + self.columns), part.y))
    }
}
