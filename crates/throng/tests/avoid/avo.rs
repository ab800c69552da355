//! Acceleration-velocity obstacles against the motion law they are made from.

use crate::common::{other, vector, view};
use glam::{DVec2, Vec2};
use proptest::prelude::*;
use throng::avoid::{Avo, Line, LocalModel, Reason, Workspace};

/// The half-plane that the other leaves.
fn line(avo: &Avo, velocity: Vec2, offset: Vec2, theirs: Vec2, share: f32) -> Line {
    let seen = [other(offset, theirs, 0.4, share)];
    match avo.explain(&view(velocity, velocity, 1.5, &seen), &mut Workspace::default())[..] {
        [Reason::Permits(_, line)] => line,
        ref other => panic!("{other:?}"),
    }
}

/// The point of the half-plane nearest to `v`.
fn permitted(line: Line, v: Vec2) -> Vec2 {
    v + line.direction.perp() * line.violation(v).max(0.0)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Whatever shares two have, and whatever they take of what they leave each other: integrated in small steps, the
    /// motion keeps them apart for the horizon.
    #[test]
    fn a_pair_is_free_for_the_horizon(
        offset in vector(5.0), a in vector(1.5), b in vector(1.5), wish_a in vector(1.5), wish_b in vector(1.5),
        share in 0.0f32..=1.0, delay in 0.05f32..1.0,
    ) {
        let avo = Avo { delay, ..Avo::default() };
        prop_assume!(offset.length() > 0.42);
        // who cannot even be stopped in time is beyond all models: the velocities they have now take them together
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
