//! Reciprocal velocity obstacles against the paper's penalty.

use crate::common::{choose, grid, other, vector, view};
use glam::Vec2;
use proptest::prelude::*;
use throng::avoid::{
    Dice, LocalModel, NearDisc, Neighbour, Outline, Reason, Rvo, Search, View, Workspace, time_to_disc,
};
use throng::space::Disc;

/// As the authors' library searches.
fn drawn() -> Rvo {
    Rvo {
        time_horizon: f32::INFINITY,
        time_horizon_obstacles: None,
        search: Search::Random { candidates: 250 },
        ..Rvo::default()
    }
}

/// When two discs touch, by small steps of time.
fn first_touch(offset: Vec2, velocity: Vec2) -> f32 {
    let touches = (0..40_000).map(|i| i as f32 * 2e-3).find(|t| (offset - velocity * *t).length() <= 0.4);
    touches.unwrap_or(f32::INFINITY)
}

fn candidates(model: &Rvo, view: &View<'_>) -> Vec<(Vec2, f32)> {
    let reasons = model.explain(view, &mut Workspace::default());
    reasons
        .iter()
        .filter_map(|r| if let Reason::Candidate { velocity, cost } = r { Some((*velocity, *cost)) } else { None })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Section V: weight / time to collision of 2 v' - vA - vB, plus the distance from the preferred velocity.
    #[test]
    fn each_candidate_costs_what_the_paper_says(
        offset in vector(4.0), a in vector(1.2), b in vector(1.2), wish in vector(1.2), weight in 0.2f32..3.0,
        number in 0u32..1000,
    ) {
        prop_assume!(offset.length() > 0.5);
        let seen = [other(offset, b, 0.4, 0.5)];
        let dice = Dice { seed: 7, number, step: 3 };
        let view = View { dice, ..view(a, wish, 1.5, &seen) };
        let model = Rvo { weight, ..drawn() };
        let tried = candidates(&model, &view);
        prop_assert_eq!(tried.len(), 251);
        prop_assert_eq!(tried[0].0, wish.clamp_length_max(1.5));
        for &(v, cost) in &tried {
            let time = first_touch(offset, v * 2.0 - a - b);
            // the time that the cost tells of; from far away it weighs nothing
            let told = weight / (cost - v.distance(wish)).max(weight / 60.0);
            // glancing touches may be missed by either
            let near = ((v * 2.0 - a - b).normalize().perp_dot(offset).abs() - 0.4).abs() < 2e-3;
            prop_assert!(near || (told - time.min(60.0)).abs() < 4e-3 + 0.01 * time.min(60.0), "{v}: {told} s, {time} s");
        }
        let chosen = model.velocity(&view, &mut Workspace::default());
        let best = tried.iter().map(|c| c.1).fold(f32::INFINITY, f32::min);
        prop_assert_eq!(tried.iter().find(|c| c.1 == best).map(|c| c.0), Some(chosen));
    }

    #[test]
    fn what_cannot_be_reached_is_not_tried(a in vector(1.0), b in vector(1.2), wish in vector(1.4)) {
        let seen = [other(Vec2::new(1.5, 0.3), b, 0.4, 0.5)];
        let view = View { max_acceleration: 4.0, step: 0.1, ..view(a, wish, 1.5, &seen) };
        for search in [Search::Adaptive, Search::Random { candidates: 100 }] {
            let model = Rvo { kinodynamic: true, search, ..Rvo::default() };
            for (v, _) in candidates(&model, &view) {
                prop_assert!(v.distance(a) <= 0.4001 && v.length() <= 1.5001);
            }
        }
    }
}

/// The adaptive search against a dense one: within a tenth of the best, all but a few times in a hundred.
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
        let (b, wish) = (Vec2::new(draw(1.2), draw(1.2)), Vec2::new(draw(1.0), draw(1.0)));
        let seen = [other(offset, b, 0.4, 0.5)];
        let model = Rvo { time_horizon: f32::INFINITY, ..Rvo::default() };
        let cost = |v: Vec2| v.distance(wish) + 1.0 / time_to_disc(offset, v * 2.0 - wish * 0.8 - b, 0.4).max(1e-3);
        let chosen = model.velocity(&view(wish * 0.8, wish, 1.5, &seen), &mut Workspace::default());
        let best = grid(1.5).map(cost).fold(f32::INFINITY, f32::min);
        near += usize::from(cost(chosen) <= best * 1.1 + 0.01);
    }
    assert!(near >= CASES * 95 / 100, "{near} of {CASES}");
}

#[test]
fn draws_fill_the_disc_evenly_and_differ_from_step_to_step() {
    let model = Rvo { search: Search::Random { candidates: 4000 }, ..drawn() };
    let draw = |step| {
        candidates(&model, &View { dice: Dice { seed: 1, number: 5, step }, ..view(Vec2::ZERO, Vec2::X, 1.5, &[]) })
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

/// A wall counts only where braking would not do.
#[test]
fn a_wall_counts_when_it_is_too_late_to_brake() {
    let disc = |x: f32| {
        let disc = Disc { center: glam::DVec2::ZERO, radius: 1.0 };
        [NearDisc { offset: Vec2::new(x, 0.0), disc, outline: Outline::POINT }]
    };
    // 1.4 m/s at 5 m/s²: 0.28 s, 0.39 m
    for (x, free) in [(1.2 + 0.45, true), (1.2 + 0.3, false)] {
        let discs = disc(x);
        let view = View { discs: &discs, ..view(Vec2::X * 1.4, Vec2::X * 1.4, 1.5, &[]) };
        let chosen = drawn().velocity(&view, &mut Workspace::default());
        assert_eq!(chosen == view.preferred, free, "{x}: {chosen}");
        assert_ne!(Rvo::default().velocity(&view, &mut Workspace::default()), view.preferred, "the horizon sees it");
    }
}

/// With a share of one a reciprocal velocity obstacle is a velocity obstacle: the present velocity does not matter.
#[test]
fn a_full_share_forgets_the_present_velocity() {
    let neighbours = [other(Vec2::new(2.0, 0.1), Vec2::new(-1.0, 0.0), 0.4, 1.0)];
    let wish = Vec2::new(1.4, 0.0);
    let model = Rvo::default();
    let still = choose(&model, Vec2::ZERO, wish, &neighbours);
    let moving = choose(&model, Vec2::new(1.0, 0.7), wish, &neighbours);
    assert!(still.distance(moving) < 0.1, "{still} {moving}");
}

/// The authors' rule for who overlaps others: out by the fastest way, whatever is wanted.
#[test]
fn who_overlaps_leaves_by_the_fastest_way() {
    let seen = [Neighbour { ..other(Vec2::new(0.2, 0.0), Vec2::ZERO, 0.4, 1.0) }];
    for model in [drawn(), Rvo::default()] {
        let chosen = choose(&model, Vec2::ZERO, Vec2::X * 1.4, &seen);
        assert!(chosen.x < -1.0, "{chosen}");
    }
}
