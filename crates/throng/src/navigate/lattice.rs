//! The lattice of all boolean operations on floor plans: whole multiples of 2^-24 m (60 nm).
//!
//! The step does not depend on the size of the plan. So a mesh does not change when a distant object is added, and
//! every lattice point is an exact f64 in metres.

use glam::DVec2;
use i_overlay::i_float::int::point::IntPoint;

/// A point of the lattice.
pub(super) type LatticePoint = IntPoint<i64>;

/// Lattice steps in a metre.
pub(super) const PER_METRE: f64 = 16_777_216.0;

/// Maximum side of a plan, metres. It keeps coordinates below 2^45 steps, so that their products do not overflow.
pub(super) const WIDEST: f64 = 1_000_000.0;

/// The position of the lattice.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lattice {
    base: DVec2,
}

impl Lattice {
    /// Creates a lattice for points near `centre`.
    pub fn near(centre: DVec2) -> Self {
        Self { base: DVec2::new(centre.x.round(), centre.y.round()) }
    }

    /// Returns the nearest lattice point.
    pub fn point(&self, at: DVec2) -> LatticePoint {
        round((at - self.base) * PER_METRE)
    }

    /// Returns the position of a lattice point, metres.
    pub fn metres(&self, point: LatticePoint) -> DVec2 {
        self.base + steps(point) * (1.0 / PER_METRE)
    }
}

/// Returns the lattice point nearest to `at`, which is in steps.
pub(super) fn round(at: DVec2) -> LatticePoint {
    IntPoint::new(at.x.round() as i64, at.y.round() as i64)
}

/// Returns a lattice point as a vector, in steps. Exact.
pub(super) fn steps(point: LatticePoint) -> DVec2 {
    DVec2::new(point.x as f64, point.y as f64)
}

/// Returns twice the area of the triangle a, b, c: positive when it turns left. Exact.
pub(super) fn turn(a: LatticePoint, b: LatticePoint, c: LatticePoint) -> i128 {
    let (ux, uy) = (i128::from(b.x - a.x), i128::from(b.y - a.y));
    let (vx, vy) = (i128::from(c.x - a.x), i128::from(c.y - a.y));
    ux * vy - uy * vx
}
