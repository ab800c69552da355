//! Cores of the bodies at the start of a step.

use super::GuardedBodies;
use crate::parallel::{self, WORD, Words};
use crate::simd::ones;
use crate::space::Core;
use glam::{DVec2, Vec2};

/// Cores of the bodies at the start of a step. Only cores of bodies that are not discs are stored.
#[derive(Clone, Debug, Default)]
pub(super) struct Cores {
    kept: Vec<(u32, Core)>,
    /// Per block of 64 rows, the rows that are not discs, one bit per row; empty if all bodies are discs.
    long: Vec<u64>,
    /// Per block of 64 rows, the number of cores stored for the blocks before it.
    before: Vec<u32>,
}

impl Cores {
    pub fn rebuild(&mut self, bodies: &GuardedBodies<'_>) {
        let Self { kept, long, before } = self;
        kept.clear();
        long.clear();
        before.clear();
        if bodies.cores.uniform() == Some(Vec2::ZERO) {
            return;
        }
        let rows = bodies.positions.len();
        long.resize(rows.div_ceil(WORD), 0);
        parallel::ranges(Words(long), |range, Words(long)| {
            for (first, long) in range.step_by(WORD).zip(long) {
                let all = first..rows.min(first + WORD);
                *long = all.rev().fold(0, |long, row| long << 1 | u64::from(!bodies.is_disc(row)));
            }
        });
        let origin = Core::point(DVec2::ZERO);
        for (first, &long) in (0..).step_by(WORD).zip(&*long) {
            before.push(kept.len() as u32);
            kept.extend(ones(long).map(|at| ((first + at) as u32, origin)));
        }
        parallel::ranges(&mut kept[..], |_, kept| {
            for (row, core) in kept {
                let row = *row as usize;
                *core = Core::new(bodies.positions[row].as_dvec2(), bodies.headings[row], bodies.cores[row]);
            }
        });
    }

    pub fn of(&self, row: usize, bodies: &GuardedBodies<'_>) -> Core {
        if bodies.is_disc(row) {
            return Core::point(bodies.positions[row].as_dvec2());
        }
        let (part, before) = (row / WORD, (1 << (row % WORD)) - 1);
        self.kept[self.before[part] as usize + (self.long[part] & before).count_ones() as usize].1
    }
}
