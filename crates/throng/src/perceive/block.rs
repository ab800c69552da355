//! Blocks: crowded cells, divided at medians.

use glam::Vec2;

/// Maximum number of points of a block that is not divided.
pub(super) const LEAF: usize = 24;

/// A tight box around a range of points.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointBlock {
    pub low: Vec2,
    pub high: Vec2,
    pub least_number: u32,
    pub start: u32,
    pub end: u32,
    /// Index of the first of its two halves; 0 if the block is not divided.
    pub halves: u32,
}

/// The coordinates of a point, its number and its row.
pub(super) type Point = (f32, f32, u32, u32);

/// Points with their numbers and rows, as columns that are sorted together.
pub(super) struct Points<'a> {
    pub x: &'a mut [f32],
    pub y: &'a mut [f32],
    pub numbers: &'a mut [u32],
    pub rows: &'a mut [u32],
}

impl PointBlock {
    /// Returns the squared distance to the box. Rounding is monotonic, hence it never exceeds the computed distance to
    /// a point in the box.
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

/// Adds a block of the points from `start` to `end` to `blocks`. The block is halved at medians across its longer side
/// (by number where all points coincide) until no part has more than [`LEAF`] points. `part` is scratch memory.
pub(super) fn divide(
    blocks: &mut Vec<PointBlock>,
    start: u32,
    end: u32,
    points: &mut Points<'_>,
    part: &mut Vec<Point>,
) {
    let first = blocks.len();
    blocks.push(PointBlock::round(points, start, end));
    let mut at = first;
    while at < blocks.len() {
        let PointBlock { low, high, start, end, .. } = blocks[at];
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
            blocks.push(PointBlock::round(points, start, middle));
            blocks.push(PointBlock::round(points, middle, end));
        }
        at += 1;
    }
}
