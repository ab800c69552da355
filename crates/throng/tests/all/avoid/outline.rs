//! Bodies other than discs, compared with their definition: dense search over time and over directions of velocities,
//! and pairs that keep their half-planes.

use crate::avoid::common::{other, vector, view};
use glam::{DVec2, Vec2};
use proptest::prelude::*;
use throng::avoid::{AvoidanceNeighbour, Hrvo, LocalModel, Orca, Outline, Rvo, Vo, Workspace};
use throng::space::Core;

const HORIZON: f32 = 2.0;

fn core() -> impl Strategy<Value = Core> {
    let extents = (0.0f32..1.25, prop_oneof![Just(0.0f32), 0.0625f32..0.625]).prop_map(|(x, y)| Vec2::new(x, y));
    (-3.125f32..3.125, extents).prop_map(|(heading, half)| Core::new(DVec2::ZERO, heading, half))
}

/// The second core as a neighbour of the first.
fn seen(own: &Core, their: &Core, offset: Vec2, velocity: Vec2, radii: f32, share: f32) -> AvoidanceNeighbour {
    AvoidanceNeighbour { outline: Outline::between(own, their), ..other(offset, velocity, radii, share) }
}

fn at(core: &Core, center: Vec2) -> Core {
    Core { center: center.as_dvec2(), ..*core }
}

