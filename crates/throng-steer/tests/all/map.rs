//! Driving by a map of cells; the solids are circles, so that distances are exact.

use crate::harness::{Actor, Stage, ask};
use glam::{Vec2, Vec3};
use std::sync::Arc;
use throng::Error;
use throng::motion::{Motion, Vehicle};
use throng::space::{Pathway, Raster};
use throng::steer::{Behaviour, SteeringInput, Target};
use throng_steer::{DriveByMap, FollowPath, Seek, TargetSpeed, WeightedSum};

const CELL: f32 = 0.5;

fn map(rocks: &[(Vec2, f32)]) -> Arc<Raster> {
    let solid = |at: Vec2| rocks.iter().any(|(center, radius)| at.distance(*center) < *radius);
    Arc::new(Raster::of(Vec2::splat(-60.0), Vec2::splat(60.0), CELL, solid).unwrap())
}

#[test]
fn a_map_is_what_it_was_made_of() {
    let cells = [true, false, false, false, true, true];
    let map = Raster::new(Vec2::new(-3.0, 10.0), 2.0, 3, cells.to_vec()).unwrap();
    for (i, solid) in cells.into_iter().enumerate() {
        let middle = Vec2::new(-2.0 + 2.0 * (i % 3) as f32, 11.0 + 2.0 * (i / 3) as f32);
        for off in [Vec2::ZERO, Vec2::splat(0.99), Vec2::splat(-0.99)] {
            assert_eq!(map.is_solid(middle + off), solid, "cell {i}");
        }
    }
    for beyond in [Vec2::new(-3.1, 11.0), Vec2::new(3.1, 11.0), Vec2::new(0.0, 9.9), Vec2::new(0.0, 14.1), Vec2::NAN] {
        assert!(map.is_solid(beyond), "{beyond}");
    }
    for (columns, cells) in [(0, 6), (4, 6)] {
        assert!(matches!(Raster::new(Vec2::ZERO, 1.0, columns, vec![false; cells]), Err(Error::Shape { .. })));
    }
    for cell in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e-6] {
        assert!(Raster::of(Vec2::ZERO, Vec2::splat(9.0), cell, |_| false).is_err(), "{cell}");
    }
}

#[test]
fn where_the_way_is_free_it_does_what_its_part_would() {
    let part = || Seek { target: Target::Point(Vec3::new(9.0, 9.0, 0.0)) };
    let view = SteeringInput { motion: Motion::moving(Vec3::ZERO, Vec3::X), ..SteeringInput::default() };
    assert_eq!(ask(&DriveByMap::new(map(&[]), part()), &view), ask(&part(), &view));
    let rock = (Vec2::X * 5.0, 2.0);
    let blocked = ask(&DriveByMap::new(map(&[rock]), part()), &view).expect("a rock is ahead");
    assert!(blocked.force.y > 0.0, "where its part goes, to the left");
    let wrong = DriveByMap { horizon: 0.0, ..DriveByMap::new(map(&[]), part()) };
    assert!(matches!(wrong.check(), Err(Error::Limit { what: "horizon", .. })));
}

/// A course with rocks on it: no contact, and the same number of laps within a tenth at every time step, on arcs and on
/// straight lines.
#[test]
fn it_drives_among_rocks() {
    let corners = [(-40.0, -40.0), (40.0, -40.0), (40.0, 40.0), (-40.0, 40.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
    let path = Pathway::new(&corners, 6.0, true).unwrap();
    let rocks = [
        (0.0, -39.0, 3.0),
        (41.5, 5.0, 3.5),
        (-3.0, 42.0, 2.5),
        (-39.0, 3.0, 4.0),
        (18.0, 18.0, 9.0),
        (-15.0, -20.0, 6.0),
    ]
    .map(|(x, y, radius)| (Vec2::new(x, y), radius));
    for curved in [true, false] {
        let mut lengths = vec![];
        for seconds in [0.02, 0.04, 0.1] {
            let follow = FollowPath { horizon: 1.2, ..FollowPath::new(path.clone()) };
            let part = WeightedSum(vec![(1.0, follow.into()), (1.0, TargetSpeed { speed: 8.0 }.into())]);
            let drive = DriveByMap { curved, ..DriveByMap::new(map(&rocks), part) };
            let vehicle = Vehicle { max_speed: 10.0, max_force: 8.0, low_speed: 0.2, ..Vehicle::default() };
            let start = Motion::moving(corners[0], Vec3::X * 5.0);
            let mut stage = Stage::new(seconds, vec![Actor::new(start, vehicle, drive)]);
            let (mut near, mut walked) = (f32::INFINITY, 0.0);
            stage.run(120.0, |stage| {
                let at = stage.actors[0].motion.position.truncate();
                near = rocks.iter().map(|(center, radius)| center.distance(at) - radius).fold(near, f32::min);
                walked += stage.actors[0].motion.speed() * seconds;
            });
            // the body of the harness, less the cells that its rim may share with a rock
            assert!(near > 0.2 - 0.71 * CELL, "curved {curved}, step {seconds}: {near} m");
            lengths.push(walked);
        }
        let (least, most) = lengths.iter().fold((f32::INFINITY, 0.0f32), |(low, high), &x| (low.min(x), high.max(x)));
        assert!(least > 600.0 && most < 1.1 * least, "curved {curved}: {lengths:?}");
    }
}
