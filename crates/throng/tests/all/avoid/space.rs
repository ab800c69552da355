//! ORCA in space: pairs are free, a dense search finds nothing better, and in a plane it equals ORCA in the plane.

use crate::avoid::common::{other, vector, view};
use glam::{Vec2, Vec3};
use proptest::prelude::*;
use throng::avoid::{
    AvoidanceInput, AvoidanceNeighbour, HalfSpace, LocalModel, Orca, Orca3d, Outline, Workspace,
    closest_velocity_in_space, least_violation_in_space,
};

fn in_space(range: f32) -> impl Strategy<Value = Vec3> {
    (vector(range), -range..range).prop_map(|(v, z)| v.extend(z))
}

/// The chosen velocity of a flying agent.
fn choose(model: &Orca3d, velocity: Vec3, preferred: Vec3, max_speed: f32, neighbours: &[AvoidanceNeighbour]) -> Vec3 {
    let view = AvoidanceInput {
        vertical_velocity: velocity.z,
        preferred_vertical_velocity: preferred.z,
        ..view(velocity.truncate(), preferred.truncate(), max_speed, neighbours)
    };
    model.velocity_in_space(&view, &mut Workspace::default())
}

fn flying(offset: Vec3, velocity: Vec3, radii: f32, share: f32) -> AvoidanceNeighbour {
    let flat = other(offset.truncate(), velocity.truncate(), radii, share);
    AvoidanceNeighbour { above: offset.z, vertical_velocity: velocity.z, ..flat }
}

fn plane() -> impl Strategy<Value = HalfSpace> {
    (in_space(1.0), -1.2f32..0.6).prop_filter_map("no direction", |(normal, distance)| {
        let normal = normal.try_normalize()?;
        Some(HalfSpace { point: normal * distance, normal })
    })
}

fn grid(speed: f32) -> impl Iterator<Item = Vec3> {
    let steps = move || (-20..=20).map(move |i| i as f32 * speed / 20.0);
    let all = steps().flat_map(move |x| steps().flat_map(move |y| steps().map(move |z| Vec3::new(x, y, z))));
    all.filter(move |v| v.length() <= speed)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn the_chosen_velocity_is_the_best_of_all(planes in prop::collection::vec(plane(), 0..9), preferred in in_space(1.2)) {
        let speed = 1.5;
        let worst = |v: Vec3| planes.iter().map(|plane| plane.violation(v)).fold(f32::NEG_INFINITY, f32::max);
        match closest_velocity_in_space(&planes, speed, preferred) {
            Ok(v) => {
                prop_assert!(v.length() <= speed * 1.001 && worst(v) <= 2e-3, "{} {}", v.length(), worst(v));
                let best = grid(speed).filter(|&v| worst(v) <= 0.0).map(|v| v.distance(preferred)).fold(f32::INFINITY, f32::min);
                prop_assert!(v.distance(preferred) <= best + 2e-3, "{} {best}", v.distance(preferred));
            }
            Err(failed) => {
                prop_assert!(grid(speed).all(|v| worst(v) > -0.01), "there is no velocity with room to spare");
                let v = least_violation_in_space(&planes, 0, speed, failed, &mut Vec::new());
                let best = grid(speed).map(worst).fold(f32::INFINITY, f32::min);
                prop_assert!(v.length() <= speed * 1.001 && worst(v) <= best + 0.02, "{} instead of {best}", worst(v));
            }
        }
    }

    #[test]
    fn in_a_plane_it_is_orca_in_the_plane(
        all in prop::collection::vec((vector(4.0), vector(1.3)), 1..7), velocity in vector(1.0), preferred in vector(1.0),
        share in 0.1f32..0.9,
    ) {
        prop_assume!(all.iter().all(|(offset, _)| (offset.length() - 0.4).abs() > 1e-3));
        let seen: Vec<AvoidanceNeighbour> = all.iter().map(|&(x, v)| other(x, v, 0.4, share)).collect();
        let mut workspace = Workspace::default();
        let model = Orca { time_horizon: Orca3d::default().time_horizon, ..Orca::default() };
        let flat = model.velocity(&view(velocity, preferred, 1.5, &seen), &mut workspace);
        let chosen = choose(&Orca3d::default(), velocity.extend(0.0), preferred.extend(0.0), 1.5, &seen);
        let worst = |v: Vec2| workspace.lines.iter().map(|line| line.violation(v)).fold(0.0, f32::max);
        if worst(flat) < 1e-4 {
            prop_assert!(chosen.distance(flat.extend(0.0)) < 2e-3, "{chosen} {flat}");
        } else {
            // several velocities may be equally good where nothing is permitted
            prop_assert!((worst(chosen.truncate()) - worst(flat)).abs() < 2e-3, "{chosen} {flat}");
        }
    }

    /// For any shares that sum to one, if both agents take a velocity of their half-space, they are free for the
    /// horizon.
    #[test]
    fn a_pair_is_free_for_the_horizon(
        offset in in_space(5.0), a in in_space(1.5), b in in_space(1.5), wish_a in in_space(1.5),
        wish_b in in_space(1.5), share in 0.0f32..=1.0, scale in 1.0f32..3.0,
    ) {
        let tall = Vec3::new(1.0, 1.0, 1.0 / scale);
        prop_assume!((offset * tall).length() > 0.42);
        let model = Orca3d { vertical_scale: scale, ..Orca3d::default() };
        let new_a = choose(&model, a, wish_a, 100.0, &[flying(offset, b, 0.4, share)]);
        let new_b = choose(&model, b, wish_b, 100.0, &[flying(-offset, a, 0.4, 1.0 - share)]);
        for i in 0..=400 {
            let between = offset - (new_a - new_b) * (model.time_horizon * i as f32 / 400.0);
            prop_assert!((between * tall).length() >= 0.4 * 0.997, "{}", (between * tall).length());
        }
    }

    /// An agent without a collision ahead keeps its velocity.
    #[test]
    fn a_free_agent_keeps_its_velocity(
        offset in in_space(4.0), a in in_space(1.3), b in in_space(1.3), share in 0.0f32..=1.0, scale in 1.0f32..3.0,
    ) {
        let tall = Vec3::new(1.0, 1.0, 1.0 / scale);
        let model = Orca3d { vertical_scale: scale, ..Orca3d::default() };
        let between = |i: i32| (offset - (a - b) * (model.time_horizon * i as f32 / 400.0)) * tall;
        prop_assume!((0..=400).all(|i| between(i).length() > 0.41));
        let chosen = choose(&model, a, a, 100.0, &[flying(offset, b, 0.4, share)]);
        prop_assert!(chosen.distance(a) < 1e-4, "{chosen} instead of {a}");
    }

    /// The result does not depend on the direction of the axes.
    #[test]
    fn tilted_scenes_give_tilted_velocities(
        offset in in_space(4.0), a in in_space(1.3), b in in_space(1.3), preferred in in_space(0.8), axis in in_space(1.0),
        angle in 0.0f32..6.0,
    ) {
        prop_assume!(offset.length() > 0.45 && axis.length() > 0.1);
        let tilt = |v: Vec3| glam::Quat::from_axis_angle(axis.normalize(), angle) * v;
        let model = Orca3d::default();
        let plain = choose(&model, a, preferred, 2.0, &[flying(offset, b, 0.4, 0.5)]);
        let tilted = choose(&model, tilt(a), tilt(preferred), 2.0, &[flying(tilt(offset), tilt(b), 0.4, 0.5)]);
        prop_assert!(tilt(plain).distance(tilted) < 2e-3, "{} {tilted}", tilt(plain));
    }
}

