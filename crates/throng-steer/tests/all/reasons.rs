//! Traces of behaviours near walls and paths: probes, and the stretch of the path.

use crate::harness;
use glam::{DVec2, Vec3};
use throng::Obstacle;
use throng::motion::Motion;
use throng::parameters::Angle;
use throng::space::surface::{Barrier, Plane, SeenFrom, Sphere};
use throng::space::{PathDirection, Pathway};
use throng::steer::{Barriers, Behaviour, SteeringInput, SteeringReason, Target};
use throng_steer::{AvoidObstacles, Contain, FollowPath, FollowWall, Hide, Whiskers};

/// Returns the entries of one kind of a trace.
fn told(behaviour: &dyn Behaviour, motion: Motion, kind: impl Fn(&SteeringReason) -> Option<Vec3>) -> Vec<Vec3> {
    let (_, told) = harness::told(behaviour, &SteeringInput { motion, ..SteeringInput::default() });
    told.iter().filter_map(|told| kind(&told.reason)).collect()
}

#[test]
fn they_say_what_they_feel() {
    let feels = |reason: &SteeringReason| if let SteeringReason::Feels(end) = reason { Some(*end) } else { None };
    let wall = || Barriers::default().with(Plane::new(Vec3::X * 3.0, -Vec3::X).unwrap(), SeenFrom::Outside);
    let motion = Motion::moving(Vec3::ZERO, Vec3::X * 1.5);
    let ahead = told(&AvoidObstacles::from(wall()), motion, feels);
    assert!(ahead.len() == 1 && ahead[0].y == 0.0 && ahead[0].x >= 3.0, "two seconds ahead: {ahead:?}");
    let fan = told(&Whiskers::fan(wall(), 2.0, 1.0, Angle::from_radians(0.6)), motion, feels);
    let lengths: Vec<f32> = fan.iter().map(|end| (end.length() * 1e3).round() / 1e3).collect();
    assert_eq!(lengths, [2.0, 1.0, 1.0]);
    assert!(fan[1].y > 0.0 && fan[2].y < 0.0);
    let bowl = Contain::inside(Sphere::new(Vec3::ZERO, 9.0).unwrap());
    let on_ground = told(&bowl, motion, feels);
    assert!(on_ground.len() == 3 && on_ground.iter().all(|end| end.z == 0.0), "ahead and to both sides");
    assert_eq!(told(&FollowWall::from(wall()), motion, feels).len(), 1);
}

#[test]
fn they_say_which_part_of_a_path_they_follow() {
    let via = |reason: &SteeringReason| if let SteeringReason::Via(corner) = reason { Some(*corner) } else { None };
    let corners = [Vec3::ZERO, Vec3::X * 10.0, Vec3::new(10.0, 10.0, 0.0), Vec3::Y * 10.0];
    let path = Pathway::new(&corners, 1.0, true).unwrap();
    let motion = Motion::moving(Vec3::new(9.0, 0.5, 0.0), Vec3::X * 1.8);
    // 1.8 m/s for a second
    let follow = |way| FollowPath { direction: way, horizon: 1.0, ..FollowPath::new(path.clone()) };
    let near = |found: Vec<Vec3>, expected: &[Vec3]| {
        let same = found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| a.distance(*b) < 1e-4);
        assert!(same, "{found:?} and not {expected:?}");
    };
    let round = [Vec3::X * 9.0, Vec3::X * 10.0, Vec3::new(10.0, 0.8, 0.0)];
    near(told(&follow(PathDirection::Forward), motion, via), &round);
    near(told(&follow(PathDirection::Backward), motion, via), &[Vec3::X * 9.0, Vec3::X * 7.2]);
    let start = Motion::moving(Vec3::new(1.0, 0.0, 0.0), Vec3::X * 1.8);
    near(told(&follow(PathDirection::Backward), start, via), &[Vec3::X, Vec3::ZERO, Vec3::Y * 0.8]);
}

#[test]
fn pillars_hide_agents_on_the_ground() {
    let pillar = Obstacle::Circle { center: DVec2::new(3.0, 0.0), radius: 1.0 };
    let barriers = Barriers(vec![Barrier::of_obstacle(&pillar, DVec2::ZERO).unwrap()]);
    let aim = |reason: &SteeringReason| if let SteeringReason::Aim(place) = reason { Some(*place) } else { None };
    let hide = Hide { obstacles: barriers, gap: 0.3, ..Hide::new(Target::Point(Vec3::X * 9.0)) };
    let place = told(&hide, Motion::default(), aim);
    assert!(place[0].distance(Vec3::X * 1.5) < 1e-4, "on the far side of it: {place:?}");
}
