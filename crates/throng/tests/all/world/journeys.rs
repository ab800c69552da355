//! Journeys: stops in order, waits that last, rounds that repeat.

use crate::world::common::{run, run_for, world};
use glam::DVec2;
use throng::{Agent, Goal, Journey, JourneyId, Status, Stop, World};

/// A journey through points, with waits, on an empty plain.
fn through(world: &mut World, stops: &[(DVec2, f32)], repeat: bool) -> JourneyId {
    let origin = world.settings().origin;
    let stop = |world: &mut World, &(at, wait): &(DVec2, f32)| {
        let goal = world.add_goal(Goal::Point { at: origin + at, tolerance: 0.2 }).unwrap();
        Stop { goal, wait }
    };
    let stops = stops.iter().map(|s| stop(world, s)).collect();
    world.add_journey(Journey { stops, repeat }).unwrap()
}

fn triangle() -> [(DVec2, f32); 3] {
    [(DVec2::new(3.0, 1.0), 2.0), (DVec2::new(-1.0, 3.0), 0.0), (DVec2::new(-2.0, -2.0), 0.75)]
}

/// For each stretch of one leg and status: its duration, and the position at its start.
fn stretches(world: &mut World, limit: f64) -> Vec<(u32, Status, f64, DVec2)> {
    let mut all: Vec<(u32, Status, f64, DVec2)> = Vec::new();
    run(world, limit, |world| {
        let (leg, status) = (world.relative_columns().travel[0].leg, world.relative_columns().status[0]);
        let at = world.position(world.id(0)).unwrap().truncate() - world.settings().origin;
        match all.last_mut() {
            Some(last) if (last.0, last.1) == (leg, status) => last.2 += world.settings().step,
            _ => all.push((leg, status, world.settings().step, at)),
        }
    });
    all
}

#[test]
fn stops_are_visited_in_order_and_waits_last_as_long_as_they_say() {
    let mut world = world(0.05, DVec2::new(-6000.0, 6000.0));
    let journey = through(&mut world, &triangle(), false);
    let position = world.settings().origin;
    world.add_agent(Agent { position: position.extend(0.0), journey, ..Agent::default() }).unwrap();
    let all = stretches(&mut world, 60.0);
    let order: Vec<(u32, Status)> = all.iter().map(|&(leg, status, ..)| (leg, status)).collect();
    use Status::{Arrived, Waiting, Walking};
    assert_eq!(order[..5], [(0, Walking), (0, Waiting), (1, Walking), (2, Walking), (2, Waiting)], "{all:?}");
    assert_eq!(order[5].1, Arrived);
    for (stretch, (point, wait)) in [(1, triangle()[0]), (4, triangle()[2])] {
        assert!((all[stretch].2 - f64::from(wait)).abs() <= 0.0501, "{:?}", all[stretch]);
        assert!(all[stretch].3.distance(point) <= 0.2 + 1.3 * 0.05, "it waits where it should: {:?}", all[stretch]);
    }
    assert!(all[3].3.distance(triangle()[1].0) <= 0.2 + 1.3 * 0.05, "it passed the second stop");
}

#[test]
fn a_round_goes_on_and_on() {
    let mut world = world(0.05, DVec2::new(100.0, -100.0));
    let journey = through(&mut world, &triangle(), true);
    let position = world.settings().origin;
    world.add_agent(Agent { position: position.extend(0.0), journey, ..Agent::default() }).unwrap();
    let all = stretches(&mut world, 100.0);
    assert!(!world.finished(), "a round has no end");
    let starts = all.iter().filter(|&&(leg, status, ..)| (leg, status) == (0, Status::Walking)).count();
    // 13.5 m at 1.3 m/s and 2.75 s of waits: some 14 s a round
    assert!((6..=9).contains(&starts), "{starts} rounds");
    let expected = |leg: u32, status| {
        if status == Status::Walking && leg != 1 { (leg, Status::Waiting) } else { ((leg + 1) % 3, Status::Walking) }
    };
    for pair in all.windows(2) {
        assert_eq!((pair[1].0, pair[1].1), expected(pair[0].0, pair[0].1));
    }
    assert_eq!(world.summary().arrived, 0);
}

#[test]
fn a_journey_whose_stops_are_where_one_stands_is_over_at_once() {
    let mut world = world(0.05, DVec2::ZERO);
    let journey = through(&mut world, &[(DVec2::ZERO, 0.0), (DVec2::ZERO, 0.0)], false);
    world.add_agent(Agent { journey, ..Agent::default() }).unwrap();
    run_for(&mut world, 0.5, |_| {});
    assert!(world.finished());
    assert_eq!(world.summary().arrived, 1);
}

#[test]
fn a_round_that_goes_nowhere_does_no_harm() {
    let mut world = world(0.05, DVec2::ZERO);
    let journey = through(&mut world, &[(DVec2::ZERO, 0.0)], true);
    world.add_agent(Agent { journey, ..Agent::default() }).unwrap();
    run_for(&mut world, 5.0, |world| assert!(world.relative_columns().velocity[0].length() < 1.0));
    assert!(world.position(world.id(0)).unwrap().length() < 0.5);
}

#[test]
fn many_share_a_round_with_waits_and_none_is_left_behind() {
    let mut world = world(0.05, DVec2::new(3500.0, 3500.0));
    let wide = triangle().map(|(at, _)| (at * 2.5, 0.0));
    let goals: Vec<Stop> = wide
        .iter()
        .map(|&(at, _)| {
            let at = world.settings().origin + at;
            Stop { goal: world.add_goal(Goal::Point { at, tolerance: 1.0 }).unwrap(), wait: 0.5 }
        })
        .collect();
    let journey = world.add_journey(Journey { stops: goals, repeat: true }).unwrap();
    for k in 0..12 {
        let position = world.settings().origin + DVec2::from_angle(f64::from(k) * 0.52) * 4.0;
        world.add_agent(Agent { position: position.extend(0.0), journey, ..Agent::default() }).unwrap();
    }
    let mut visits = [0; 12];
    let mut legs = [0; 12];
    run_for(&mut world, 120.0, |world| {
        for (row, travel) in world.relative_columns().travel.iter().enumerate() {
            visits[row] += u32::from(travel.leg != legs[row]);
            legs[row] = travel.leg;
        }
        crate::world::oracle::assert_free(world);
    });
    // about 34 m a round: some 27 s
    assert!(visits.iter().all(|&n| n >= 6), "{visits:?}");
}
