//! A map of square cells, each solid or free.

use crate::Error;
use glam::Vec2;

/// Maximum number of cells of a map.
const MOST: usize = 1 << 26;

/// A map of square cells, each solid or free; outside of the map everything is solid. Metres, in the caller's
/// coordinates.
///
/// ```
/// use glam::Vec2;
/// use throng::space::Raster;
/// let pillar = |at: Vec2| at.length() < 3.0;
/// let map = Raster::of(Vec2::splat(-10.0), Vec2::splat(10.0), 0.5, pillar)?;
/// assert!(map.is_solid(Vec2::ZERO) && !map.is_solid(Vec2::X * 5.0) && map.is_solid(Vec2::X * 11.0));
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    low: Vec2,
    cell: f32,
    columns: usize,
    solid: Vec<bool>,
}

impl Raster {
    /// Returns a map of cells row by row, from the corner `low` towards +x, then +y; `cell` is their width.
    ///
    /// # Errors
    /// [`Error::Limit`] for a width that is not greater than 0 and finite, [`Error::Shape`] for incomplete rows or too
    /// many cells.
    pub fn new(low: Vec2, cell: f32, columns: usize, solid: Vec<bool>) -> Result<Self, Error> {
        Error::unless_positive("width of a cell of the map", cell)?;
        Error::unless_finite("corner of the map", f64::from(low.element_sum()))?;
        if columns == 0 || !solid.len().is_multiple_of(columns) || solid.len() > MOST {
            let why = format!("{} cells are not whole rows of {columns}, or are more than {MOST}", solid.len());
            return Err(Error::Shape { what: "the map".into(), why });
        }
        Ok(Self { low, cell, columns, solid })
    }

    /// Returns a map of the box between two corners. A cell is solid if its centre is.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn of(low: Vec2, high: Vec2, cell: f32, solid: impl Fn(Vec2) -> bool) -> Result<Self, Error> {
        Error::unless_positive("width of a cell of the map", cell)?;
        Error::unless_finite("corner of the map", f64::from((low + high).element_sum()))?;
        let [columns, rows] = ((high - low) / cell).to_array().map(|cells| cells.max(0.0).ceil() as usize);
        if columns.saturating_mul(rows) > MOST {
            let why = format!("{columns} by {rows} cells are more than {MOST}");
            return Err(Error::Shape { what: "the map".into(), why });
        }
        let middle = |i: usize| low + (Vec2::new((i % columns) as f32, (i / columns) as f32) + 0.5) * cell;
        let solid = (0..columns * rows).map(|i| solid(middle(i))).collect();
        Self::new(low, cell, columns, solid)
    }

    /// Returns the width of its cells, metres.
    pub fn cell(&self) -> f32 {
        self.cell
    }

    /// Whether a place is solid or outside of the map.
    pub fn is_solid(&self, at: Vec2) -> bool {
        let [x, y] = ((at - self.low) / self.cell).to_array();
        // NaN is outside
        if !(x >= 0.0 && y >= 0.0 && x < self.columns as f32) {
            return true;
        }
        self.solid.get(y as usize * self.columns + x as usize).copied().unwrap_or(true)
    }
}
