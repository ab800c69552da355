//! Arrived agents: they come back when they are pushed away, and do not count as arrived until they are back.

use crate::world::common::{journey_into, journey_to, rectangle, run, run_for, world};
use glam::DVec2;
use throng::{Agent, AgentId, Goal, Keyframe, Obstacle, Script, Status, World};

/// Adds a disc that a script moves along a line, and that avoids no agent.
fn plough(world: &mut World, from: DVec2, to: DVec2, (begins, ends): (f64, f64), radius: f32) -> AgentId {
    let keyframe = |time, at| Keyframe { time, at, heading: 0.0 };
    let script = Script { keyframes: vec![keyframe(begins, from), keyframe(ends, to)], repeat: false };
    let script = world.add_script(script).unwrap();
    let agent = Agent {
        position: from.extend(0.0),
        script: Some(script),
        preferred_speed: 0.0,
        radius,
        avoids: 0,
        ..Agent::default()
    };
    world.add_agent(agent).unwrap()
}

/// Whether all arrived agents are within a distance of a point.
fn all_within(world: &World, at: DVec2, distance: f64) -> bool {
    let agents = world.relative_columns();
    let arrived =
        (0..agents.len()).filter(|&row| agents.status[row] == Status::Arrived && agents.script[row].is_none());
    arrived.into_iter().all(|row| world.position(world.id(row)).unwrap().distance(at.extend(0.0)) <= distance)
}

#[test]
fn agents_that_are_pushed_out_of_their_area_come_back() {
    let origin = DVec2::new(40.0, -70.0);
    let mut world = world(0.05, origin);
    let corners = rectangle(origin, DVec2::new(2.0, 2.0), 0.0);
    let journey = journey_into(&mut world, Goal::Area { corners });
    for k in 0..6 {
        let position = origin + DVec2::new(-6.0 - f64::from(k / 3), 0.6 * f64::from(k % 3) - 0.6);
        world.add_agent(Agent { position: position.extend(0.0), journey, ..Agent::default() }).unwrap();
    }
    plough(&mut world, origin + DVec2::new(0.0, -9.0), origin + DVec2::new(0.0, 9.0), (15.0, 33.0), 1.0);
    run_for(&mut world, 15.0, |_| {});
    assert_eq!(world.summary().arrived, 6);
    assert!(world.finished());
    let (mut least, mut unfinished) = (6, false);
    run_for(&mut world, 30.0, |world| {
        let counts = world.counts();
        least = least.min(counts.arrived);
        unfinished |= !world.finished();
        // an agent that is pushed over the border is noticed a step later
        assert!(all_within(world, origin, 2f64.sqrt() + 0.1));
    });
    assert!(least <= 3 && unfinished, "the disc clears the area: {least} stayed");
    assert!(world.finished() && world.summary().arrived == 6, "{:?}", world.summary());
    assert!(world.relative_columns().arrived[0] < 15.0, "the first arrival is kept");
}

#[test]
fn agents_that_are_pushed_off_their_point_have_not_arrived_until_they_are_back() {
    let mut world = world(0.05, DVec2::ZERO);
    let journey = journey_to(&mut world, DVec2::ZERO);
    for k in 0..9 {
        let position = DVec2::from_angle(0.7 * f64::from(k)) * 5.0;
        world.add_agent(Agent { position: position.extend(0.0), journey, ..Agent::default() }).unwrap();
    }
    plough(&mut world, DVec2::new(-9.0, 0.1), DVec2::new(9.0, 0.1), (20.0, 38.0), 0.8);
    run_for(&mut world, 20.0, |_| {});
    assert_eq!(world.summary().arrived, 9);
    let mut least = 9;
    run_for(&mut world, 40.0, |world| least = least.min(world.counts().arrived));
    assert!(least <= 6, "the disc parts them: {least} stayed");
    assert!(world.finished() && world.summary().arrived == 9, "{:?}", world.summary());
    assert!(all_within(&world, DVec2::ZERO, 2.0));
}

#[test]
fn agents_that_begin_in_their_area_stay_where_they_are() {
    let mut world = world(0.05, DVec2::ZERO);
    let corners = rectangle(DVec2::ZERO, DVec2::splat(6.0), 0.3);
    let journey = journey_into(&mut world, Goal::Area { corners });
    let places = [DVec2::new(0.5, 0.5), DVec2::new(-1.5, 1.0), DVec2::new(1.0, -2.0)];
    for position in places {
        world.add_agent(Agent { position: position.extend(0.0), journey, ..Agent::default() }).unwrap();
    }
    run_for(&mut world, 5.0, |_| {});
    assert_eq!(world.summary().arrived, 3);
    for (row, place) in places.iter().enumerate() {
        assert!(world.position(world.id(row)).unwrap().distance((*place).extend(0.0)) < 0.01);
    }
}

/// In an area with two chambers all places are used: paths inside it lead round the wall.
#[test]
fn an_area_with_a_corner_is_filled_round_it() {
    let mut world = world(0.05, DVec2::ZERO);
    // a corridor of 1.2 m with a bend; the area is all of it beyond x = 8
    let wall = |world: &mut World, points: &[(f64, f64)]| {
        world.add_obstacle(Obstacle::Wall { points: points.iter().map(|&p| p.into()).collect() }).unwrap();
    };
    wall(&mut world, &[(-1.0, 0.6), (10.8, 0.6), (10.8, 6.0), (12.0, 6.0), (12.0, -0.6), (-1.0, -0.6), (-1.0, 0.6)]);
    let corners = [(8.0, -0.6), (12.0, -0.6), (12.0, 6.0), (10.8, 6.0), (10.8, 0.6), (8.0, 0.6)].map(DVec2::from);
    let journey = journey_into(&mut world, Goal::Area { corners: corners.to_vec() });
    for k in 0..28 {
        let position = DVec2::new(0.55 * f64::from(k / 2) - 0.5, 0.5 * f64::from(k % 2) - 0.25);
        world.add_agent(Agent { position: position.extend(0.0), journey, radius: 0.2, ..Agent::default() }).unwrap();
    }
    run(&mut world, 90.0, |_| {});
    run_for(&mut world, 30.0, |_| {});
    let summary = world.summary();
    assert_eq!((summary.arrived, summary.without_progress_30s), (28, 0), "{summary:?}");
    assert_eq!(summary.resting, 28, "{summary:?}");
    let beyond = (0..28).filter(|&row| world.relative_columns().position[row].y > 0.8).count();
    assert!(beyond >= 8, "{beyond} stand round the corner");
}
