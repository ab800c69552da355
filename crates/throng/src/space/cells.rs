//! Items sorted into square cells of the plane, for queries by place.

use glam::DVec2;

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

/// A list of the numbers of the items that touch each cell, in ascending order.
#[derive(Clone, Debug, Default)]
pub struct Lists {
    /// Start of each cell's items, and the end of the last cell's. Empty if no cell has items.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// Returns the lists of a number of cells, from pairs of (cell, item).
    pub fn new(cells: usize, mut pairs: Vec<(u32, u32)>) -> Self {
        if pairs.is_empty() {
            return Self::default();
        }
        pairs.sort_unstable();
        let mut starts = vec![0; cells + 1];
        for &(cell, _) in &pairs {
            starts[cell as usize + 1] += 1;
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        Self { starts, items: pairs.into_iter().map(|(_, item)| item).collect() }
    }

    /// Returns the items of a cell.
    pub fn of(&self, cell: usize) -> &[u32] {
        match self.starts.get(cell..=cell + 1) {
            Some(&[start, end]) => &self.items[start as usize..end as usize],
            _ => &[],
        }
    }
}

/// Square cells of the ground with a list of items each.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    /// The cells.
    pub squares: Squares,
    lists: Lists,
}

impl Cells {
    /// Returns cells with lists, from pairs of (cell, item).
    pub fn new(squares: Squares, pairs: Vec<(u32, u32)>) -> Self {
        let lists = Lists::new(squares.count(), pairs);
        Self { squares, lists }
    }

    /// Returns the items of a cell.
    pub fn items(&self, cell: usize) -> &[u32] {
        self.lists.of(cell)
    }

    /// Returns the items of the cell of a point, or of the nearest cell.
    pub fn items_at(&self, at: DVec2) -> &[u32] {
        self.items(self.squares.cell_of(at))
    }
}
