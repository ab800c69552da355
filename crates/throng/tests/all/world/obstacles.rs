//! Obstacles are added and removed while the world runs: paths are planned anew, no agent stays in a wall.

use crate::world::common::{Draw, rectangle, run, run_for, walker, world};
use crate::world::oracle::{assert_free, distance_to, obstacles};
use glam::DVec2;
use throng::motion::Holonomic;
use throng::{Agent, Obstacle, Status, Walkable, World};

fn wall(points: &[DVec2]) -> Obstacle {
    Obstacle::Wall { points: points.to_vec() }
}

/// A single agent on its way from one end of a street to the other, 20 m. Returns the world, the middle and the
/// direction of the street.
fn street(angle: f64) -> (World, DVec2, DVec2) {
    let mut world = world(0.04, DVec2::new(2500.0, -7100.0));
    let origin = world.settings().origin;
    let along = DVec2::from_angle(angle);
    let agent = walker(&mut world, origin - along * 10.0, origin + along * 10.0);
    world.add_agent(agent).unwrap();
    (world, origin, along)
}

#[test]
fn an_added_wall_is_walked_round() {
    for angle in [0.0, 0.7, 2.9] {
        let (mut world, origin, along) = street(angle);
        run_for(&mut world, 3.0, |_| {});
        let side = along.perp();
        world.add_obstacle(wall(&[origin - side * 6.0, origin + side * 2.0])).unwrap();
        run(&mut world, 60.0, assert_free);
        assert!(world.finished(), "{angle}");
        let walked = world.relative_columns().trip(0).walked;
        assert!(walked > 20.3 && walked < 22.5, "round the near end: {walked} m");
    }
}

#[test]
fn a_removed_wall_is_walked_through() {
    let (mut world, origin, along) = street(1.3);
    let side = along.perp();
    let id = world.add_obstacle(wall(&[origin - side * 25.0, origin + side * 25.0])).unwrap();
    run_for(&mut world, 3.0, assert_free);
    assert!(world.remove_obstacle(id));
    assert!(!world.remove_obstacle(id), "it is gone");
    run(&mut world, 60.0, |_| {});
    assert!(world.finished());
    assert!(world.relative_columns().trip(0).walked < 25.0, "{}", world.relative_columns().trip(0).walked);
}

#[test]
fn a_locked_in_agent_goes_on_when_the_door_opens() {
    let (mut world, origin, along) = street(-0.5);
    let start = origin - along * 10.0;
    let mut ring = rectangle(start, DVec2::splat(3.0), 1.0);
    ring.push(ring[0]);
    world.add_obstacle(wall(&ring[..4])).unwrap();
    let door = world.add_obstacle(wall(&ring[3..])).unwrap();
    run_for(&mut world, 2.0, assert_free);
    assert_eq!(world.relative_columns().status[0], Status::Stranded);
    assert_eq!(world.stranded().len(), 1);
    world.remove_obstacle(door);
    run(&mut world, 60.0, assert_free);
    assert_eq!(world.summary().arrived, 1);
    assert!(world.stranded().is_empty(), "{:?}", world.stranded());
}

#[test]
fn a_wall_round_the_goal_strands_and_its_removal_frees() {
    let (mut world, origin, along) = street(2.2);
    run_for(&mut world, 4.0, |_| {});
    let id = world.add_obstacle(Obstacle::Circle { center: origin + along * 10.0, radius: 1.5 }).unwrap();
    run_for(&mut world, 1.0, assert_free);
    assert_eq!(world.relative_columns().status[0], Status::Stranded);
    world.remove_obstacle(id);
    run(&mut world, 60.0, assert_free);
    assert_eq!(world.summary().arrived, 1);
}

/// Agents with bodies that touch an added obstacle are pushed out.
#[test]
fn agents_that_an_obstacle_touches_are_pushed_out() {
    let at = DVec2::new(0.1, 0.05);
    let touching = [
        Obstacle::Circle { center: DVec2::new(0.5, 0.3), radius: 0.5 },
        Obstacle::rectangle(DVec2::new(0.7, 0.1), DVec2::new(1.3, 1.0), 0.1),
        Obstacle::Polygon { corners: [(0.1, 0.02), (3.0, 1.0), (3.0, -1.0)].map(DVec2::from).to_vec() },
        wall(&[at + DVec2::new(-2.0, -0.15), at + DVec2::new(2.0, 0.1)]),
        wall(&[DVec2::new(0.05, 0.0), DVec2::new(2.0, 0.0)]),
        wall(&[DVec2::new(-2.0, 1e-5), DVec2::new(2.0, 1e-5)]),
    ];
    for (case, obstacle) in touching.into_iter().enumerate() {
        for walks in [false, true] {
            let mut world = world(0.04, DVec2::ZERO);
            let agent = if walks { walker(&mut world, DVec2::ZERO, DVec2::new(4.0, 3.0)) } else { Agent::default() };
            let id = world.add_agent(Agent { radius: 0.2, ..agent }).unwrap();
            world.add_obstacle(obstacle.clone()).unwrap();
            let mut fastest: f32 = 0.0;
            run_for(&mut world, 15.0, |world| fastest = world.relative_columns().velocity[0].length().max(fastest));
            let distance = distance_to(&obstacle, world.position(id).unwrap().truncate());
            assert!(distance >= 0.2 * (1.0 - 1e-4), "case {case}, walks {walks}: {distance} m");
            assert!(world.finished() && world.stranded().is_empty(), "case {case}, walks {walks}");
            assert!(fastest <= 1.8 + 1e-3, "case {case}: {fastest} m/s");
        }
    }
}

