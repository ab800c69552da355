//! Items sorted into square cells of the plane, for queries by place.

use glam::DVec2;

/// Returns the lower and upper corners of the box around boxes; `None` if there are none.
pub fn around(boxes: impl IntoIterator<Item = (DVec2, DVec2)>) -> Option<(DVec2, DVec2)> {
    boxes.into_iter().reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
}

/// Square cells of the ground.
#[derive(Clone, Debug, Default)]
pub struct Squares {
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
}

impl Squares {
    /// Returns cells of this width that cover a box.
    pub fn new(low: DVec2, high: DVec2, width: f64) -> Self {
        let size = high - low;
        let (columns, rows) = ((size.x / width) as usize + 1, (size.y / width) as usize + 1);
        Self { low, width, inverse: width.recip(), columns, rows }
    }

    /// As [`new`](Self::new), with cells of the least width `width` * 2^n of which there are at most `most`.
    pub fn at_most(most: f64, low: DVec2, high: DVec2, mut width: f64) -> Self {
        let size = high - low;
        while (size.x / width + 1.0) * (size.y / width + 1.0) > most {
            width *= 2.0;
        }
        Self::new(low, high, width)
    }

    /// Returns the number of cells.
    pub fn count(&self) -> usize {
        self.columns * self.rows
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

    /// Returns the lower left and upper right corners of the cell in a column and a row.
    pub fn square(&self, (column, row): (usize, usize)) -> (DVec2, DVec2) {
        let low = self.low + DVec2::new(column as f64, row as f64) * self.width;
        (low, low + self.width)
    }

    /// Returns the columns and rows of the cells that a box touches, row by row.
    pub fn places(&self, from: DVec2, to: DVec2) -> impl Iterator<Item = (usize, usize)> + use<> {
        let ((left, bottom), (right, top)) = (self.place(from), self.place(to));
        (bottom..=top).flat_map(move |row| (left..=right).map(move |column| (column, row)))
    }

    /// Returns the cells that a box touches, row by row.
    pub fn touched(&self, from: DVec2, to: DVec2) -> impl Iterator<Item = usize> + use<> {
        let columns = self.columns;
        self.places(from, to).map(move |(column, row)| row * columns + column)
    }
}

/// Sorts pairs of (cell, item) into lists of the items of each cell, in ascending order. Returns the items of all cells, and
/// sets `starts` to the start of each cell's items and the end of the last cell's.
pub fn lists(mut pairs: Vec<(u32, u32)>, starts: &mut [u32]) -> Vec<u32> {
    pairs.sort_unstable();
    starts.fill(0);
    for &(cell, _) in &pairs {
        starts[cell as usize + 1] += 1;
    }
    for cell in 1..starts.len() {
        starts[cell] += starts[cell - 1];
    }
    pairs.into_iter().map(|(_, item)| item).collect()
}

/// Square cells of the ground with a list of items each.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    /// The cells.
    pub squares: Squares,
    /// Start of each cell's items, and the end of the last cell's.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Cells {
    /// Returns cells with lists, from pairs of (cell, item).
    pub fn new(squares: Squares, pairs: Vec<(u32, u32)>) -> Self {
        let mut starts = vec![0; squares.count() + 1];
        let items = lists(pairs, &mut starts);
        Self { squares, starts, items }
    }

    /// Returns the items of a cell.
    pub fn items(&self, cell: usize) -> &[u32] {
        &self.items[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    /// Returns the items of the cell of a point, or of the nearest cell.
    pub fn items_at(&self, at: DVec2) -> &[u32] {
        self.items(self.squares.cell_of(at))
    }
}
