//! Items sorted into square cells of the plane, for queries by place.

use glam::DVec2;

/// A uniform grid of cells. Each cell lists the numbers of the items that touch it, in ascending order.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    /// Lower left corner.
    pub low: DVec2,
    /// Width of a cell, metres.
    pub width: f64,
    /// Cells per metre.
    inverse: f64,
    /// Number of columns.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    /// Start of each cell's items, and the end of the last cell's.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Cells {
    /// Returns empty cells of this width that cover a box.
    pub fn new(low: DVec2, high: DVec2, width: f64) -> Self {
        let size = high - low;
        let (columns, rows) = ((size.x / width) as usize + 1, (size.y / width) as usize + 1);
        Self {
            low,
            width,
            inverse: width.recip(),
            columns,
            rows,
            starts: vec![0; columns * rows + 1],
            items: Vec::new(),
        }
    }

    /// Fills the cells with pairs of (cell, item).
    pub fn fill(&mut self, mut pairs: Vec<(u32, u32)>) {
        pairs.sort_unstable();
        self.starts.fill(0);
        for &(cell, _) in &pairs {
            self.starts[cell as usize + 1] += 1;
        }
        for cell in 1..self.starts.len() {
            self.starts[cell] += self.starts[cell - 1];
        }
        self.items = pairs.into_iter().map(|(_, item)| item).collect();
    }

    /// Returns the column and row of the cell of a point, apart from rounding, or those of the nearest cell.
    pub fn place(&self, at: DVec2) -> (usize, usize) {
        let cell = (at - self.low) * self.inverse;
        ((cell.x.max(0.0) as usize).min(self.columns - 1), (cell.y.max(0.0) as usize).min(self.rows - 1))
    }

    /// Returns the cell of a point, or the nearest cell.
    pub fn cell_of(&self, at: DVec2) -> usize {
        let (column, row) = self.place(at);
        row * self.columns + column
    }

    /// Returns the lower left and upper right corners of a cell.
    pub fn square(&self, cell: usize) -> (DVec2, DVec2) {
        let low = self.low + DVec2::new((cell % self.columns) as f64, (cell / self.columns) as f64) * self.width;
        (low, low + self.width)
    }

    /// Returns the rows of cells that a box touches, each with its lower side.
    pub fn rows_of(&self, from: DVec2, to: DVec2) -> impl Iterator<Item = (f64, usize)> + use<> {
        let (low, width) = (self.low.y, self.width);
        (self.place(from).1..=self.place(to).1).map(move |row| (low + row as f64 * width, row))
    }

    /// Returns the columns of cells between two places along x.
    pub fn columns_of(&self, left: f64, right: f64) -> std::ops::RangeInclusive<usize> {
        let column = |x: f64| self.place(DVec2::new(x, self.low.y)).0;
        column(left)..=column(right)
    }

    /// Returns the cells that a box touches, row by row.
    pub fn touched(&self, from: DVec2, to: DVec2) -> impl Iterator<Item = usize> + use<> {
        let ((left, bottom), (right, top)) = (self.place(from), self.place(to));
        let columns = self.columns;
        (bottom..=top).flat_map(move |row| (left..=right).map(move |column| row * columns + column))
    }

    /// Returns the items of a cell.
    pub fn items(&self, cell: usize) -> &[u32] {
        &self.items[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }
}
