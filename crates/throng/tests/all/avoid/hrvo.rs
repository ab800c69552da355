//! Hybrid reciprocal velocity obstacles, compared with Snape, van den Berg, Guy, Manocha, T-RO 2011.

use crate::avoid::common::{choose_freely, other, vector, view};
use glam::Vec2;
use proptest::prelude::*;
use throng::avoid::{AvoidanceReason, Forbidden, Hrvo, LocalModel, Workspace, time_to_disc};

proptest! {
    /// The apex is the intersection of a leg of the reciprocal velocity obstacle with the other leg of the plain one:
    /// on the left leg of the former for an agent that passes on the left.
    #[test]
    fn the_apex_lies_on_both_legs(offset in vector(4.0), a in vector(1.5), b in vector(1.5)) {
        prop_assume!(offset.length() > 0.5 && (a - b).length() > 0.05);
        prop_assume!(offset.perp_dot(a - b).abs() > 1e-3);
        let seen = [other(offset, b, 0.4, 0.5)];
        let reasons = Hrvo::default().explain(&view(a, a, 1.5, &seen), &mut Workspace::default());
        let [AvoidanceReason::Forbids(_, Forbidden::Cone { apex, .. })] = reasons[..] else { panic!("{reasons:?}") };
        let half_angle = (0.4 / offset.length()).asin();
        let leg = |side: f32| Vec2::from_angle(side * half_angle).rotate(offset.normalize());
        let passes_left = offset.perp_dot(a - b) > 0.0;
        let (reciprocal, plain) = if passes_left { (leg(1.0), leg(-1.0)) } else { (leg(-1.0), leg(1.0)) };
        prop_assert!((apex - (a + b) / 2.0).perp_dot(reciprocal).abs() < 1e-3, "on the leg of the reciprocal one");
        prop_assert!((apex - b).perp_dot(plain).abs() < 1e-3, "on the leg of the plain one");
    }

    /// Two agents that both leave their hybrid obstacles by the nearest way do not collide, and pass on the same side.
    #[test]
    fn two_hybrids_agree(offset in vector(4.0), a in vector(1.4), aside in -0.99f32..0.99, speed in 0.2f32..2.8) {
        prop_assume!(offset.length() > 0.5 && aside.abs() > 1e-2);
        // on a collision course, somewhere in the cone
        let course = Vec2::from_angle(aside * (0.4 / offset.length()).asin()).rotate(offset.normalize()) * speed;
        let b = a - course;
        let model = Hrvo::default();
        let new_a = choose_freely(&model, a, a, &[other(offset, b, 0.4, 0.5)]);
        let new_b = choose_freely(&model, b, b, &[other(-offset, a, 0.4, 0.5)]);
        prop_assert_eq!(time_to_disc(offset, new_a - new_b, 0.4 * 0.995), f32::INFINITY);
        prop_assert!(offset.perp_dot(new_a - new_b) * offset.perp_dot(a - b) > 0.0, "they changed sides");
    }
}
