//! Acceleration-velocity obstacles, compared with the motion law that they are derived from.

use crate::avoid::common::{other, vector, view};
use glam::{DVec2, Vec2};
use proptest::prelude::*;
use throng::avoid::{Avo, AvoidanceReason, HalfPlane, LocalModel, Workspace};

/// The half-plane of one neighbour.
fn line(avo: &Avo, velocity: Vec2, offset: Vec2, theirs: Vec2, share: f32) -> HalfPlane {
    let seen = [other(offset, theirs, 0.4, share)];
    match avo.explain(&view(velocity, velocity, 1.5, &seen), &mut Workspace::default())[..] {
        [AvoidanceReason::Permits(_, line)] => line,
        ref other => panic!("{other:?}"),
    }
}

/// The point of the half-plane nearest to `v`.
fn permitted(line: HalfPlane, v: Vec2) -> Vec2 {
    v + line.direction.perp() * line.violation(v).max(0.0)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// For any shares of a pair and any permitted velocities: the motion, integrated in small steps, keeps the pair
    /// apart for the horizon.
    #[test]
    fn a_pair_is_free_for_the_horizon(
        offset in vector(5.0), a in vector(1.5), b in vector(1.5), wish_a in vector(1.5), wish_b in vector(1.5),
        share in 0.0f32..=1.0, delay in 0.05f32..1.0,
    ) {
        let avo = Avo { delay, ..Avo::default() };
        prop_assume!(offset.length() > 0.42);
        // no model helps a pair that cannot stop in time: their present velocities lead to a collision
        let new_a = permitted(line(&avo, a, offset, b, share), wish_a);
        let new_b = permitted(line(&avo, b, -offset, a, 1.0 - share), wish_b);
        const PARTS: usize = 4000;
        let step = f64::from(avo.time_horizon) / PARTS as f64;
        let (mut distance, mut between, mut relative) = (f64::INFINITY, offset.as_dvec2(), (a - b).as_dvec2());
        let keep = (-step / f64::from(delay)).exp();
        for _ in 0..PARTS {
            let new: DVec2 = (new_a - new_b).as_dvec2();
            let next = new - (new - relative) * keep;
            between -= (relative + next) * (0.5 * step);
            relative = next;
            distance = distance.min(between.length());
        }
        prop_assert!(distance >= 0.4 * 0.99, "{distance}");
    }
}
