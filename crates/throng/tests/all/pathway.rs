//! Paths, compared with points sampled along them.

use glam::{Quat, Vec3};
use proptest::prelude::*;
use throng::space::{PathDirection, Pathway};

fn point(reach: f32) -> impl Strategy<Value = Vec3> {
    (-reach..reach, -reach..reach, -reach..reach).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}

/// Consecutive points are apart.
fn path() -> impl Strategy<Value = Pathway> {
    let corners = prop::collection::vec(point(10.0), 3..12);
    (corners, any::<bool>(), prop::collection::vec(0.0f32..3.0, 12)).prop_filter_map(
        "corners apart",
        |(p, cyclic, r)| {
            let segments = if cyclic { p.len() } else { p.len() - 1 };
            let apart = (0..p.len()).all(|i| p[i].distance(p[(i + 1) % p.len()]) > 0.1);
            apart.then(|| Pathway::with_radii(&p, &r[..segments], cyclic).unwrap())
        },
    )
}

/// (distance along, point, radius) of sampled points, from corner to corner.
fn samples(path: &Pathway) -> Vec<(f32, Vec3, f32)> {
    let mut along = 0.0;
    let mut all = vec![];
    for segment in path.segments() {
        let length = segment.start.distance(segment.end);
        let part = |k: u32| k as f32 / 100.0;
        let on = |k: u32| (along + part(k) * length, segment.start.lerp(segment.end, part(k)), segment.radius);
        all.extend((0..=100).map(on));
        along += length;
    }
    all
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn the_nearest_place_is_the_least_outside(path in path(), points in prop::collection::vec(point(14.0), 6)) {
        let samples = samples(&path);
        for p in points {
            let near = path.nearest(p);
            let least = samples.iter().map(|(_, at, radius)| p.distance(*at) - radius).fold(f32::INFINITY, f32::min);
            prop_assert!(near.outside <= least + 1e-4 && near.outside > least - 0.2, "{least} {near:?}");
            prop_assert!(path.at(near.along).distance(near.point) < 1e-3);
            let radius = path.segments()[near.segment].radius;
            prop_assert!((near.point.distance(p) - radius - near.outside).abs() < 1e-4);
            prop_assert_eq!(near.tangent, path.segments()[near.segment].tangent);
        }
    }

    #[test]
    fn places_are_told_by_the_distance_along(path in path(), laps in -3i32..4) {
        let lap = if path.is_cyclic() { laps as f32 * path.length() } else { 0.0 };
        for (along, point, _) in samples(&path) {
            prop_assert!(path.at(along + lap).distance(point) < 1e-3, "{along} {laps}");
        }
        let (first, last) = (path.segments()[0].start, path.segments()[path.segments().len() - 1].end);
        if !path.is_cyclic() {
            prop_assert!(path.at(-5.0) == first && path.at(path.length() + 5.0).distance(last) < 1e-4);
        }
    }

    #[test]
    fn walking_follows_the_tangent(path in path(), along in -40.0f32..80.0) {
        for way in [PathDirection::Forward, PathDirection::Backward] {
            let step = path.at(along + 0.01 * way.sign()) - path.at(along);
            let bend = path.segments().iter().any(|segment| {
                let ahead = (along.rem_euclid(path.length()) - segment.along) * way.sign();
                (-0.02..0.01).contains(&ahead) || (ahead - path.length()).abs() < 0.02
            });
            let straight = step.length() > 0.009 && !bend;
            prop_assert!(!straight || step.normalize().dot(path.tangent_at(along, way)) > 0.99);
        }
    }

    #[test]
    fn near_a_place_it_is_the_nearest_within_reach(
        path in path(), points in prop::collection::vec(point(14.0), 4), along in -50.0f32..120.0, reach in 0.0f32..15.0,
    ) {
        let within = if path.is_cyclic() { along.rem_euclid(path.length()) } else { along.clamp(0.0, path.length()) };
        let away = |at: f32| {
            let direct = (at - within).abs();
            if path.is_cyclic() { direct.min(path.length() - direct) } else { direct }
        };
        for p in points {
            let near = path.nearest_near(p, along, reach);
            prop_assert!(away(near.along) <= reach + 1e-3, "{near:?} is {} away", away(near.along));
            prop_assert!(path.at(near.along).distance(near.point) < 1e-3);
            let reached = samples(&path).into_iter().filter(|(at, ..)| away(*at) <= reach);
            let least = reached.map(|(_, at, radius)| p.distance(at) - radius).fold(f32::INFINITY, f32::min);
            prop_assert!(near.outside <= least + 1e-3, "{least} {near:?}");
            prop_assert!(near.outside >= path.nearest(p).outside - 1e-4);
        }
    }
}

