//! Reciprocal velocity obstacles, compared with the paper's penalty.

use crate::avoid::common::{choose, grid, other, vector, view};
use glam::Vec2;
use proptest::prelude::*;
use std::f32::consts::TAU;
use throng::avoid::{
    AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, LocalModel, NearDisc, Outline, Rng, Rvo, Workspace,
    time_to_disc,
};
use throng::space::Disc;

/// The search of the authors' library.
fn drawn() -> Rvo {
    Rvo { time_horizon: f32::INFINITY, braking: true, candidates: 250, ..Rvo::default() }
}

/// The time at which two discs touch, by small steps.
fn first_touch(offset: Vec2, velocity: Vec2) -> f32 {
    let touches = (0..40_000).map(|i| i as f32 * 2e-3).find(|t| (offset - velocity * *t).length() <= 0.4);
    touches.unwrap_or(f32::INFINITY)
}

fn candidates(model: &Rvo, view: &AvoidanceInput<'_>) -> Vec<(Vec2, f32)> {
    let reasons = model.explain(view, &mut Workspace::default());
    reasons
        .iter()
        .filter_map(
            |r| if let AvoidanceReason::Candidate { velocity, cost } = r { Some((*velocity, *cost)) } else { None },
        )
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Section V: weight / time to collision of 2 v' - vA - vB, plus the distance from the preferred velocity.
    #[test]
    fn each_candidate_costs_what_the_paper_says(
        offset in vector(4.0), a in vector(1.2), b in vector(1.2), preferred in vector(1.2), weight in 0.2f32..3.0,
        number in 0u32..1000,
    ) {
        prop_assume!(offset.length() > 0.5);
        let seen = [other(offset, b, 0.4, 0.5)];
        let rng = Rng { seed: 7, number, step: 3 };
        let view = AvoidanceInput { rng, ..view(a, preferred, 1.5, &seen) };
        let model = Rvo { weight, ..drawn() };
        let tried = candidates(&model, &view);
        prop_assert_eq!(tried.len(), 251);
        prop_assert_eq!(tried[0].0, preferred.clamp_length_max(1.5));
        for &(v, cost) in &tried {
            let time = first_touch(offset, v * 2.0 - a - b);
            // the time that the cost implies; a late collision has no weight
            let told = weight / (cost - v.distance(preferred)).max(weight / 60.0);
            // either method may miss glancing touches
            let near = ((v * 2.0 - a - b).normalize().perp_dot(offset).abs() - 0.4).abs() < 2e-3;
            prop_assert!(near || (told - time.min(60.0)).abs() < 4e-3 + 0.01 * time.min(60.0), "{v}: {told} s, {time} s");
        }
        let chosen = model.velocity(&view, &mut Workspace::default());
        let best = tried.iter().map(|c| c.1).fold(f32::INFINITY, f32::min);
        prop_assert_eq!(tried.iter().find(|c| c.1 == best).map(|c| c.0), Some(chosen));
    }

    /// The first ring of the adaptive search covers all directions, to a sixteenth of a turn.
    #[test]
    fn all_directions_are_tried(offset in vector(4.0), velocity in vector(1.2), preferred in vector(1.2)) {
        prop_assume!(offset.length() > 0.5);
        let seen = [other(offset, Vec2::ZERO, 0.4, 0.5)];
        let model = Rvo { candidates: 0, kinodynamic: false, ..Rvo::default() };
        let tried = candidates(&model, &view(velocity, preferred, 1.5, &seen));
        let mut angles: Vec<f32> = tried.iter().filter(|c| c.0.length() > 1.4999).map(|c| c.0.to_angle()).collect();
        angles.sort_by(f32::total_cmp);
        angles.push(angles[0] + TAU);
        let widest = angles.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f32::max);
        prop_assert!(widest < TAU / 16.0 * 1.01, "{widest}");
    }

    #[test]
    fn what_cannot_be_reached_is_not_tried(a in vector(1.0), b in vector(1.2), preferred in vector(1.4)) {
        let seen = [other(Vec2::new(1.5, 0.3), b, 0.4, 0.5)];
        let view = AvoidanceInput { max_acceleration: 4.0, step: 0.1, ..view(a, preferred, 1.5, &seen) };
        for count in [0, 100] {
            let model = Rvo { kinodynamic: true, candidates: count, ..Rvo::default() };
            let tried = candidates(&model, &view);
            let nearest = a + (preferred - a).clamp_length_max(0.4);
            prop_assert!(tried[0].0.distance(nearest) < 1e-5, "{} instead of {nearest}", tried[0].0);
            for (v, _) in tried {
                prop_assert!(v.distance(a) <= 0.4001 && v.length() <= 1.5001);
            }
        }
    }
}