#[test]
fn an_obstacle_on_the_centre_of_an_agent_is_refused() {
    let mut world = world(0.04, DVec2::new(1e4, 1e4));
    let position = world.settings().origin + DVec2::new(3.0, 4.0);
    world.add_agent(Agent::at(position)).unwrap();
    let corners = rectangle(position, DVec2::splat(1.0), 0.3);
    let through = wall(&[position - DVec2::new(2.0, 1.0), position + DVec2::new(4.0, 2.0)]);
    for obstacle in [Obstacle::Circle { center: position, radius: 0.1 }, Obstacle::Polygon { corners }, through] {
        let message = world.add_obstacle(obstacle).unwrap_err().to_string();
        assert!(message.contains("(10003, 10004)") && message.contains("inside an obstacle"), "{message}");
    }
    let outer = rectangle(position + DVec2::splat(5.0), DVec2::splat(4.0), 0.0);
    let message = world.set_walkable(vec![Walkable { outer, holes: vec![] }]).unwrap_err().to_string();
    assert!(message.contains("(10003, 10004)") && message.contains("outside the walkable area"), "{message}");
    assert_eq!(*world.place(), throng::space::Place::default(), "nothing is left of what was refused");
}

/// The ground of path planning includes all agents and obstacles, whenever they are added.
#[test]
fn agents_added_later_and_farther_away_find_a_way_too() {
    let (mut world, origin, along) = street(0.2);
    world.add_obstacle(Obstacle::rectangle(origin, DVec2::new(1.0, 5.0), 0.2)).unwrap();
    run_for(&mut world, 1.0, |_| {});
    let far = origin - along * 400.0;
    let near_by = walker(&mut world, far, far + along * 6.0);
    world.add_agent(near_by).unwrap();
    let to_far = walker(&mut world, origin + along * 14.0, origin + along * 4000.0);
    world
        .add_agent(Agent {
            preferred_speed: 100.0,
            motor: Holonomic { max_speed: 100.0, max_acceleration: 50.0, ..Holonomic::default() }.into(),
            ..to_far
        })
        .unwrap();
    run(&mut world, 120.0, |_| {});
    assert_eq!(world.stranded(), []);
    assert_eq!(world.summary().arrived, 3);
}

#[test]
fn ground_that_changes_under_a_crowd_is_kept_to() {
    let mut draw = Draw::new(12);
    let mut world = world(0.05, DVec2::new(8000.0, 8000.0));
    let origin = world.settings().origin;
    for k in 0..20 {
        let from = origin + DVec2::new(f64::from(k % 5) - 2.0, f64::from(k / 5) - 1.5);
        let to = origin + draw.point(DVec2::splat(-6.5), DVec2::splat(6.5));
        let agent = walker(&mut world, from, to);
        world.add_agent(agent).unwrap();
    }
    let outer = rectangle(origin, DVec2::splat(19.0), 0.3);
    world.set_walkable(vec![Walkable { outer: outer.clone(), holes: vec![] }]).unwrap();
    let mut added = Vec::new();
    for round in 0..20 {
        // an obstacle without agents within 0.4 m
        let center = origin + draw.point(DVec2::splat(-6.0), DVec2::splat(6.0));
        let obstacle =
            Obstacle::rectangle(center, draw.point(DVec2::splat(0.2), DVec2::splat(2.0)), 0.1 * f64::from(round));
        let clear = |row| distance_to(&obstacle, world.position(world.id(row)).unwrap().truncate()) > 0.4;
        if (0..world.relative_columns().len()).all(clear) {
            added.push(world.add_obstacle(obstacle).unwrap());
        }
        run_for(&mut world, 0.5, |world| {
            assert_free(world);
            let rim = wall(&[&outer[..], &outer[..1]].concat());
            let inside =
                |row| distance_to(&rim, world.position(world.id(row)).unwrap().truncate()) > 0.2 * (1.0 - 1e-4);
            assert!((0..world.relative_columns().len()).all(inside));
        });
        if round % 3 == 2 && !added.is_empty() {
            world.remove_obstacle(added.swap_remove(draw.index(added.len())));
        }
    }
    assert!(obstacles(&world).len() > 3);
    for id in added {
        world.remove_obstacle(id);
    }
    run(&mut world, 60.0, assert_free);
    assert_eq!(world.summary().arrived, 20, "{:?}", world.stranded());
}
