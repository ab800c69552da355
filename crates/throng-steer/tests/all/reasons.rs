//! Traces of behaviours: probes near walls, the stretch of a path, and constructions.

use crate::harness;
use glam::{DVec2, Vec3};
use throng::Obstacle;
use throng::motion::Motion;
use throng::parameters::Angle;
use throng::space::surface::{Barrier, Plane, SeenFrom, Sphere};
use throng::space::{PathDirection, Pathway};
use throng::steer::{Barriers, Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};
use throng_steer::{
    Arrive, AvoidObstacles, Contain, FollowPath, FollowWall, Hide, Seek, Wander, WeightedSum, Whiskers,
};

/// Returns the entries of one kind of a trace.
fn told<T>(behaviour: &dyn Behaviour, motion: Motion, kind: impl Fn(&SteeringReason) -> Option<T>) -> Vec<T> {
    let (_, told) = harness::told(behaviour, &SteeringInput { motion, ..SteeringInput::default() });
    told.iter().filter_map(|told| kind(&told.reason)).collect()
}

#[test]
fn they_say_what_they_feel() {
    let feels = |reason: &SteeringReason| if let SteeringReason::Feels(end) = reason { Some(*end) } else { None };
    let wall = || Barriers::default().with(Plane::new(Vec3::X * 3.0, -Vec3::X).unwrap(), SeenFrom::Outside);
    let motion = Motion::moving(Vec3::ZERO, Vec3::X * 1.5);
    let sweeps = |reason: &SteeringReason| match *reason {
        SteeringReason::Cylinder { from, to, radius } => Some((from, to, radius)),
        _ => None,
    };
    let avoid = AvoidObstacles::from(wall());
    let swept = told(&avoid, motion, sweeps);
    assert!(swept.len() == 1 && swept[0].0 == Vec3::ZERO, "{swept:?}");
    assert!(swept[0].1.y == 0.0 && swept[0].1.x >= 3.0 && swept[0].2 > avoid.gap, "two seconds ahead: {swept:?}");
    let hits = |reason: &SteeringReason| match *reason {
        SteeringReason::Hits { point, normal } => Some((point, normal)),
        _ => None,
    };
    let hit = told(&avoid, motion, hits);
    assert!(hit.len() == 1 && (hit[0].0.x - 3.0).abs() < 1e-4 && hit[0].1.distance(-Vec3::X) < 1e-4, "{hit:?}");
    let fan = told(&Whiskers::fan(wall(), 2.0, 1.0, Angle::from_radians(0.6)), motion, feels);
    let lengths: Vec<f32> = fan.iter().map(|end| (end.length() * 1e3).round() / 1e3).collect();
    assert_eq!(lengths, [2.0, 1.0, 1.0]);
    assert!(fan[1].y > 0.0 && fan[2].y < 0.0);
    let bowl = Contain::inside(Sphere::new(Vec3::ZERO, 9.0).unwrap());
    let on_ground = told(&bowl, motion, feels);
    assert!(on_ground.len() == 3 && on_ground.iter().all(|end| end.z == 0.0), "ahead and to both sides");
    assert_eq!(told(&FollowWall::from(wall()), motion, feels).len(), 1);
}

/// The constructions of Reynolds 1999: wander's big circle, the slowing circle, and terms that add up.
#[test]
fn they_say_what_they_construct() {
    let circle = |reason: &SteeringReason| match *reason {
        SteeringReason::Circle { center, radius } => Some((center, radius)),
        _ => None,
    };
    let motion = Motion::moving(Vec3::ZERO, Vec3::X);
    let wander = told(&Wander { strength: 0.7, ..Wander::default() }, motion, circle);
    assert_eq!(wander.len(), 2);
    assert!(wander[0].0.distance(Vec3::X * 2.0f32.sqrt()) < 1e-5 && wander[0].1 == 0.7, "{wander:?}");
    assert!(wander[1].1 < wander[0].1, "a step of the target is small");
    let target = Target::Point(Vec3::X * 9.0);
    let slowing = told(&Arrive { slowing_distance: 4.0, ..Arrive::new(target) }, motion, circle);
    assert!(slowing.len() == 1 && slowing[0].0 == Vec3::X * 9.0 && slowing[0].1 >= 4.0 - 1e-4, "{slowing:?}");
    let adds = |reason: &SteeringReason| if let SteeringReason::Adds(term) = reason { Some(*term) } else { None };
    let seek = |to: Vec3| Seek { target: Target::Point(to) };
    let sum = WeightedSum(vec![(0.5, seek(Vec3::Y).into()), (0.25, seek(-Vec3::X).into())]);
    let view = SteeringInput { motion, ..SteeringInput::default() };
    let said = sum.steer(&view, &mut [], &mut TraceRecorder::default()).unwrap();
    let terms = told(&sum, motion, adds);
    assert_eq!(terms.len(), 2);
    assert!((terms[0] + terms[1]).distance(said.force / view.vehicle.mass) < 1e-5, "{terms:?}");
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