#[test]
fn tall_bodies_avoid_sideways() {
    let meeting = [flying(Vec3::new(2.0, 0.1, 0.1), -Vec3::X, 0.4, 0.5)];
    let aside = |scale| {
        let model = Orca3d { vertical_scale: scale, ..Orca3d::default() };
        let v = choose(&model, Vec3::X, Vec3::X, 1.5, &meeting);
        (v.y.abs(), v.z.abs())
    };
    let ((y, z), (tall_y, tall_z)) = (aside(1.0), aside(3.0));
    assert!((y - z).abs() < 1e-3 && y > 0.05, "{y} {z}");
    assert!(tall_y > 3.0 * tall_z, "{tall_y} {tall_z}");
}

/// A wall is a plane: its surface is not reached within the horizon, for any preferred velocity.
#[test]
fn walls_stand_upright() {
    use throng::avoid::NearDisc;
    let disc = throng::space::Disc { center: glam::DVec2::ZERO, radius: 1.0 };
    let discs = [NearDisc { offset: Vec2::new(1.5, 0.0), disc, outline: Outline::POINT }];
    let model = Orca3d::default();
    let seen =
        AvoidanceInput { discs: &discs, preferred_vertical_velocity: 1.0, ..view(Vec2::ZERO, Vec2::X * 1.0, 1.8, &[]) };
    let v = model.velocity_in_space(&seen, &mut Workspace::default());
    let most = (0.5 - 0.2) / model.time_horizon_obstacles;
    assert!((v.x - most).abs() < 1e-5 && (v.z - 1.0).abs() < 1e-5, "{v}");
}

/// Half way between two opposite planes their violations are equal.
#[test]
fn between_planes_that_face_each_other_it_is_the_middle() {
    for normal in [Vec3::X, Vec3::new(0.6, 0.0, -0.8), Vec3::Y] {
        let plane = |distance: f32, side: f32| HalfSpace { point: normal * distance, normal: normal * side };
        let planes = [plane(0.9, 1.0), plane(0.3, -1.0)];
        let failed = closest_velocity_in_space(&planes, 1.5, Vec3::ZERO).unwrap_err();
        let v = least_violation_in_space(&planes, 0, 1.5, failed, &mut Vec::new());
        assert!((v.dot(normal) - 0.6).abs() < 1e-5, "{v}");
    }
}