/// Least distance of the cores while `own` moves with a relative velocity, for some seconds.
fn least(own: &Core, their: &Core, offset: Vec2, relative: Vec2, seconds: f32) -> f64 {
    let still = at(their, offset);
    let times = (0..=400).map(|i| seconds * i as f32 / 400.0);
    times.map(|t| at(own, relative * t).separation(&still).distance).fold(f64::INFINITY, f64::min)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    /// The Minkowski difference: its corners are those of the convex hull of all differences of corners.
    #[test]
    fn the_outline_holds_all_differences(own in core(), their in core(), angle in 0.0f32..6.25) {
        let outline = Outline::between(&own, &their);
        let along = Vec2::from_angle(angle);
        let farthest = |points: &mut dyn Iterator<Item = Vec2>| points.map(|p| p.dot(along)).fold(f32::MIN, f32::max);
        let differences = their.corners().into_iter().flat_map(|p| own.corners().map(|q| (p - q).as_vec2()));
        let (all, hull) = (farthest(&mut differences.into_iter()), farthest(&mut outline.corners().iter().copied()));
        prop_assert!((all - hull).abs() < 1e-5, "{all} {hull}");
        let corners = outline.corners();
        let next = |i: usize| corners[i % corners.len()];
        let turns = (0..corners.len()).map(|i| (next(i + 1) - next(i)).perp_dot(next(i + 2) - next(i + 1)));
        prop_assert!(turns.into_iter().all(|turn| turn > -1e-5), "{corners:?}");
    }

    #[test]
    fn the_time_to_a_collision_is_the_first_at_which_they_touch(
        own in core(), their in core(), offset in vector(4.0), relative in vector(2.0), radii in 0.25f32..1.0,
    ) {
        let neighbour = seen(&own, &their, offset, Vec2::ZERO, radii, 0.5);
        prop_assume!(own.separation(&at(&their, offset)).distance > f64::from(radii) + 1e-3);
        let time = neighbour.time_to_collision(relative).min(20.0);
        let until = |seconds: f32| least(&own, &their, offset, relative, seconds);
        prop_assert!(until(time) >= f64::from(radii) - 1e-3, "nothing before {time} s");
        if time < 10.0 {
            let touching = at(&own, relative * time).separation(&at(&their, offset)).distance;
            prop_assert!((touching - f64::from(radii)).abs() < 1e-3, "{touching} at {time} s");
        } else {
            prop_assert!(until(10.0) >= f64::from(radii) - 1e-3);
        }
    }

    /// The border of the half-plane touches the velocities that lead to a collision: they lie on its far side, and it
    /// goes through the nearest of them.
    #[test]
    fn the_boundary_is_the_nearest_velocity_that_just_collides(
        own in core(), their in core(), offset in vector(4.0), relative in vector(2.0), radii in 0.25f32..1.0,
    ) {
        let neighbour = seen(&own, &their, offset, Vec2::ZERO, radii, 0.5);
        prop_assume!(own.separation(&at(&their, offset)).distance > f64::from(radii) * 1.05);
        let outline = neighbour.outline;
        let (distance, normal) = outline.boundary(offset, relative, HORIZON, radii, Some(neighbour.legs()));
        let collides = |v: Vec2| neighbour.time_to_collision(v) < HORIZON;
        let scale = 1e-3 * (1.0 + relative.length());
        prop_assert!((normal.length() - 1.0).abs() < 1e-5);
        prop_assert!(collides(relative - normal * (distance + scale)), "just within");
        prop_assert!(!collides(relative - normal * (distance - scale)), "just outside");
        for k in 0..64 {
            let aside = Vec2::from_angle(k as f32 * std::f32::consts::TAU / 64.0) * (distance.abs() - scale).max(0.0);
            prop_assert_eq!(collides(relative + aside), distance < 0.0 , "nearer than {}", distance);
        }
    }

    /// For bodies other than discs: if both agents take a velocity of their half-plane, they are free for the horizon.
    #[test]
    fn a_pair_that_keeps_its_half_planes_is_free_for_the_horizon(
        own in core(), their in core(), offset in vector(5.0), a in vector(2.0), b in vector(2.0),
        wish_a in vector(2.0), wish_b in vector(2.0), share in 0.0f32..=1.0, radii in 0.25f32..1.0,
    ) {
        prop_assume!(own.separation(&at(&their, offset)).distance > f64::from(radii) * 1.01);
        let orca = Orca { time_horizon: HORIZON, ..Orca::default() };
        let mut workspace = Workspace::default();
        let by_a = [seen(&own, &their, offset, b, radii, share)];
        let by_b = [seen(&their, &own, -offset, a, radii, 1.0 - share)];
        let new_a = orca.velocity(&view(a, wish_a, 100.0, &by_a), &mut workspace);
        let new_b = orca.velocity(&view(b, wish_b, 100.0, &by_b), &mut workspace);
        let least = least(&own, &their, offset, new_a - new_b, HORIZON);
        prop_assert!(least >= f64::from(radii) * (1.0 - 5e-3), "{least} of {radii}");
    }

    /// The choices of the other models next to a single standing agent are free for a while too.
    #[test]
    fn other_models_see_the_shape(own in core(), their in core(), offset in vector(4.0), preferred in vector(1.5)) {
        let radii = 0.5f32;
        prop_assume!(own.separation(&at(&their, offset)).distance > 0.6);
        let neighbours = [seen(&own, &their, offset, Vec2::ZERO, radii, 1.0)];
        let models: [&dyn LocalModel; 3] = [&Vo::default(), &Hrvo::default(), &Rvo::default()];
        for model in models {
            let v = model.velocity(&view(Vec2::ZERO, preferred, 1.5, &neighbours), &mut Workspace::default());
            let least = least(&own, &their, offset, v, 0.25);
            prop_assert!(least >= f64::from(radii) * 0.98, "{model:?}: {least}");
        }
    }

    /// A core that is hardly more than a point is avoided like a disc.
    #[test]
    fn a_tiny_polygon_is_a_disc(
        offset in vector(4.0), a in vector(2.0), b in vector(2.0), preferred in vector(2.0), radii in 0.25f32..1.0,
    ) {
        prop_assume!((offset.length() - radii).abs() > 1e-2);
        let tiny = Core::new(DVec2::ZERO, 0.3, Vec2::new(2e-6, 3e-6));
        let point = Core::point(DVec2::ZERO);
        let orca = Orca::default();
        let chosen = |core: &Core| {
            let neighbours = [seen(&point, core, offset, b, radii, 0.5)];
            orca.velocity(&view(a, preferred, 100.0, &neighbours), &mut Workspace::default())
        };
        prop_assert!(chosen(&tiny).distance(chosen(&point)) < 2e-2, "{} {}", chosen(&tiny), chosen(&point));
    }
}
