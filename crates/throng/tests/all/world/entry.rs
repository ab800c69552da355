//! Agents that enter over time, and agents that leave by exits.

use crate::world::common::{journey_into, rectangle, run, run_for, walker, world};
use crate::world::oracle::assert_free;
use glam::DVec2;
use throng::{Agent, Goal, Obstacle};

#[test]
fn they_enter_when_their_time_comes() {
    let mut world = world(0.1, DVec2::new(-300.0, 900.0));
    let origin = world.settings().origin;
    let times = [2.0, 0.0, 0.55, 1.0, 7.3];
    for (k, time) in times.into_iter().enumerate() {
        let position = origin + DVec2::new(2.0 * k as f64, 0.0);
        world.schedule_agent(time, Agent::at(position)).unwrap();
    }
    assert_eq!(world.summary().agents, 5, "those to come count");
    while world.time() < 9.0 {
        // in the step that begins at t are all agents with an entry time of at most t
        let due = times.iter().filter(|&&time| time <= world.time() + 1e-9).count();
        assert!(!world.finished() || due == 5);
        world.step();
        assert_eq!(world.relative_columns().len(), due, "in the step before {} s", world.time());
    }
    assert!(world.finished());
    let entered: Vec<f64> = world.relative_columns().entered.iter().collect();
    assert!(entered.iter().zip([0.0, 0.6, 1.0, 2.0, 7.3]).all(|(a, b)| (a - b).abs() < 1e-9), "{entered:?}");
}

#[test]
fn an_entry_waits_while_its_place_is_taken() {
    let mut world = world(0.05, DVec2::ZERO);
    let blocker = world.add_agent(Agent::at(DVec2::new(0.25, 0.0))).unwrap();
    world.schedule_agent(0.5, Agent { number: Some(50), ..Agent::default() }).unwrap();
    // agents do not wait for places other than their own
    world.schedule_agent(0.5, Agent::at(DVec2::new(5.0, 0.0))).unwrap();
    run_for(&mut world, 3.0, assert_free);
    assert_eq!(world.relative_columns().len(), 2);
    assert!(!world.finished());
    world.remove_agent(blocker);
    world.step();
    let row = world.relative_columns().number.iter().position(|&number| number == 50).expect("it has entered");
    assert!((world.relative_columns().trip(row).entered - 3.0).abs() < 1e-9);
}

#[test]
fn an_entry_waits_while_an_obstacle_is_in_its_place() {
    let mut world = world(0.05, DVec2::ZERO);
    world.schedule_agent(1.0, Agent::default()).unwrap();
    let id = world.add_obstacle(Obstacle::Circle { center: DVec2::new(0.5, 0.0), radius: 0.4 }).unwrap();
    run_for(&mut world, 2.0, |_| {});
    assert_eq!(world.relative_columns().len(), 0);
    world.remove_obstacle(id);
    world.step();
    assert_eq!(world.relative_columns().len(), 1);
}

/// Three sources at one crossing, each faster than the place can clear: all agents enter, in order of time, and none
/// overlaps.
#[test]
fn several_sources_feed_a_crossing_and_all_agents_leave() {
    let mut world = world(0.05, DVec2::new(5000.0, 40.0));
    let origin = world.settings().origin;
    for source in 0..3 {
        let from = DVec2::from_angle(0.4 + 2.1 * f64::from(source)) * 6.0;
        let exit = Goal::Exit { corners: rectangle(origin - from, DVec2::splat(2.0), 0.4) };
        let journey = journey_into(&mut world, exit);
        for k in 0..25 {
            let agent = Agent { position: (origin + from).extend(0.0), journey, ..Agent::default() };
            world.schedule_agent(0.2 * f64::from(k), agent).unwrap();
        }
    }
    let (mut least_left, mut most_there) = (75, 0);
    run(&mut world, 120.0, |world| {
        assert_free(world);
        let summary = world.summary();
        assert_eq!(summary.agents, 75, "no agent is lost from the count");
        assert!(75 - summary.removed <= least_left, "removed agents stay removed");
        least_left = 75 - summary.removed;
        most_there = most_there.max(world.relative_columns().len());
    });
    let summary = world.summary();
    assert!(world.finished() && world.relative_columns().is_empty(), "{summary:?}");
    assert_eq!((summary.arrived, summary.removed, summary.resting), (75, 75, 0));
    assert!(most_there > 10);
}

#[test]
fn an_exit_lets_only_its_own_people_out() {
    let mut world = world(0.05, DVec2::ZERO);
    let corners = rectangle(DVec2::ZERO, DVec2::splat(2.0), 0.2);
    let journey = journey_into(&mut world, Goal::Exit { corners });
    world.add_agent(Agent { position: DVec2::new(-4.0, 1.0).extend(0.0), journey, ..Agent::default() }).unwrap();
    let passer = walker(&mut world, DVec2::new(-5.0, -0.2), DVec2::new(5.0, 0.1));
    let passer = world.add_agent(passer).unwrap();
    run(&mut world, 30.0, assert_free);
    assert!(world.finished());
    assert_eq!(world.summary().removed, 1);
    assert!(world.position(passer).unwrap().x > 4.8);
}
