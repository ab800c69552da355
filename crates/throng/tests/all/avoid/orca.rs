//! ORCA, compared with its definition: pairs are free for the horizon, and a dense search over velocities finds the
//! same chosen velocity.

use crate::avoid::common::{choose, other, vector, view};
use glam::Vec2;
use proptest::prelude::*;
use throng::avoid::{
    AvoidanceNeighbour, BuiltFrom, HalfPlane, LocalModel, Orca, Workspace, closest_velocity, least_violation,
};

const HORIZON: f32 = 2.0;

/// Least distance of the centres within the horizon.
fn nearest_approach(offset: Vec2, relative: Vec2) -> f32 {
    (0..=2000).map(|i| (offset - relative * (HORIZON * i as f32 / 2000.0)).length()).fold(f32::INFINITY, f32::min)
}

proptest! {
    /// For any shares that sum to one, if both agents take a velocity of their half-plane, they are free for the
    /// horizon (van den Berg, Guy, Lin, Manocha, ISRR 2009).
    #[test]
    fn a_pair_is_free_for_the_horizon(
        offset in vector(6.0), a in vector(2.0), b in vector(2.0), wish_a in vector(2.0), wish_b in vector(2.0),
        share in 0.0f32..=1.0, radii in 0.2f32..1.0,
    ) {
        prop_assume!(offset.length() > radii * 1.01);
        let orca = Orca { time_horizon: HORIZON, ..Orca::default() };
        let mut workspace = Workspace::default();
        let seen = |offset, velocity, share| [other(offset, velocity, radii, share)];
        // no speed limit that could exclude the velocities of the half-plane
        let new_a = orca.velocity(&view(a, wish_a, 100.0, &seen(offset, b, share)), &mut workspace);
        let new_b = orca.velocity(&view(b, wish_b, 100.0, &seen(-offset, a, 1.0 - share)), &mut workspace);
        prop_assert!(nearest_approach(offset, new_a - new_b) >= radii * (1.0 - 2e-3));
    }

    /// Without a collision course the free space is divided, and the sum of both parts never leads to a collision
    /// course.
    #[test]
    fn a_free_pair_that_wants_to_meet_stays_free(
        offset in vector(6.0), a in vector(2.0), b in vector(2.0), speed in 0.0f32..4.0, aim in vector(0.5),
        share in 0.0f32..=1.0, radii in 0.2f32..1.0,
    ) {
        prop_assume!(offset.length() > radii * 1.01);
        prop_assume!(nearest_approach(offset, a - b) > radii * 1.001);
        let orca = Orca { time_horizon: HORIZON, ..Orca::default() };
        let mut workspace = Workspace::default();
        let towards = (offset + aim).normalize() * speed;
        let seen = |offset, velocity, share| [other(offset, velocity, radii, share)];
        let new_a = orca.velocity(&view(a, towards, 100.0, &seen(offset, b, share)), &mut workspace);
        let new_b = orca.velocity(&view(b, -towards, 100.0, &seen(-offset, a, 1.0 - share)), &mut workspace);
        prop_assert!(nearest_approach(offset, new_a - new_b) >= radii * (1.0 - 2e-3));
    }

    /// In a scene of several agents with arbitrary shares: if both agents of a pair take a velocity of their half-plane
    /// for the pair, they are free, on a collision course before or not.
    #[test]
    fn agents_that_keep_their_half_planes_are_free_in_any_scene(
        agents in prop::collection::vec((vector(4.0), vector(1.5), vector(1.5)), 2..9),
        draws in prop::collection::vec(0.0f32..=1.0, 36),
        radii in 0.2f32..0.8,
    ) {
        let share = |i: usize, j: usize| {
            let draw = draws[i.min(j) + 9 * (i.max(j) % 4)];
            if i < j { draw } else { 1.0 - draw }
        };
        let orca = Orca { time_horizon: HORIZON, ..Orca::default() };
        let mut workspace = Workspace::default();
        let seen = |i: usize, j: usize| other(agents[j].0 - agents[i].0, agents[j].1, radii, share(i, j));
        let others = |i: usize| (0..agents.len()).filter(move |&j| j != i);
        let chosen: Vec<Vec2> = (0..agents.len())
            .map(|i| {
                let neighbours: Vec<AvoidanceNeighbour> = others(i).map(|j| seen(i, j)).collect();
                orca.velocity(&view(agents[i].1, agents[i].2, 3.0, &neighbours), &mut workspace)
            })
            .collect();
        // a permitted preferred velocity is chosen
        let mut keeps = |i: usize, j: usize| {
            let alone = orca.velocity(&view(agents[i].1, chosen[i], 100.0, &[seen(i, j)]), &mut workspace);
            alone.distance(chosen[i]) < 1e-4
        };
        for i in 0..agents.len() {
            for j in others(i).filter(|&j| j < i) {
                let offset = agents[j].0 - agents[i].0;
                if offset.length() > radii * 1.01 && keeps(i, j) && keeps(j, i) {
                    let least = nearest_approach(offset, chosen[i] - chosen[j]);
                    prop_assert!(least >= radii * (1.0 - 2e-3), "{i} and {j}: {least} of {radii}");
                }
            }
        }
    }

    /// The paper's other optimisation velocities: a pair that builds from the same velocities is free as well.
    #[test]
    fn a_pair_is_free_whatever_the_planes_are_built_from(
        offset in vector(6.0), a in vector(2.0), b in vector(2.0), wish_a in vector(2.0), wish_b in vector(2.0),
        zero in any::<bool>(),
    ) {
        prop_assume!(offset.length() > 0.41);
        let built_from = if zero { BuiltFrom::Zero } else { BuiltFrom::Preferred };
        let orca = Orca { time_horizon: HORIZON, built_from, ..Orca::default() };
        let mut workspace = Workspace::default();
        let seen = |offset, velocity, preferred| [AvoidanceNeighbour { preferred, ..other(offset, velocity, 0.4, 0.5) }];
        let new_a = orca.velocity(&view(a, wish_a, 100.0, &seen(offset, b, wish_b)), &mut workspace);
        let new_b = orca.velocity(&view(b, wish_b, 100.0, &seen(-offset, a, wish_a)), &mut workspace);
        prop_assert!(nearest_approach(offset, new_a - new_b) >= 0.4 * (1.0 - 2e-3));
    }

    /// With a turning bias: the best of all velocities under a cost that weighs sideways changes differently, by a
    /// dense search.
    #[test]
    fn a_turning_bias_makes_going_aside_cheaper(
        offset in vector(2.5), a in vector(1.2), b in vector(1.2), preferred in vector(1.4), bias in 0.4f32..2.5,
    ) {
        prop_assume!(offset.length() > 0.5 && preferred.length() > 0.1);
        let preferred = preferred.clamp_length_max(1.5);
        let (plain, biased) = (Orca::default(), Orca { turning_bias: bias, ..Orca::default() });
        let mut workspace = Workspace::default();
        let seen = [other(offset, b, 0.4, 0.5)];
        let seen = view(a, preferred, 1.5, &seen);
        let chosen = biased.velocity(&seen, &mut workspace);
        plain.velocity(&seen, &mut workspace);
        let line = workspace.lines[0];
        let ahead = preferred.normalize();
        let cost = |v: Vec2| Vec2::new((v - preferred).dot(ahead), (v - preferred).perp_dot(ahead) / bias).length();
        let grid = (-75..=75).flat_map(|i| (-75..=75).map(move |j| Vec2::new(i as f32, j as f32) * 0.02));
        let best = grid
            .filter(|v| v.length() <= 1.5 && line.violation(*v) <= 0.0)
            .map(cost)
            .fold(f32::INFINITY, f32::min);
        prop_assume!(best.is_finite());
        prop_assert!(chosen.length() <= 1.5 * 1.0001 && line.violation(chosen) <= 1e-3, "{chosen}");
        // the polygon within the disc of speeds costs a little
        prop_assert!(cost(chosen) <= best + 0.02, "{} {best}", cost(chosen));
    }

    /// The result does not depend on the direction of the axes.
    #[test]
    fn turned_scenes_give_turned_velocities(offset in vector(4.0), a in vector(1.5), b in vector(1.5), preferred in vector(1.5)) {
        prop_assume!(offset.length() > 0.45);
        let orca = Orca::default();
        let mut workspace = Workspace::default();
        let seen = [other(offset, b, 0.4, 0.5)];
        let straight = orca.velocity(&view(a, preferred, 2.0, &seen), &mut workspace);
        let seen = [AvoidanceNeighbour { offset: offset.perp(), velocity: b.perp(), ..seen[0] }];
        let turned = orca.velocity(&view(a.perp(), preferred.perp(), 2.0, &seen), &mut workspace);
        prop_assert!(straight.perp().distance(turned) < 1e-3, "{straight} {turned}");
    }

    /// The linear program, compared with a search over a fine grid of velocities.
    #[test]
    fn the_chosen_velocity_is_the_best_of_all(
        lines in prop::collection::vec((0.0f32..std::f32::consts::TAU, -1.0f32..1.5), 0..8),
        preferred in vector(1.5),
    ) {
        let lines: Vec<HalfPlane> = lines
            .iter()
            .map(|&(angle, depth)| {
                let direction = Vec2::new(angle.cos(), angle.sin());
                HalfPlane { point: -direction.perp() * depth, direction }
            })
            .collect();
        let speed = 1.6;
        let grid = || {
            (-200..=200)
                .flat_map(move |x| (-200..=200).map(move |y| Vec2::new(x as f32, y as f32) * (speed / 200.0)))
                .filter(move |v| v.length() <= speed)
        };
        let worst = |v: Vec2| lines.iter().map(|line| line.violation(v)).fold(f32::NEG_INFINITY, f32::max);
        match closest_velocity(&lines, speed, preferred) {
            Ok(v) => {
                prop_assert!(v.length() <= speed * 1.0001);
                prop_assert!(worst(v) <= 1e-3, "it keeps all lines: {}", worst(v));
                let best =
                    grid().filter(|&v| worst(v) <= 0.0).map(|v| v.distance(preferred)).fold(f32::INFINITY, f32::min);
                prop_assert!(v.distance(preferred) <= best + 1e-3);
            }
            Err(failed) => {
                let open = grid().filter(|&v| worst(v) <= -0.02).count();
                prop_assert_eq!(open, 0, "there is no velocity with room to spare");
                let v = least_violation(&lines, 0, speed, failed, &mut Vec::new());
                let best = grid().map(worst).fold(f32::INFINITY, f32::min);
                prop_assert!(worst(v) <= best + 2e-2, "{} instead of {best}", worst(v));
            }
        }
    }
}

