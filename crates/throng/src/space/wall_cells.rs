//! Cells of the ground with the walls near them, for queries by place.
//!
//! Cells are in square blocks. A block is filled when a query first comes to it, so cells take memory and time only near
//! agents, however large the place is: a world of a division has the cells of its own ground. The cells do not depend
//! on when they are filled.

use super::cells::{Cells, Squares, around, lists};
use super::walls::WallShapes;
use glam::DVec2;
use std::ops::Range;
use std::sync::OnceLock;

/// Distance from a cell up to which it lists walls, metres. With it, queries of pedestrians need only one cell.
pub(super) const REACH: f64 = 2.25;

/// Width of a cell, metres.
const CELL: f64 = 2.0;
/// Cells along each side of a block.
const BLOCK: usize = 32;
const CELLS: usize = BLOCK * BLOCK;
/// Maximum number of blocks. Cells are wider if there would be more.
const MOST_BLOCKS: f64 = 1e6;

/// Cells of the ground with the walls near them.
#[derive(Clone, Debug, Default)]
pub(super) struct WallCells {
    squares: Squares,
    /// The walls near each block.
    near_blocks: Cells,
    blocks: Vec<OnceLock<Box<Block>>>,
}

/// The cells of a block.
#[derive(Clone, Debug)]
struct Block {
    /// A lower bound of the distance between each cell and the nearest of its walls, metres; infinite if there are none.
    clearance: [f32; CELLS],
    /// The walls within `REACH` of each cell: the start of its walls, and the end of the last cell's.
    starts: [u32; CELLS + 1],
    walls: Vec<u32>,
}

/// A cell and the walls near it.
#[derive(Clone, Copy)]
pub(super) struct WallCell<'a> {
    block: &'a Block,
    /// Index in the block.
    cell: usize,
}

impl<'a> WallCell<'a> {
    /// Returns the walls within `REACH` of the cell, and perhaps others, by number.
    #[inline]
    pub fn walls(&self) -> &'a [u32] {
        let [start, end] = [self.cell, self.cell + 1].map(|cell| self.block.starts[cell] as usize);
        &self.block.walls[start..end]
    }

    /// Returns a lower bound of the distance between the cell and the nearest wall, metres; infinite if there is none
    /// within `REACH`.
    #[inline]
    pub fn clearance(&self) -> f64 {
        self.block.clearance[self.cell].into()
    }
}

impl WallCells {
    /// Returns the cells around these walls, with no block filled yet.
    pub fn new(walls: &WallShapes) -> Self {
        let boxes = (0..walls.count()).map(|wall| walls.bounds(wall));
        let Some((low, high)) = around(boxes) else { return Self::default() };
        let blocks = Squares::at_most(MOST_BLOCKS, low, high, CELL * BLOCK as f64);
        let squares = Squares::new(low, high, blocks.width / BLOCK as f64);
        let mut pairs = Vec::new();
        for wall in 0..walls.count() {
            // farther than the cells of the block, for the rounding of their positions
            let all = (0..blocks.columns, 0..blocks.rows);
            touch(walls, wall, REACH + 1e-3, (&blocks, all), |(column, row)| {
                pairs.push(((row * blocks.columns + column) as u32, wall as u32));
            });
        }
        let all = std::iter::repeat_with(OnceLock::new).take(blocks.count()).collect();
        Self { squares, near_blocks: Cells::new(blocks, pairs), blocks: all }
    }

    /// Returns the cell of a point, or the nearest cell. There must be walls.
    #[inline]
    pub fn at(&self, walls: &WallShapes, point: DVec2) -> WallCell<'_> {
        self.cell(walls, self.squares.place(point))
    }

    /// Calls `see` for the cells that a box touches, row by row. There must be walls.
    pub fn each_touched<'a>(
        &'a self,
        walls: &WallShapes,
        (from, to): (DVec2, DVec2),
        mut see: impl FnMut(WallCell<'a>),
    ) {
        let ((left, bottom), (right, top)) = (self.squares.place(from), self.squares.place(to));
        for row in bottom..=top {
            let mut column = left;
            while column <= right {
                let first = self.cell(walls, (column, row));
                let count = (BLOCK - column % BLOCK).min(right + 1 - column);
                (first.cell..first.cell + count).for_each(|cell| see(WallCell { cell, ..first }));
                column += count;
            }
        }
    }

    #[inline]
    fn cell(&self, walls: &WallShapes, (column, row): (usize, usize)) -> WallCell<'_> {
        let block = row / BLOCK * self.near_blocks.squares.columns + column / BLOCK;
        let block = self.blocks[block].get_or_init(|| self.fill(walls, block));
        WallCell { block, cell: row % BLOCK * BLOCK + column % BLOCK }
    }

    /// Returns the cells of a block.
    #[cold]
    fn fill(&self, walls: &WallShapes, block: usize) -> Box<Block> {
        let across = self.near_blocks.squares.columns;
        let (left, bottom) = (block % across * BLOCK, block / across * BLOCK);
        let own = || (left..left + BLOCK, bottom..bottom + BLOCK);
        let mut filled =
            Box::new(Block { clearance: [f32::INFINITY; CELLS], starts: [0; CELLS + 1], walls: Vec::new() });
        let mut pairs = Vec::new();
        for &wall in self.near_blocks.items(block) {
            // slightly farther, for the rounding of cell positions
            touch(walls, wall as usize, REACH + 1e-6, (&self.squares, own()), |(column, row)| {
                let cell = (row - bottom) * BLOCK + column - left;
                pairs.push((cell as u32, wall));
                // minus the rounding of cell positions
                let gap = (walls.gap(self.squares.square((column, row)), wall as usize) - 1e-3) as f32;
                filled.clearance[cell] = filled.clearance[cell].min(gap);
            });
        }
        filled.walls = lists(pairs, &mut filled.starts);
        filled
    }
}

/// Calls `found` for the cells within `reach` of a wall, in these columns and rows: row by row, for long slanting edges.
fn touch(
    walls: &WallShapes,
    wall: usize,
    reach: f64,
    (squares, (columns, rows)): (&Squares, (Range<usize>, Range<usize>)),
    mut found: impl FnMut((usize, usize)),
) {
    let (low, high) = walls.bounds(wall);
    let ((_, first), (_, last)) = (squares.place(low - reach), squares.place(high + reach));
    for row in first.max(rows.start)..(last + 1).min(rows.end) {
        let bottom = squares.low.y + row as f64 * squares.width;
        let (left, right) = walls.span(wall, (bottom - reach, bottom + squares.width + reach));
        let column = |x: f64| squares.place(DVec2::new(x, squares.low.y)).0;
        for column in column(left - reach).max(columns.start)..(column(right + reach) + 1).min(columns.end) {
            found((column, row));
        }
    }
}
