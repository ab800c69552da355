//! Forbidden regions against their definition, and ClearPath's enumeration against a dense search.

use crate::common::{grid, other, vector};
use glam::Vec2;
use proptest::prelude::*;
use std::f32::consts::TAU;
use throng::avoid::{Forbidden, Line, closest_outside, time_to_disc};

/// A region of each kind, from anywhere.
fn region() -> impl Strategy<Value = Forbidden> {
    prop_oneof![
        (vector(1.5), 0.0..TAU, 0.2f32..2.8).prop_map(|(apex, axis, opening)| Forbidden::Cone {
            apex,
            right: Vec2::from_angle(axis - opening / 2.0),
            left: Vec2::from_angle(axis + opening / 2.0),
        }),
        (vector(4.0), vector(1.5), vector(1.5), 0.1f32..1.0, 0.3f32..4.0).prop_filter_map(
            "they overlap",
            |(offset, a, b, share, horizon)| (offset.length() > 0.5).then(|| Forbidden::truncated(
                a,
                &other(offset, b, 0.4, share),
                horizon,
                0.02
            ))
        ),
        (0.0..TAU, -1.0f32..0.5).prop_map(|(angle, distance)| {
            let direction = Vec2::from_angle(angle);
            Forbidden::RightOf(Line { point: direction.perp() * distance, direction })
        }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn it_finds_the_best_of_all(regions in prop::collection::vec(region(), 0..8), preferred in vector(1.5)) {
        let chosen = closest_outside(&regions, 1.5, preferred);
        let preferred = preferred.clamp_length_max(1.5);
        let free = |v: Vec2| regions.iter().all(|region| region.depth(v) <= 0.0);
        let best = grid(1.5).filter(|&v| free(v)).map(|v| v.distance(preferred)).fold(f32::INFINITY, f32::min);
        prop_assert!(chosen.length() <= 1.5 * 1.001);
        if best.is_finite() {
            prop_assert!(regions.iter().all(|region| region.depth(chosen) <= 2e-4), "{chosen} is forbidden");
            prop_assert!(chosen.distance(preferred) <= best + 1e-3, "{} {best}", chosen.distance(preferred));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// MODELS 1.2: the moved apex is the same set as the velocity that is judged. With a share of 1 it is the plain
    /// velocity obstacle.
    #[test]
    fn a_velocity_is_forbidden_if_what_both_then_have_collides_in_time(
        offset in vector(4.0), a in vector(1.5), b in vector(1.5), v in vector(3.0), share in 0.1f32..=1.0,
        horizon in 0.3f32..5.0, full in any::<bool>(),
    ) {
        let share = if full { 1.0 } else { share };
        prop_assume!(offset.length() > 0.42);
        let depth = Forbidden::truncated(a, &other(offset, b, 0.4, share), horizon, 0.02).depth(v);
        // on the border rounding decides
        prop_assume!(depth.abs() > 1e-4);
        let judged = v / share + a * (1.0 - 1.0 / share) - b;
        prop_assert_eq!(depth > 0.0, time_to_disc(offset, judged, 0.4) < horizon);
    }
}
