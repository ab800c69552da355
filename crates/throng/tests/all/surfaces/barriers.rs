//! What vehicles detect ahead, from the permitted side and from the forbidden side.

use crate::surfaces::oracle::{direction, point, rotation};
use glam::{Vec2, Vec3};
use proptest::prelude::*;
use throng::space::surface::{Barrier, Cuboid, Moved, Plane, Pose, Prism, SeenFrom, Sphere, Surface};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn each_side_sees_what_it_should(
        at in point(4.0), turn in rotation(), position in point(6.0), forward in direction(), radius in 0.0f32..0.8,
    ) {
        let solid = Moved::new(Cuboid::new(Vec3::new(5.0, 3.0, 4.0)).unwrap(), Pose::new(at, turn).unwrap());
        let near = solid.query(position);
        prop_assume!(near.distance.abs() > radius + 0.01);
        for seen_from in [SeenFrom::Outside, SeenFrom::Inside, SeenFrom::Both] {
            let seen = Barrier::new(solid.clone(), seen_from).ahead(position, forward * 3.0, radius, 30.0);
            let wrong = match seen_from {
                SeenFrom::Outside => near.is_inside(),
                SeenFrom::Inside => !near.is_inside(),
                SeenFrom::Both => false,
            };
            let Some(seen) = seen else {
                prop_assert!(!wrong && !near.is_inside());
                continue;
            };
            prop_assert_eq!(seen.vehicle_outside, !near.is_inside());
            prop_assert!((seen.steer_hint.length() - 1.0).abs() < 1e-4);
            if wrong {
                prop_assert_eq!((seen.distance, seen.point), (0.0, near.point));
                // a step along the hint leads towards the other side
                let step = solid.query(position + seen.steer_hint * 0.01).distance.abs();
                prop_assert!(step < near.distance.abs());
            } else {
                prop_assert!(seen.steer_hint.dot(forward).abs() < 1e-3, "the hint does not lead aside");
                let free = if seen.vehicle_outside { seen.normal } else { -seen.normal };
                let aside = free - forward * free.dot(forward);
                prop_assert!(aside.length() < 0.05 || aside.dot(seen.steer_hint) > 0.0);
                let touch = position + forward * seen.distance;
                prop_assert!((touch.distance(seen.point) - radius).abs() < 1e-3);
            }
        }
    }
}

#[test]
fn a_head_on_vehicle_goes_round_the_nearer_side() {
    let wall = Moved::new(Cuboid::new(Vec3::new(1.0, 10.0, 3.0)).unwrap(), Pose::at(Vec3::X * 10.0).unwrap());
    let wall = Barrier::new(wall, SeenFrom::Outside);
    let hint = |y: f32| wall.ahead(Vec3::Y * y, Vec3::X, 0.5, 20.0).unwrap().steer_hint;
    assert_eq!((hint(2.0), hint(-2.0)), (Vec3::Y, -Vec3::Y));
    assert_eq!(hint(0.0), -Vec3::Y, "straight at its middle: to the right");
    let room = [Vec2::new(0.0, 0.0), Vec2::new(9.0, 0.0), Vec2::new(9.0, 6.0), Vec2::new(0.0, 6.0)];
    let room = Barrier::new(Prism::new(&room, -1.0, 1.0).unwrap(), SeenFrom::Inside);
    let hint = room.ahead(Vec3::new(2.0, 1.0, 0.0), Vec3::X, 0.5, 20.0).unwrap().steer_hint;
    assert_eq!(hint, Vec3::Y, "in a room to its middle");
    let cliff = Barrier::new(Plane::new(Vec3::ZERO, Vec3::Z).unwrap(), SeenFrom::Both);
    let dive = cliff.ahead(Vec3::Z, -Vec3::Z, 0.1, 5.0).unwrap();
    assert!((dive.distance - 0.9).abs() < 1e-6 && dive.steer_hint == Vec3::X);
}

#[test]
fn a_standing_vehicle_detects_only_contacts() {
    let ball = Barrier::new(Sphere::new(Vec3::ZERO, 2.0).unwrap(), SeenFrom::Outside);
    let at = |x: f32| ball.ahead(Vec3::X * x, Vec3::ZERO, 0.5, 9.0);
    assert_eq!(at(2.6), None);
    let touching = at(2.4).unwrap();
    assert_eq!((touching.distance, touching.steer_hint), (0.0, Vec3::X));
    assert_eq!(at(1.0).unwrap().steer_hint, Vec3::X, "out of what it stands in");
    assert_eq!(ball.ahead(Vec3::X, Vec3::splat(f32::NAN), 0.5, 9.0).unwrap().distance, 0.0);
}

#[test]
fn a_touching_vehicle_that_turns_away_is_free() {
    let ball = Barrier::new(Sphere::new(Vec3::ZERO, 2.0).unwrap(), SeenFrom::Outside);
    assert_eq!(ball.ahead(Vec3::X * 2.4, Vec3::X, 0.5, 9.0), None);
    assert_eq!(ball.ahead(Vec3::X * 2.4, -Vec3::X, 0.5, 9.0).unwrap().distance, 0.0);
    let cave = Barrier::new(Sphere::new(Vec3::ZERO, 2.0).unwrap(), SeenFrom::Inside);
    let across = cave.ahead(Vec3::X * 1.7, -Vec3::X, 0.5, 9.0).unwrap();
    assert!((across.distance - 3.2).abs() < 1e-5, "touching one side it goes on to the other: {across:?}");
}