/// The adaptive search, compared with a dense search: within a tenth of the best, except in a few cases of a hundred.
#[test]
fn the_adaptive_search_is_mostly_near_the_best() {
    const CASES: usize = 300;
    let mut state = 1u32;
    let mut draw = |range: f32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 23) as f32 * range - range
    };
    let mut near = 0;
    for _ in 0..CASES {
        let offset = Vec2::new(draw(2.0), draw(2.0));
        let offset = offset + offset.normalize_or(Vec2::X) * 0.5;
        let (b, preferred) = (Vec2::new(draw(1.2), draw(1.2)), Vec2::new(draw(1.0), draw(1.0)));
        let seen = [other(offset, b, 0.4, 0.5)];
        let model = Rvo { time_horizon: f32::INFINITY, ..Rvo::default() };
        let cost =
            |v: Vec2| v.distance(preferred) + 1.0 / time_to_disc(offset, v * 2.0 - preferred * 0.8 - b, 0.4).max(1e-3);
        let chosen = model.velocity(&view(preferred * 0.8, preferred, 1.5, &seen), &mut Workspace::default());
        let best = grid(1.5).map(cost).fold(f32::INFINITY, f32::min);
        near += usize::from(cost(chosen) <= best * 1.1 + 0.01);
    }
    assert!(near >= CASES * 95 / 100, "{near} of {CASES}");
}

#[test]
fn draws_fill_the_disc_evenly_and_differ_from_step_to_step() {
    let model = Rvo { candidates: 4000, ..drawn() };
    let draw = |step| {
        candidates(
            &model,
            &AvoidanceInput { rng: Rng { seed: 1, number: 5, step }, ..view(Vec2::ZERO, Vec2::X, 1.5, &[]) },
        )
    };
    let (first, again, next) = (draw(1), draw(1), draw(2));
    assert_eq!(first, again);
    assert_ne!(first[1].0, next[1].0);
    // quarters of the disc by angle, and the inner half of its area
    for angle in 0..4 {
        let side = Vec2::from_angle(angle as f32 * std::f32::consts::FRAC_PI_2);
        let count = first.iter().filter(|(v, _)| v.dot(side) > 0.0 && v.perp_dot(side) > 0.0).count();
        assert!((880..1120).contains(&count), "{count}");
    }
    let inner = first.iter().filter(|(v, _)| v.length() < 1.5 * 0.5f32.sqrt()).count();
    assert!((1880..2120).contains(&inner), "{inner}");
}

/// A wall counts only where braking would not be enough.
#[test]
fn a_wall_counts_when_it_is_too_late_to_brake() {
    let disc = |x: f32| {
        let disc = Disc { center: glam::DVec2::ZERO, radius: 1.0 };
        [NearDisc { offset: Vec2::new(x, 0.0), disc, outline: Outline::POINT }]
    };
    // 1.4 m/s at 5 m/s²: 0.28 s, 0.39 m
    for (x, free) in [(1.2 + 0.45, true), (1.2 + 0.3, false)] {
        let discs = disc(x);
        let view = AvoidanceInput { discs: &discs, ..view(Vec2::X * 1.4, Vec2::X * 1.4, 1.5, &[]) };
        let chosen = drawn().velocity(&view, &mut Workspace::default());
        assert_eq!(chosen == view.preferred, free, "{x}: {chosen}");
        assert_ne!(Rvo::default().velocity(&view, &mut Workspace::default()), view.preferred, "the horizon sees it");
    }
}

/// With a share of one a reciprocal velocity obstacle is a velocity obstacle: the present velocity has no effect.
#[test]
fn a_full_share_forgets_the_present_velocity() {
    let neighbours = [other(Vec2::new(2.0, 0.1), Vec2::new(-1.0, 0.0), 0.4, 1.0)];
    let preferred = Vec2::new(1.4, 0.0);
    let model = Rvo::default();
    let still = choose(&model, Vec2::ZERO, preferred, &neighbours);
    let moving = choose(&model, Vec2::new(1.0, 0.7), preferred, &neighbours);
    assert!(still.distance(moving) < 0.1, "{still} {moving}");
}

/// The authors' rule for overlapping agents: they leave by the fastest way, regardless of the preferred velocity.
#[test]
fn overlapping_agents_leave_by_the_fastest_way() {
    let seen = [AvoidanceNeighbour { ..other(Vec2::new(0.2, 0.0), Vec2::ZERO, 0.4, 1.0) }];
    for model in [drawn(), Rvo::default()] {
        let chosen = choose(&model, Vec2::ZERO, Vec2::X * 1.4, &seen);
        assert!(chosen.x < -1.0, "{chosen}");
    }
}

#[test]
fn a_search_has_from_one_to_100_000_candidates() {
    let check = |candidates| Rvo { candidates, ..Rvo::default() }.check();
    let told = check(100_001).unwrap_err().to_string();
    assert!(told.contains("candidates") && told.contains("at most 100,000"), "{told}");
    assert!([0, 1, 100_000].into_iter().all(|right| check(right).is_ok()));
}
