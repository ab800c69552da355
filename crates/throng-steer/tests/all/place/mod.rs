//! Behaviours that query the world's geometry: no agent leaves or touches it, and all agents arrive.

mod containers;
mod crowds;
mod hiding;
mod obstacles;
mod paths;
mod walls;

use crate::harness::{Actor, Stage, ask, flier, rotation, vector};
use glam::{Quat, Vec3};
use proptest::prelude::*;
use std::sync::Arc;
use throng::motion::Motion;
use throng::parameters::Angle;
use throng::space::surface::{Cuboid, Cylinder, Moved, Plane, Pose, SeenFrom, Sphere, Surface};
use throng::space::{PathDirection, Pathway};
use throng::steer::{Barriers, Behaviour, BoxedBehaviour, Target};
use throng_steer::{
    AvoidObstacles, Contain, FollowPath, FollowWall, Hide, Priority, StayOnPath, TargetSpeed, Whiskers,
};

type Shared = Arc<dyn Surface>;

fn first(parts: Vec<BoxedBehaviour>) -> Priority {
    Priority { epsilon: 0.0, parts }
}

/// Obstacles between x = 3 and x = 15, with space between them.
fn field() -> impl Strategy<Value = Vec<Shared>> {
    let one = (3.0f32..15.0, -5.0f32..5.0, 0.3f32..1.2, 0.0f32..6.0, 0usize..3);
    prop::collection::vec(one, 1..14).prop_map(|all| {
        let mut places: Vec<(Vec3, f32)> = vec![];
        let mut field: Vec<Shared> = vec![];
        for (x, y, size, turn, kind) in all {
            let place = Vec3::new(x, y, 0.0);
            let around = if kind == 1 { size * 2.0f32.sqrt() } else { size };
            if places.iter().any(|(other, radius)| other.distance(place) < radius + around + 0.9) {
                continue;
            }
            places.push((place, around));
            field.push(match kind {
                0 => Arc::new(Sphere::new(place, size).unwrap()),
                1 => {
                    let cube = Cuboid::new(Vec3::splat(2.0 * size)).unwrap();
                    Arc::new(Moved::new(cube, Pose::new(place, Quat::from_rotation_z(turn)).unwrap()))
                }
                _ => Arc::new(Cylinder::new(place - Vec3::Z, place + Vec3::Z, size).unwrap()),
            });
        }
        field
    })
}

fn barriers(surfaces: &[Shared]) -> Barriers {
    surfaces.iter().fold(Barriers::default(), |all, surface| all.with(surface.clone(), SeenFrom::Outside))
}

