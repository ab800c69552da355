//! A velocity for every row, in space.

use crate::lanes::from_side_by_side;
use crate::parallel::Lists;
use fearless_simd::prelude::*;
use glam::{Vec2, Vec3};
use std::ops::Range;

/// A velocity for every row. While nobody leaves the ground, what is upwards takes no memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Velocities {
    /// Along the ground.
    pub ground: Vec<Vec2>,
    /// Upwards; nothing if it is 0 for everybody.
    climb: Vec<f32>,
}

/// Those of some rows, to be written.
pub(super) type Rows<'a> = (&'a mut [Vec2], Lists<'a, f32>);

impl Velocities {
    /// Makes room for those of so many rows, in space or on the ground.
    pub fn resize(&mut self, rows: usize, in_space: bool) {
        self.ground.resize(rows, Vec2::ZERO);
        self.climb.resize(if in_space { rows } else { 0 }, 0.0);
    }

    /// All of them, to be written.
    pub fn rows(&mut self) -> Rows<'_> {
        let stride = usize::from(!self.climb.is_empty());
        (&mut self.ground, Lists { all: &mut self.climb, stride })
    }

    /// Upwards.
    #[inline]
    pub fn climb(&self, row: usize) -> f32 {
        self.climb.get(row).copied().unwrap_or(0.0)
    }

    /// Whether anybody may go up or down.
    pub fn is_in_space(&self) -> bool {
        !self.climb.is_empty()
    }

    /// Upwards, of a vector of rows.
    #[inline(always)]
    pub fn climbs<S: Simd>(&self, simd: S, rows: Range<usize>) -> S::f32s {
        self.climb.get(rows).map_or(S::f32s::splat(simd, 0.0), |climbs| from_side_by_side(simd, climbs))
    }

    /// That of a row.
    #[inline]
    pub fn at(&self, row: usize) -> Vec3 {
        self.ground[row].extend(self.climb(row))
    }
}

/// Sets one of some rows.
#[inline]
pub(super) fn set((ground, climb): &mut Rows<'_>, at: usize, velocity: Vec3) {
    ground[at] = velocity.truncate();
    if let Some(climb) = climb.all.get_mut(at) {
        *climb = velocity.z;
    }
}