#[test]
fn coincident_agents_part() {
    let orca = Orca::default();
    let mut workspace = Workspace::default();
    let seen = |aside| [AvoidanceNeighbour { aside, ..other(Vec2::ZERO, Vec2::ZERO, 0.4, 0.5) }];
    let a = orca.velocity(&view(Vec2::ZERO, Vec2::ZERO, 1.5, &seen(Vec2::X)), &mut workspace);
    let b = orca.velocity(&view(Vec2::ZERO, Vec2::ZERO, 1.5, &seen(-Vec2::X)), &mut workspace);
    assert!(a.x > 0.1 && b.x < -0.1, "{a} {b}");
}

#[test]
fn an_agent_that_does_not_give_way_keeps_its_velocity() {
    let orca = Orca::default();
    let mut workspace = Workspace::default();
    let offset = Vec2::new(2.0, 0.1);
    let meeting = [other(offset, -Vec2::X, 0.4, 0.0)];
    let chosen = orca.velocity(&view(Vec2::X, Vec2::X, 1.5, &meeting), &mut workspace);
    // on the border of the half-plane, within rounding
    assert!(chosen.distance(Vec2::X) < 1e-5, "{chosen}");
}

/// Two agents that stand 4 m apart and approach each other: the horizon permits a closing speed of 1.8 m/s.
#[test]
fn room_is_used_to_the_end() {
    let orca = Orca { time_horizon: HORIZON, ..Orca::default() };
    let mut workspace = Workspace::default();
    let offset = Vec2::new(4.0, 0.0);
    for (share, room) in [(0.0, 1.0), (0.35, 0.65), (0.5, 0.5), (1.0, 0.0), (1.0, 1.0)] {
        let seen = [AvoidanceNeighbour { room, ..other(offset, Vec2::ZERO, 0.4, share) }];
        let chosen = orca.velocity(&view(Vec2::ZERO, offset, 100.0, &seen), &mut workspace);
        assert!(chosen.distance(Vec2::new(1.8 * room, 0.0)) < 1e-5, "{share} {room}: {chosen}");
    }
}

