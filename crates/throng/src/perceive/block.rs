//! Blocks: crowded cells, divided by medians.

use glam::Vec2;

/// Points a block holds at most before it is divided.
pub(super) const LEAF: usize = 24;

/// A tight box with the points in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    pub low: Vec2,
    pub high: Vec2,
    pub least_number: u32,
    pub start: u32,
    pub end: u32,
    /// First of its two halves; 0 if it is not divided.
    pub halves: u32,
}

/// A point, its number and row.
pub(super) type Point = (f32, f32, u32, u32);

/// Points with their numbers and rows, in columns that are sorted together.
pub(super) struct Points<'a> {
    pub x: &'a mut [f32],
    pub y: &'a mut [f32],
    pub numbers: &'a mut [u32],
    pub rows: &'a mut [u32],
}

impl Block {
    /// Square of the distance to the box. Rounding is monotonic, hence it never exceeds the computed distance to a point
    /// in it.
    pub fn distance_squared(&self, from: Vec2) -> f32 {
        let d = (self.low - from).max(from - self.high).max(Vec2::ZERO);
        d.x * d.x + d.y * d.y
    }

    fn round(points: &Points<'_>, start: u32, end: u32) -> Self {
        let range = start as usize..end as usize;
        let bounds =
            |all: &[f32]| all.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(l, h), &p| (l.min(p), h.max(p)));
        let ((left, right), (bottom, top)) = (bounds(&points.x[range.clone()]), bounds(&points.y[range.clone()]));
        let least_number = points.numbers[range].iter().copied().min().unwrap_or(0);
        Self { low: Vec2::new(left, bottom), high: Vec2::new(right, top), least_number, start, end, halves: 0 }
    }
}

/// Puts a block of the points from `start` to `end` into `blocks`, halved at medians across its longer sides (by number
/// where all points coincide) until no part holds many. `part` is memory.
pub(super) fn divide(blocks: &mut Vec<Block>, start: u32, end: u32, points: &mut Points<'_>, part: &mut Vec<Point>) {
    let first = blocks.len();
    blocks.push(Block::round(points, start, end));
    let mut at = first;
    while at < blocks.len() {
        let Block { low, high, start, end, .. } = blocks[at];
        if (end - start) as usize > LEAF {
            let size = high - low;
            let range = start as usize..end as usize;
            part.clear();
            part.extend(range.clone().map(|k| (points.x[k], points.y[k], points.numbers[k], points.rows[k])));
            let axis = |p: &Point| if size.x >= size.y { p.0 } else { p.1 };
            let middle = part.len() / 2;
            part.select_nth_unstable_by(middle, |a, b| axis(a).total_cmp(&axis(b)).then(a.2.cmp(&b.2)));
            for (k, &(x, y, number, row)) in range.zip(&*part) {
                (points.x[k], points.y[k], points.numbers[k], points.rows[k]) = (x, y, number, row);
            }
            blocks[at].halves = blocks.len() as u32;
            let middle = start + middle as u32;
            blocks.push(Block::round(points, start, middle));
            blocks.push(Block::round(points, middle, end));
        }
        at += 1;
    }
}
