//! Motions of cores over a step, and the test whether two cores keep apart.

use crate::space::{Core, CoreSeparation};
use glam::DVec2;

/// A core that moves and turns at a constant rate over the step.
#[derive(Clone, Copy, Debug)]
pub(super) struct CoreSweep {
    /// The core at the start.
    pub start: Core,
    /// Displacement over the step.
    pub motion: DVec2,
    /// Turn over the step, radians.
    pub turn: f64,
}

/// How often the step is halved in the search for a separating direction.
const HALVINGS: u32 = 4;

impl CoreSweep {
    /// Returns the sweep of a core that stands still.
    pub fn still(start: Core) -> Self {
        Self { start, motion: DVec2::ZERO, turn: 0.0 }
    }

    /// Returns the core at `t`, a fraction of the step.
    pub fn at(&self, t: f64) -> Core {
        let center = self.start.center + self.motion * t;
        if self.turn == 0.0 {
            return Core { center, ..self.start };
        }
        let (sin, cos) = libm::sincos(self.turn * t);
        Core { center, along: DVec2::new(cos, sin).rotate(self.start.along), ..self.start }
    }

    /// Returns the greatest second derivative, by the fraction of the step, of the position of any point of the core
    /// along any direction.
    fn curvature(&self) -> f64 {
        self.start.half.length() * self.turn * self.turn
    }

    /// Returns by how much more than at the start the core extends along `normal` at most, because it turns.
    pub fn growth(&self, normal: DVec2) -> f64 {
        let (start, end) = (self.start.extent(normal), self.at(1.0).extent(normal));
        -start - least_between(-start, -end, self.curvature())
    }

    /// Returns by how much at most the distance of two cores falls over the step.
    pub fn closing(&self, other: &Self) -> f64 {
        let turning = |sweep: &Self| sweep.start.half.length() * sweep.turn.abs();
        (self.motion - other.motion).length() + turning(self) + turning(other)
    }

    /// Whether a cheap test shows that two cores are never nearer than `needed` > 0, rounding included.
    pub fn passes(&self, other: &Self, needed: f64) -> bool {
        self.start.widest_gap(&other.start).distance * (1.0 - 1e-9) - self.closing(other) >= needed
    }

    /// Whether two cores are never nearer than `needed(distance)`, given their distance at the start. The test may
    /// return false for a pair that keeps apart, but never for two cores that stand still.
    pub fn keeps(&self, other: &Self, needed: impl FnOnce(f64) -> f64) -> bool {
        let distance = self.start.separation(&other.start).distance;
        let needed = needed(distance);
        distance - self.closing(other) >= needed || self.keeps_between(other, needed, (0.0, 1.0), HALVINGS)
    }

    fn keeps_between(&self, other: &Self, needed: f64, (from, to): (f64, f64), halvings: u32) -> bool {
        let ends = [from, to].map(|t| (self.at(t), other.at(t)));
        let apart: [CoreSeparation; 2] = ends.map(|(a, b)| a.separation(&b));
        if apart.iter().any(|at| at.distance < needed) {
            return false;
        }
        let part = to - from;
        let curvature = (self.curvature() + other.curvature()) * part * part;
        let along = |normal| {
            let [start, end] = ends.map(|(a, b)| a.gap_along(&b, normal));
            least_between(start, end, curvature) >= needed
        };
        let middle = 0.5 * (from + to);
        apart.iter().any(|at| along(at.normal))
            || halvings > 0
                && self.keeps_between(other, needed, (from, middle), halvings - 1)
                && self.keeps_between(other, needed, (middle, to), halvings - 1)
    }
}

/// Returns the least value that a function can have between `start` and `end` if its second derivative nowhere exceeds
/// `curvature` (the whole interval has length 1): the minimum of the parabola that sags most.
fn least_between(start: f64, end: f64, curvature: f64) -> f64 {
    let change = end - start;
    if change.abs() >= 0.5 * curvature {
        return start.min(end);
    }
    start + 0.5 * change - 0.125 * curvature - 0.5 * change * change / curvature
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;
    use proptest::prelude::*;

    fn sweep() -> impl Strategy<Value = CoreSweep> {
        let extents = (0.0f32..1.5, prop_oneof![Just(0.0f32), 0.0f32..0.75]).prop_map(|(x, y)| Vec2::new(x, y));
        let place = (-2.0..2.0, -2.0..2.0).prop_map(|(x, y)| DVec2::new(x, y));
        let motion = (-1.0..1.0, -1.0..1.0).prop_map(|(x, y)| DVec2::new(x, y));
        (place, -3.0f32..3.0, extents, motion, prop_oneof![Just(0.0), -2.0..2.0]).prop_map(
            |(center, heading, half, motion, turn)| CoreSweep { start: Core::new(center, heading, half), motion, turn },
        )
    }

    fn times() -> impl Iterator<Item = f64> {
        (0..=400).map(|k| f64::from(k) / 400.0)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn cores_reported_to_keep_apart_do(a in sweep(), b in sweep(), part in 0.0..1.0) {
            let needed = a.start.separation(&b.start).distance * part;
            let least = times().map(|t| a.at(t).separation(&b.at(t)).distance).fold(f64::INFINITY, f64::min);
            prop_assert!(needed <= 0.0 || a.keeps(&b, |_| needed) || !a.passes(&b, needed));
            if a.keeps(&b, |_| needed) {
                prop_assert!(least >= needed - 1e-9, "{least} of {needed}");
            } else {
                prop_assert!(least < needed + 0.25, "{least} of {needed} is well apart");
            }
        }

        #[test]
        fn standing_cores_keep_apart_and_growth_bounds_the_extent(a in sweep(), b in sweep(), angle in 0.0..7.0) {
            prop_assert!(CoreSweep::still(a.start).keeps(&CoreSweep::still(b.start), |apart| apart - 1e-7));
            let normal = DVec2::from_angle(angle);
            let most = times().map(|t| a.at(t).extent(normal)).fold(0.0, f64::max);
            prop_assert!(most <= a.start.extent(normal) + a.growth(normal) + 1e-9);
        }
    }
}
