//! Numbers at the corners of a grid: painted maps.

use super::grid::ValueGrid;
use super::paint::Brush;
use glam::DVec2;
use throng::Error;
use throng::field::FactorMap;

/// A number at every place of a box: for example the weight of a field, or the cost of a metre. It is stored at the
/// corners of square cells and interpolated bilinearly; beyond the rim it is zero.
///
/// ```
/// use glam::DVec2;
/// use throng_field::{Brush, Map};
/// let mut map = Map::over(DVec2::splat(-10.0), DVec2::splat(10.0), 0.5)?;
/// map.paint(&Brush { radius: 3.0, ..Brush::default() }, &[DVec2::new(-10.0, 0.0), DVec2::new(10.0, 0.0)], 1.0)?;
/// assert_eq!(map.at(DVec2::new(2.0, 0.2)), 1.0);
/// assert_eq!(map.at(DVec2::new(2.0, 4.0)), 0.0);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    grid: ValueGrid<f32>,
}

impl Map {
    /// Creates a map from the numbers at the corners of cells, row by row from `low`, towards +x, then +y; `cell` is
    /// the width of a cell, metres.
    ///
    /// # Errors
    /// As [`Sampled::new`](super::Sampled::new).
    pub fn new(low: DVec2, cell: f64, columns: usize, values: Vec<f32>) -> Result<Self, Error> {
        Ok(Self { grid: ValueGrid::new(low, cell, columns, values)? })
    }

    /// Creates a map of zeros over the box between two corners, metres from the origin, rounded up to whole
    /// cells.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn over(low: DVec2, high: DVec2, cell: f64) -> Result<Self, Error> {
        Ok(Self { grid: ValueGrid::over(low, high, cell)? })
    }

    /// Returns the number at a place, metres from the origin.
    pub fn at(&self, place: DVec2) -> f32 {
        self.grid.at(place).unwrap_or(0.0)
    }

    /// Strokes a brush along a line: where the brush has full strength, the map becomes `value`.
    ///
    /// # Errors
    /// As [`Sampled::paint`](super::Sampled::paint).
    pub fn paint(&mut self, brush: &Brush, points: &[DVec2], value: f32) -> Result<(), Error> {
        Error::unless_finite("value of a stroke", f64::from(value))?;
        brush.stroke(&mut self.grid, points, |_| value)
    }

    /// Returns the corners with the least and the greatest coordinates, metres from the origin.
    pub fn bounds(&self) -> [DVec2; 2] {
        [self.grid.low, self.grid.high()]
    }

    /// Returns the numbers at the corners, row by row.
    pub fn values(&self) -> &[f32] {
        &self.grid.values
    }
}

impl FactorMap for Map {
    fn at(&self, place: DVec2) -> f32 {
        self.at(place)
    }
}
