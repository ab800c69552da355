//! Forbidden regions, compared with their definition, and ClearPath's enumeration, compared with a dense search.

use crate::avoid::common::{grid, other, vector};
use glam::{DVec2, Vec2};
use proptest::prelude::*;
use std::f32::consts::TAU;
use throng::avoid::{Forbidden, HalfPlane, closest_outside, time_to_disc};

/// A random region of any kind.
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
            Forbidden::RightOf(HalfPlane { point: direction.perp() * distance, direction })
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

/// Beside two standing agents, the choice is the crossing of the rounded ends of both regions, by the circles'
/// equation.
#[test]
fn before_two_agents_that_stand_the_choice_is_where_the_rounded_ends_cross() {
    for (angle, radii, turn) in
        [([0.2f64, -0.3], [0.9, 0.9], 0.0), ([0.3, -0.25], [1.0, 0.8], 2.0), ([0.25, -0.2], [0.7, 0.9], 4.0)]
    {
        let centers = angle.map(|angle| DVec2::from_angle(angle + turn) * 2.0);
        // half of the offset and of the radii: the horizon is 2 s
        let ([a, b], [r, s]) = (centers.map(|center| center * 0.5), radii.map(|radius| radius * 0.5));
        let (between, distance) = ((b - a).normalize(), a.distance(b));
        let along = (distance * distance + r * r - s * s) / (2.0 * distance);
        let across = between.perp() * (r * r - along * along).sqrt();
        let crossing = [across, -across].map(|across| a + between * along + across);
        let expected = crossing.into_iter().min_by(|p, q| p.length().total_cmp(&q.length())).unwrap();
        let regions = [0, 1].map(|k| {
            let stands = other(centers[k].as_vec2(), Vec2::ZERO, radii[k] as f32, 1.0);
            Forbidden::truncated(Vec2::ZERO, &stands, 2.0, 0.02)
        });
        let preferred = DVec2::from_angle(expected.to_angle()) * 1.1;
        let chosen = closest_outside(&regions, 1.5, preferred.as_vec2());
        assert!(chosen.as_dvec2().distance(expected) < 1e-3, "{chosen}, not {expected}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// The moved apex of the reciprocal velocity obstacle is the same set as the velocity that is tested (van den Berg,
    /// Lin, Manocha, ICRA 2008). With a share of 1 it is the plain velocity obstacle.
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
