//! Velocities in space, one for each row.

use crate::parallel::RowLists;
use crate::simd::from_side_by_side;
use fearless_simd::prelude::*;
use glam::{Vec2, Vec3};
use std::ops::Range;

/// Velocities in space, one for each row. While no agent leaves the ground, vertical velocities take no memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct Velocities {
    /// Velocities along the ground.
    pub ground: Vec<Vec2>,
    /// Vertical velocities; empty if all are 0.
    vertical_velocity: Vec<f32>,
}

/// Mutable velocities of some rows.
pub(crate) type Rows<'a> = (&'a mut [Vec2], RowLists<'a, f32>);

impl Velocities {
    /// Resizes to this number of rows, in space or on the ground.
    pub fn resize(&mut self, rows: usize, in_space: bool) {
        self.ground.resize(rows, Vec2::ZERO);
        self.vertical_velocity.resize(if in_space { rows } else { 0 }, 0.0);
    }

    /// Returns all velocities, mutable.
    pub fn rows(&mut self) -> Rows<'_> {
        let stride = usize::from(!self.vertical_velocity.is_empty());
        (&mut self.ground, RowLists { all: &mut self.vertical_velocity, stride })
    }

    /// Returns the vertical velocity of a row.
    #[inline]
    pub fn vertical_velocity(&self, row: usize) -> f32 {
        self.vertical_velocity.get(row).copied().unwrap_or(0.0)
    }

    /// Whether any vertical velocity may differ from 0.
    pub fn is_in_space(&self) -> bool {
        !self.vertical_velocity.is_empty()
    }

    /// Returns the vertical velocities of a SIMD vector of rows.
    #[inline(always)]
    pub fn vertical_velocities<S: Simd>(&self, simd: S, rows: Range<usize>) -> S::f32s {
        self.vertical_velocity
            .get(rows)
            .map_or(S::f32s::splat(simd, 0.0), |vertical_velocities| from_side_by_side(simd, vertical_velocities))
    }

    /// Copies the velocities at these indices into some rows.
    pub fn copy(&self, from: &[u32], (ground, vertical_velocity): Rows<'_>) {
        from.iter().zip(ground).for_each(|(&from, to)| *to = self.ground[from as usize]);
        from.iter().zip(vertical_velocity.all).for_each(|(&from, to)| *to = self.vertical_velocity[from as usize]);
    }

    /// Returns the velocity of a row.
    #[inline]
    pub fn at(&self, row: usize) -> Vec3 {
        self.ground[row].extend(self.vertical_velocity(row))
    }
}

/// Sets the velocity at an index of some rows.
#[inline]
pub(crate) fn set((ground, vertical_velocity): &mut Rows<'_>, at: usize, velocity: Vec3) {
    ground[at] = velocity.truncate();
    if let Some(vertical_velocity) = vertical_velocity.all.get_mut(at) {
        *vertical_velocity = velocity.z;
    }
}
