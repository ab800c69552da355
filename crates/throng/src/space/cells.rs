//! Things sorted into square cells of the plane, to look up what is near a place.

use glam::DVec2;

/// A uniform grid of cells, each with the numbers of what touches it, in order.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    /// Lower left corner.
    pub low: DVec2,
    /// Width of a cell, metres.
    pub width: f64,
    /// Cells a metre.
    inverse: f64,
    /// How many side by side.
    pub columns: usize,
    /// How many one above the other.
    pub rows: usize,
    /// Where the items of each cell begin, and where the last ones end.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Cells {
    /// Cells of this width that cover a box, with nothing in them.
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

    /// Puts items into cells, given as (cell, item).
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

    /// Column and row of the cell of a point, give or take rounding, or the nearest one.
    pub fn place(&self, at: DVec2) -> (usize, usize) {
        let cell = (at - self.low) * self.inverse;
        ((cell.x.max(0.0) as usize).min(self.columns - 1), (cell.y.max(0.0) as usize).min(self.rows - 1))
    }

    /// The cell of a point, or the nearest one.
    pub fn cell_of(&self, at: DVec2) -> usize {
        let (column, row) = self.place(at);
        row * self.columns + column
    }

    /// The corners of a cell, lower left and upper right.
    pub fn square(&self, cell: usize) -> (DVec2, DVec2) {
        let low = self.low + DVec2::new((cell % self.columns) as f64, (cell / self.columns) as f64) * self.width;
        (low, low + self.width)
    }

    /// The rows of cells that a box touches, each with its lower side.
    pub fn rows_of(&self, from: DVec2, to: DVec2) -> impl Iterator<Item = (f64, usize)> + use<> {
        let (low, width) = (self.low.y, self.width);
        (self.place(from).1..=self.place(to).1).map(move |row| (low + row as f64 * width, row))
    }

    /// The columns of cells between two places along x.
    pub fn columns_of(&self, left: f64, right: f64) -> std::ops::RangeInclusive<usize> {
        let column = |x: f64| self.place(DVec2::new(x, self.low.y)).0;
        column(left)..=column(right)
    }

    /// The cells that a box touches, row by row.
    pub fn touched(&self, from: DVec2, to: DVec2) -> impl Iterator<Item = usize> + use<> {
        let ((left, bottom), (right, top)) = (self.place(from), self.place(to));
        let columns = self.columns;
        (bottom..=top).flat_map(move |row| (left..=right).map(move |column| row * columns + column))
    }

    /// What is in a cell.
    pub fn items(&self, cell: usize) -> &[u32] {
        &self.items[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }
}