/// Corners of an eight that crosses itself at the origin, rotated and moved.
fn eight(turn: Quat, shift: Vec3) -> Vec<Vec3> {
    let at = |k: u32| {
        let angle = k as f32 / 64.0 * std::f32::consts::TAU;
        turn * Vec3::new(10.0 * angle.sin(), 5.0 * (2.0 * angle).sin(), 0.0) + shift
    };
    (0..64).map(at).collect()
}

#[test]
fn walkers_on_an_eight_stay_on_their_arm() {
    let path = Pathway::new(&eight(Quat::from_rotation_x(0.7), Vec3::new(30.0, -8.0, 2.0)), 1.0, true).unwrap();
    for way in [PathDirection::Forward, PathDirection::Backward] {
        let (mut along, mut walked, mut jumps) = (0.5, 0.0, 0);
        while walked < 2.0 * path.length() {
            walked += 0.25;
            let truth = (0.5 + walked * way.sign()).rem_euclid(path.length());
            // beside the path, with an oscillating offset
            let aside = Vec3::Z * 0.4 * (3.0 * walked).sin() + Vec3::X * 0.3 * walked.cos();
            let at = path.at(truth) + aside;
            let near = path.nearest_near(at, along, 1.0);
            let off = |along: f32| (along - truth).abs().min(path.length() - (along - truth).abs());
            assert!(off(near.along) < 1.0, "{near:?}, but at {truth}");
            jumps += u32::from(off(path.nearest(at).along) > 2.0);
            along = near.along;
        }
        assert!(jumps > 0, "at the crossing the nearest place of all is on the other arm");
    }
}

#[test]
fn bad_paths_are_refused() {
    let says = |made: Result<Pathway, throng::Error>, words: &str| {
        let message = made.unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    };
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
    says(Pathway::new(&corners[..1], 1.0, false), "it has 1 points, but needs at least 2");
    says(Pathway::new(&corners[..2], 1.0, true), "it has 2 points, but needs at least 3");
    says(Pathway::new(&[], 1.0, false), "it has 0 points");
    says(Pathway::new(&corners, -1.0, false), "a radius of a path is -1");
    says(Pathway::new(&corners, f32::NAN, false), "a radius of a path");
    says(Pathway::with_radii(&corners, &[1.0], false), "1 radii for 2 segments");
    says(Pathway::new(&[Vec3::ZERO, Vec3::NAN], 1.0, false), "a coordinate of a path");
    says(Pathway::new(&[Vec3::ZERO, Vec3::X, Vec3::X], 1.0, false), "points 1 and 2 are the same");
    says(Pathway::new(&[Vec3::ZERO, Vec3::X, Vec3::ZERO], 1.0, true), "points 2 and 0 are the same");
}

#[test]
fn questions_that_are_not_numbers_do_no_harm() {
    for cyclic in [false, true] {
        let path = Pathway::new(&eight(Quat::IDENTITY, Vec3::ZERO), 1.0, cyclic).unwrap();
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            path.nearest(Vec3::splat(bad));
            path.nearest_near(Vec3::splat(bad), bad, bad);
            path.nearest_near(Vec3::ZERO, bad, 1.0);
            path.nearest_near(Vec3::ZERO, 1.0, bad);
            path.at(bad);
            path.tangent_at(bad, PathDirection::Backward);
        }
    }
}