fn nearest(surfaces: &[Shared], at: Vec3) -> f32 {
    surfaces.iter().map(|surface| surface.query(at).distance).fold(f32::INFINITY, f32::min)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    /// No behaviour depends on the direction of the axes.
    #[test]
    fn turned_scenes_give_turned_forces(by in rotation(), place in vector(3.0), velocity in vector(1.5)) {
        prop_assume!(velocity.length() > 0.3);
        let all = |by: Quat| -> Vec<BoxedBehaviour> {
            let shape = |surface: Shared, at: Vec3| Arc::new(Moved::new(surface, Pose::new(by * at, by).unwrap())) as Shared;
            let ball = shape(Arc::new(Sphere::new(Vec3::ZERO, 1.0).unwrap()), Vec3::new(1.5, 1.0, 0.2));
            let block = shape(Arc::new(Cuboid::new(Vec3::new(1.0, 2.0, 1.5)).unwrap()), Vec3::new(-1.5, -1.0, 0.3));
            let room = shape(Arc::new(Cuboid::new(Vec3::new(9.0, 8.0, 7.0)).unwrap()), Vec3::ZERO);
            let solid = barriers(&[ball, block]);
            let goal = Target::Point(by * Vec3::new(0.3, -7.0, 2.0));
            let corners = [Vec3::ZERO, Vec3::new(4.0, 1.0, 0.5), Vec3::new(5.0, 5.0, -1.0)].map(|p| by * p);
            let path = Pathway::new(&corners, 0.7, false).unwrap();
            vec![
                AvoidObstacles { towards: goal, ..AvoidObstacles::from(solid.clone()) }.into(),
                Contain::inside(room).into(),
                FollowWall::from(solid.clone()).into(),
                Whiskers::fan(solid.clone(), 3.0, 2.0, Angle::degrees(30.0)).into(),
                Whiskers::parallel(solid.clone(), 3.0, 0.4).into(),
                Hide { obstacles: solid, ..Hide::new(goal) }.into(),
                FollowPath::new(path.clone()).into(),
                FollowPath { direction: PathDirection::Backward, ..FollowPath::new(path.clone()) }.into(),
                StayOnPath { path: Arc::new(path), horizon: 0.5 }.into(),
            ]
        };
        let idle = || BoxedBehaviour::from(TargetSpeed { speed: 0.0 });
        let stage = Stage::new(0.02, vec![Actor::new(Motion::moving(place, velocity), flier(), idle())]);
        let turned = stage.turned(by);
        // where a tiny difference decides, rounding may decide differently
        let nudges = Vec3::AXES.into_iter().flat_map(|axis| [axis, -axis]).flat_map(|v| [(v * 1e-3, Vec3::ZERO), (Vec3::ZERO, v * 1e-3)]);
        let nudged = nudges.map(|(by, faster)| {
            Stage::new(0.02, vec![Actor::new(Motion::moving(place + by, velocity + faster), flier(), idle())])
        });
        let nudged: Vec<Stage> = nudged.collect();
        for (plain, other) in all(Quat::IDENTITY).iter().zip(all(by)) {
            let says = |stage: &Stage, behaviour: &BoxedBehaviour| {
                ask(&**behaviour, &stage.view(0, &[])).map_or(Vec3::ZERO, |said| said.force)
            };
            let force = says(&stage, plain);
            let steady = nudged.iter().all(|stage| says(stage, plain).distance(force) < 0.1);
            let off = (by * force).distance(says(&turned, &other));
            prop_assert!(!steady || off < 2e-2 * (1.0 + force.length()), "{plain:?}: {off}");
        }
    }
}

#[test]
fn mistakes_are_named() {
    let none = Barriers::default;
    let path = || Pathway::new(&[Vec3::ZERO, Vec3::X], 1.0, false).unwrap();
    let plane = || Contain::inside(Plane::new(Vec3::ZERO, Vec3::X).unwrap());
    let wrong: Vec<BoxedBehaviour> = vec![
        AvoidObstacles { horizon: 0.0, ..AvoidObstacles::from(none()) }.into(),
        AvoidObstacles { gap: -1.0, ..AvoidObstacles::from(none()) }.into(),
        AvoidObstacles { keeps: f32::NAN, ..AvoidObstacles::from(none()) }.into(),
        Contain { horizon: f32::INFINITY, ..plane() }.into(),
        Contain { angle: Angle::degrees(200.0), ..plane() }.into(),
        Contain { gap: -0.1, ..plane() }.into(),
        FollowWall { offset: 0.0, ..FollowWall::from(none()) }.into(),
        FollowWall { horizon: -1.0, ..FollowWall::from(none()) }.into(),
        FollowWall { range: 0.0, ..FollowWall::from(none()) }.into(),
        Whiskers::single(none(), 0.0).into(),
        Whiskers::fan(none(), 1.0, 1.0, Angle::degrees(200.0)).into(),
        Whiskers::parallel(none(), 1.0, f32::NAN).into(),
        Whiskers { clearance: 0.0, ..Whiskers::single(none(), 1.0) }.into(),
        Hide { gap: -1.0, ..Hide::new(Target::Goal) }.into(),
        Hide { range: 0.0, ..Hide::new(Target::Goal) }.into(),
        Hide { slowing_distance: -1.0, ..Hide::new(Target::Goal) }.into(),
        FollowPath { horizon: 0.0, ..FollowPath::new(path()) }.into(),
        FollowPath { slowing_distance: -1.0, ..FollowPath::new(path()) }.into(),
        StayOnPath { path: Arc::new(path()), horizon: -1.0 }.into(),
    ];
    wrong.iter().for_each(|behaviour| assert!(behaviour.check().is_err(), "{behaviour:?}"));
    assert!(AvoidObstacles::from(none()).check().is_ok() && plane().check().is_ok());
}
