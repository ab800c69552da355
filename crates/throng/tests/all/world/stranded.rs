//! Goals out of reach: stranded agents are reported with the reason, and the rest are not held up.

use crate::world::common::{journey_into, journey_to, rectangle, run, run_for, walker, world};
use crate::world::oracle::assert_free;
use glam::DVec2;
use throng::navigate::Unreachable;
use throng::{Agent, Goal, Obstacle, Status};

#[test]
fn stranded_agents_are_reported_with_the_reason() {
    let mut world = world(0.05, DVec2::new(-1800.0, 6400.0));
    let origin = world.settings().origin;
    let at = |x: f64, y: f64| origin + DVec2::new(x, y);
    // a closed cell round (10, 0), a block at (0, 8), a hole too narrow for the thick agents
    let mut cell = rectangle(at(10.0, 0.0), DVec2::splat(3.0), 0.7);
    cell.push(cell[0]);
    world.add_obstacle(Obstacle::Wall { points: cell }).unwrap();
    world.add_obstacle(Obstacle::rectangle(at(0.0, 8.0), DVec2::splat(3.0), 0.2)).unwrap();
    for (from, to) in [(at(-20.0, -6.0), at(-6.0, -6.0)), (at(-5.2, -6.0), at(-5.2, -30.0))] {
        world.add_obstacle(Obstacle::Wall { points: vec![from, to] }).unwrap();
    }
    let goals = [at(10.0, 0.0), at(0.0, 8.2), at(8.0, 8.0)];
    for (number, goal) in [(30, goals[0]), (20, goals[1]), (10, goals[2]), (40, goals[2])] {
        let from = at(-3.0, f64::from(number) * 0.05);
        let agent = Agent { number: Some(number), ..walker(&mut world, from, goal) };
        world.add_agent(agent).unwrap();
    }
    // an area in the block, and an agent in the cell
    let corners = rectangle(at(0.0, 8.0), DVec2::splat(1.0), 0.2);
    let journey = journey_into(&mut world, Goal::Area { corners });
    world
        .add_agent(Agent { number: Some(5), position: at(-3.0, 3.0).extend(0.0), journey, ..Agent::default() })
        .unwrap();
    let caught = Agent { number: Some(60), ..walker(&mut world, at(10.1, 0.2), at(0.0, 0.0)) };
    world.add_agent(caught).unwrap();

    run(&mut world, 40.0, assert_free);
    assert!(world.finished(), "the end of the run does not wait for stranded agents");
    let stranded = world.stranded();
    let numbers: Vec<u32> = stranded.iter().map(|&(number, _)| number).collect();
    assert_eq!(numbers, [5, 20, 30, 60]);
    assert!(matches!(stranded[0].1, Unreachable::GoalInWall { .. }), "{}", stranded[0].1);
    assert!(matches!(stranded[1].1, Unreachable::GoalInWall { at, .. } if at == goals[1]), "{}", stranded[1].1);
    assert!(matches!(stranded[2].1, Unreachable::NoWay { .. }), "{}", stranded[2].1);
    assert!(matches!(stranded[3].1, Unreachable::NoWay { .. }), "{}", stranded[3].1);
    let summary = world.summary();
    assert_eq!((summary.arrived, summary.stuck), (2, 4));
}

#[test]
fn a_door_too_narrow_is_no_way_for_the_thick_and_one_for_the_thin() {
    let mut world = world(0.05, DVec2::new(33.0, 44.0));
    let origin = world.settings().origin;
    let side = DVec2::from_angle(2.0);
    let mut ring = rectangle(origin, DVec2::splat(6.0), 2.0 - std::f64::consts::FRAC_PI_2);
    ring.push(ring[0]);
    let middle = (ring[0] + ring[1]) * 0.5;
    let along = (ring[1] - ring[0]).normalize();
    world.add_obstacle(Obstacle::Wall { points: vec![ring[0], middle - along * 0.35] }).unwrap();
    world.add_obstacle(Obstacle::Wall { points: [&[middle + along * 0.35], &ring[1..]].concat() }).unwrap();
    let journey = journey_to(&mut world, origin + side * 8.0);
    let thin = Agent { position: origin.extend(0.0), journey, radius: 0.3, ..Agent::default() };
    let thick = Agent { position: (origin + along * 1.5).extend(0.0), radius: 0.4, ..thin.clone() };
    world.add_agent(thin).unwrap();
    world.add_agent(thick).unwrap();
    run(&mut world, 40.0, assert_free);
    assert_eq!(world.relative_columns().status, [Status::Arrived, Status::Stranded]);
}

/// In a stream past stranded agents all agents arrive, as soon as without them within a second.
#[test]
fn the_stranded_are_no_burden_to_the_others() {
    let finish = |stranded: bool| {
        let mut world = world(0.05, DVec2::new(900.0, 900.0));
        let origin = world.settings().origin;
        world.add_obstacle(Obstacle::Circle { center: origin + DVec2::new(0.0, 30.0), radius: 2.0 }).unwrap();
        for k in 0..24 {
            let side = if k % 2 == 0 { 1.0 } else { -1.0 };
            let from = DVec2::new(side * (8.0 + f64::from(k / 8)), 0.7 * f64::from(k / 2 % 4));
            let agent = walker(&mut world, origin + from, origin + DVec2::new(-from.x, from.y));
            world.add_agent(agent).unwrap();
        }
        for k in 0..if stranded { 4 } else { 0 } {
            let inside = origin + DVec2::new(0.2 * f64::from(k), 30.0);
            let agent = walker(&mut world, origin + DVec2::new(2.0 * f64::from(k) - 3.0, 0.9), inside);
            world.add_agent(agent).unwrap();
        }
        run(&mut world, 60.0, assert_free);
        assert_eq!(world.summary().arrived, 24);
        world.time()
    };
    let (alone, among) = (finish(false), finish(true));
    assert!(among < alone * 1.25 + 1.0, "{alone} s alone, {among} s among the stranded");
}

#[test]
fn a_later_leg_that_cannot_be_walked_strands_there() {
    let mut world = world(0.05, DVec2::ZERO);
    world.add_obstacle(Obstacle::Circle { center: DVec2::new(9.0, 0.0), radius: 1.0 }).unwrap();
    let stop = |world: &mut throng::World, at| {
        let goal = world.add_goal(Goal::Point { at, tolerance: 0.2 }).unwrap();
        throng::Stop { goal, wait: 0.0 }
    };
    let stops = vec![stop(&mut world, DVec2::new(4.0, 0.0)), stop(&mut world, DVec2::new(9.0, 0.0))];
    let journey = world.add_journey(throng::Journey { stops, repeat: false }).unwrap();
    let id = world.add_agent(Agent { journey, ..Agent::default() }).unwrap();
    run_for(&mut world, 12.0, assert_free);
    assert_eq!(world.relative_columns().status[0], Status::Stranded);
    assert!((world.position(id).unwrap().x - 4.0).abs() < 0.6, "{:?}", world.position(id));
}
