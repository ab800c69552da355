//! Sizes of bodies: how far from its centre each can touch something in the step.

use super::GuardedBodies;
use super::contacts::PAD;
use crate::parallel::{self, WORD, Words};
use glam::Vec2;

/// A body that many rows have. The guard reads nothing of a row that has it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CommonBody {
    core: Vec2,
    radius: f32,
    reach: f32,
    /// Its size.
    pub size: f32,
    /// The distance of the centres at which two of them can touch.
    pub range: f32,
    pub is_disc: bool,
}

/// The bodies of 64 rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct SizeBlock {
    /// Rows that have the common body, one bit per row.
    pub common: u64,
    sum: f64,
    largest: f32,
    least_radius: f32,
}

/// The sizes of all bodies.
#[derive(Clone, Debug, Default)]
pub(super) struct BodySizes {
    /// The common body. No row has it if the bodies are at several altitudes.
    pub common: CommonBody,
    /// By blocks of 64 rows; empty if all rows have the common body.
    pub blocks: Vec<SizeBlock>,
    /// The greatest size that does not exceed twice the mean.
    pub usual: f32,
    /// The rows with a larger size. They are few.
    pub larger: Vec<u32>,
    /// The greatest size.
    pub largest: f32,
    pub least_radius: f32,
}

/// Number of rows, evenly spaced, among which the common body is sought.
const SAMPLES: usize = 16;

impl CommonBody {
    fn of(bodies: &GuardedBodies<'_>, row: usize) -> Self {
        let (bound, reach) = (bodies.bound(row), bodies.reach[row]);
        Self {
            core: bodies.cores[row],
            radius: bodies.radii[row],
            reach,
            size: bound + reach,
            range: (bound + bound + reach + reach) * PAD,
            is_disc: bodies.is_disc(row),
        }
    }

    /// Returns the body that most of a few rows have.
    fn find(bodies: &GuardedBodies<'_>) -> Option<Self> {
        let rows = bodies.positions.len();
        let samples = || (0..SAMPLES).map(|at| at * rows / SAMPLES);
        bodies.altitudes.uniform()?;
        let candidates = samples().map(|row| Self::of(bodies, row));
        candidates.max_by_key(|body| samples().filter(|&row| body.is_of(bodies, row)).count())
    }

    /// Whether a row has this body.
    #[inline]
    fn is_of(&self, bodies: &GuardedBodies<'_>, row: usize) -> bool {
        let (radius, reach) = (bodies.radii[row], bodies.reach[row]);
        bodies.cores[row] == self.core && radius == self.radius && reach == self.reach
    }
}

impl SizeBlock {
    fn of(rows: std::ops::Range<usize>, bodies: &GuardedBodies<'_>, common: Option<CommonBody>) -> Self {
        let mut block = Self { common: 0, sum: 0.0, largest: 0.0, least_radius: f32::INFINITY };
        for (at, row) in rows.enumerate() {
            if common.is_some_and(|common| common.is_of(bodies, row)) {
                block.common |= 1 << at;
            } else {
                block.add(bodies.bound(row) + bodies.reach[row], 1, bodies.radii[row]);
            }
        }
        if let Some(CommonBody { size, radius, .. }) = common.filter(|_| block.common != 0) {
            block.add(size, block.common.count_ones(), radius);
        }
        block
    }

    fn add(&mut self, size: f32, count: u32, radius: f32) {
        self.sum += f64::from(size) * f64::from(count);
        self.largest = self.largest.max(size);
        self.least_radius = self.least_radius.min(radius);
    }
}

impl BodySizes {
    /// Whether all rows have the common body.
    pub fn all_alike(&self) -> bool {
        self.blocks.is_empty()
    }

    /// Measures all bodies.
    pub fn measure(&mut self, bodies: &GuardedBodies<'_>) {
        let Self { common, blocks, usual, larger, largest, least_radius } = self;
        blocks.clear();
        larger.clear();
        let rows = bodies.positions.len();
        if rows == 0 {
            return;
        }
        let found = CommonBody::find(bodies);
        *common = found.unwrap_or_default();
        let GuardedBodies { cores, radii, reach, .. } = bodies;
        let uniform = cores.uniform().and(radii.uniform()).and(reach.uniform());
        if let (Some(CommonBody { size, radius, .. }), Some(_)) = (found, uniform) {
            (*usual, *largest, *least_radius) = (size, size, radius);
            return;
        }
        let rows_of = |first: usize| first..rows.min(first + WORD);
        blocks.resize(rows.div_ceil(WORD), SizeBlock { common: 0, sum: 0.0, largest: 0.0, least_radius: 0.0 });
        parallel::ranges(Words(blocks), |range, Words(blocks)| {
            for (first, block) in range.step_by(WORD).zip(blocks) {
                *block = SizeBlock::of(rows_of(first), bodies, found);
            }
        });
        *least_radius = blocks.iter().map(|block| block.least_radius).fold(f32::INFINITY, f32::min);
        *largest = blocks.iter().map(|block| block.largest).fold(0.0, f32::max);
        let limit = (2.0 * blocks.iter().map(|block| block.sum).sum::<f64>() / rows as f64) as f32;
        *usual = 0.0;
        for (first, block) in (0..rows).step_by(WORD).zip(blocks) {
            if block.largest <= limit {
                *usual = usual.max(block.largest);
                continue;
            }
            for row in rows_of(first) {
                let size = bodies.bound(row) + bodies.reach[row];
                if size > limit {
                    larger.push(row as u32);
                } else {
                    *usual = usual.max(size);
                }
            }
        }
    }
}
