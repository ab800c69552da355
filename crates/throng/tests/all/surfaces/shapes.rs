//! Single shapes, rotated and moved, compared with samples.

use crate::surfaces::oracle::{Known, ball, point, rotation, sheet, sweep};
use glam::{Vec2, Vec3, Vec3Swizzles};
use proptest::prelude::*;
use std::f32::consts::TAU;
use throng::space::surface::{Capsule, Cuboid, Cylinder, Plane, Prism, Sphere, Surface};

/// Points round the circle, at these radii and heights.
fn rings(places: impl Iterator<Item = (f32, f32)>) -> Vec<Vec3> {
    let angle = |k: u32| k as f32 / 90.0 * TAU;
    places.flat_map(|(r, z)| (0..90).map(move |k| Vec3::new(r * angle(k).cos(), r * angle(k).sin(), z))).collect()
}

fn part(k: u32) -> f32 {
    k as f32 / 20.0
}

fn sphere() -> impl Strategy<Value = Known> {
    (point(3.0), 0.2f32..3.0).prop_map(|(center, radius)| {
        let samples = ball(3000).map(|p| center + p * radius).collect();
        Known::solid(Sphere::new(center, radius).unwrap(), samples, 0.05 * radius, move |p| p.distance(center) < radius)
    })
}

fn cuboid() -> impl Strategy<Value = Known> {
    (0.2f32..3.0, 0.2f32..3.0, 0.2f32..3.0).prop_map(|(x, y, z)| {
        let size = Vec3::new(x, y, z);
        let mut samples = vec![];
        for (a, b, c) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            let side = |axis: usize| Vec3::AXES[axis] * size[axis];
            for corner in [-size * 0.5, -size * 0.5 + side(c)] {
                samples.extend(sheet(corner, side(a), side(b), 24));
            }
        }
        let inside = move |p: Vec3| (p / size).abs().max_element() < 0.5;
        Known::solid(Cuboid::new(size).unwrap(), samples, 0.1, inside)
    })
}

fn rectangle() -> impl Strategy<Value = Known> {
    (0.2f32..4.0, 0.2f32..4.0).prop_map(|(x, y)| Known {
        surface: Box::new(Cuboid::rectangle(Vec2::new(x, y)).unwrap()),
        samples: sheet(Vec3::new(-x, -y, 0.0) * 0.5, Vec3::X * x, Vec3::Y * y, 40).collect(),
        cover: 0.08,
        inside: None,
    })
}

fn plane() -> impl Strategy<Value = Known> {
    (-2.0f32..2.0).prop_map(|z| {
        let samples = sheet(Vec3::new(-40.0, -40.0, z), Vec3::X * 80.0, Vec3::Y * 80.0, 80).collect();
        Known::solid(Plane::new(Vec3::Z * z, Vec3::Z * 3.0).unwrap(), samples, 0.75, move |p| p.z < z)
    })
}

fn cylinder() -> impl Strategy<Value = Known> {
    (0.2f32..2.5, 0.3f32..4.0).prop_map(|(radius, height)| {
        let side = (0..=20).map(|k| (radius, part(k) * height));
        let ends = (0..=20).flat_map(|k| [(part(k) * radius, 0.0), (part(k) * radius, height)]);
        let surface = Cylinder::new(Vec3::ZERO, Vec3::Z * height, radius).unwrap();
        let inside = move |p: Vec3| p.xy().length() < radius && p.z > 0.0 && p.z < height;
        Known::solid(surface, rings(side.chain(ends)), 0.2, inside)
    })
}

fn capsule() -> impl Strategy<Value = Known> {
    (0.2f32..2.5, prop_oneof![Just(0.0f32), 0.3f32..4.0]).prop_map(|(radius, length)| {
        let end = Vec3::Z * length;
        let mut samples = rings((0..=20).map(|k| (radius, part(k) * length)));
        samples.extend(ball(2000).map(|p| p * radius + if p.z > 0.0 { end } else { Vec3::ZERO }));
        let inside = move |p: Vec3| p.distance(Vec3::Z * p.z.clamp(0.0, length)) < radius;
        Known::solid(Capsule::new(Vec3::ZERO, end, radius).unwrap(), samples, 0.2, inside)
    })
}

/// A polygon round the origin: corners at these distances, at equal angles. Often not convex.
pub fn star() -> impl Strategy<Value = Vec<Vec2>> {
    let corners = |radii: Vec<f32>| {
        let turn = TAU / radii.len() as f32;
        radii.iter().enumerate().map(|(i, &r)| Vec2::from_angle(i as f32 * turn) * r).collect()
    };
    prop::collection::vec(0.5f32..3.0, 4..9).prop_map(corners)
}