/// A turning bias weighs changes of the preferred velocity: an agent without neighbours has none.
#[test]
fn a_turning_bias_changes_nothing_for_an_agent_by_itself() {
    for bias in [0.2, 0.5, 3.0, 8.0] {
        let model = Orca { turning_bias: bias, ..Orca::default() };
        for angle in [0.0, 0.7, 2.4, 5.1] {
            for speed in [0.0, 0.8, 1.5] {
                let preferred = Vec2::from_angle(angle) * speed;
                let chosen = choose(&model, Vec2::X, preferred, &[]);
                assert!(chosen.distance(preferred) < 1e-4, "{bias}: {chosen} instead of {preferred}");
            }
        }
    }
}

/// Half way between two opposite lines their violations are equal.
#[test]
fn between_lines_that_face_each_other_it_is_the_middle() {
    for angle in [0.0, 1.0, 4.0] {
        let normal = Vec2::from_angle(angle);
        // the permitted side is on the left of the direction
        let line = |distance: f32, side: f32| HalfPlane { point: normal * distance, direction: normal.perp() * -side };
        let lines = [line(0.9, 1.0), line(0.3, -1.0)];
        let failed = closest_velocity(&lines, 1.5, Vec2::ZERO).unwrap_err();
        let v = least_violation(&lines, 0, 1.5, failed, &mut Vec::new());
        assert!((v.dot(normal) - 0.6).abs() < 1e-5, "{v}");
    }
}