/// Whether a point is inside the polygon of [`star`]: nearer than the side in its direction.
pub fn inside_star(corners: &[Vec2], p: Vec2) -> bool {
    let next = |i: usize| corners[(i + 1) % corners.len()];
    (0..corners.len()).any(|i| {
        let (a, b) = (corners[i], next(i));
        a.perp_dot(p) >= 0.0 && p.perp_dot(b) >= 0.0 && (b - a).perp_dot(p - a) > 0.0
    })
}

fn prism() -> impl Strategy<Value = Known> {
    (star(), -2.0f32..0.0, 0.3f32..3.0, any::<bool>()).prop_map(|(corners, bottom, top, around)| {
        let mut samples = vec![];
        for (i, &corner) in corners.iter().enumerate() {
            let next = corners[(i + 1) % corners.len()];
            samples.extend(sheet(corner.extend(bottom), (next - corner).extend(0.0), Vec3::Z * (top - bottom), 30));
        }
        for z in [bottom, top] {
            let all = sheet(Vec3::new(-3.0, -3.0, z), Vec3::X * 6.0, Vec3::Y * 6.0, 60);
            samples.extend(all.filter(|p| inside_star(&corners, p.xy())));
        }
        let given: Vec<Vec2> = if around { corners.clone() } else { corners.iter().rev().copied().collect() };
        let surface = Prism::new(&given, bottom, top).unwrap();
        let inside = move |p: Vec3| inside_star(&corners, p.xy()) && p.z > bottom && p.z < top;
        Known::solid(surface, samples, 0.2, inside)
    })
}

fn ground() -> impl Strategy<Value = Known> {
    star().prop_map(|corners| {
        let mut samples = vec![];
        for (i, &corner) in corners.iter().enumerate() {
            let next = corners[(i + 1) % corners.len()];
            let up = Vec3::Z * 60.0;
            samples.extend(sheet(corner.extend(-30.0), (next - corner).extend(0.0), up, 150));
        }
        let surface = Prism::ground(&corners).unwrap();
        Known::solid(surface, samples, 0.5, move |p| inside_star(&corners, p.xy()))
    })
}

fn shape() -> impl Strategy<Value = Known> {
    let any = prop_oneof![sphere(), cuboid(), rectangle(), plane(), cylinder(), capsule(), prism(), ground()];
    (any, point(2.0), rotation()).prop_map(|(shape, position, turn)| shape.moved(position, turn))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn the_nearest_point_is_that_of_the_samples(shape in shape(), points in prop::collection::vec(point(6.0), 8)) {
        for p in points {
            shape.check_query(p)?;
        }
    }

    #[test]
    fn the_distance_grows_no_faster_than_one_goes(
        shape in shape(), from in point(6.0), step in point(1.0), scale in 0.0f32..1.0,
    ) {
        shape.check_slope(from, from + step * scale)?;
        // across the nearest point of the surface
        let near = shape.surface.query(from);
        shape.check_slope(near.point - near.normal * 0.01, near.point + step * 0.02)?;
    }

    #[test]
    fn a_ball_touches_where_it_first_meets_the_surface(shape in shape(), sweeps in prop::collection::vec(sweep(), 6)) {
        for sweep in sweeps {
            shape.check_sweep(&sweep)?;
        }
    }

    #[test]
    fn distances_move_with_the_shape(shape in star(), p in point(5.0), shift in point(500.0), turn in rotation()) {
        let prism = || Known::solid(Prism::new(&shape, -1.0, 1.0).unwrap(), vec![], 0.0, |_| true);
        let here = prism().surface.query(p);
        let there = prism().moved(shift, turn).surface.query(turn * p + shift);
        prop_assert!((here.distance - there.distance).abs() < 1e-3);
        prop_assert!((turn * here.point + shift).distance(there.point) < 1e-3 || here.distance < 0.0);
    }
}

#[test]
fn a_ray_from_far_away_finds_a_small_ball() {
    let ball = Sphere::new(Vec3::ZERO, 0.5).unwrap();
    let hit = ball.ray(Vec3::new(-1000.0, 0.3, 0.0), Vec3::X, f32::INFINITY).unwrap();
    assert!((hit.distance - 999.6).abs() < 1e-3, "{hit:?}");
    assert!(hit.point.distance(Vec3::new(-0.4, 0.3, 0.0)) < 1e-3);
    let past = ball.ray(Vec3::new(-1000.0, 0.501, 0.0), Vec3::X, f32::INFINITY);
    assert_eq!(past, None);
}
