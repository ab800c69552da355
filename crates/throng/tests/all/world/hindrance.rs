//! The kinds of hindrance are distinguished.

use crate::world::common::{journey_to, run_for, walker, world};
use glam::{DVec2, Vec2};
use std::sync::Arc;
use throng::avoid::{AvoidanceInput, LocalModel, Orca, Workspace};
use throng::{Agent, Group, Hindrance, Obstacle, World};

/// A model that walks in circles, regardless of its input.
#[derive(Clone, Copy, Debug)]
struct Circles;

impl LocalModel for Circles {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        let ahead = view.velocity.normalize_or(Vec2::X);
        Vec2::from_angle(2.0 * view.step).rotate(ahead)
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius
    }
}

fn hindrance(world: &World, row: usize) -> Hindrance {
    world.hindrance(row)
}

#[test]
fn an_agent_that_walks_and_gets_nowhere_oscillates() {
    let mut world = world(0.05, DVec2::ZERO);
    let group = world.add_group(Group { model: Arc::new(Circles), ..Group::default() }).unwrap();
    let agent = walker(&mut world, DVec2::ZERO, DVec2::new(30.0, 0.0));
    world.add_agent(Agent { group, ..agent }).unwrap();
    run_for(&mut world, 8.0, |world| assert_eq!(hindrance(world, 0), Hindrance::None));
    run_for(&mut world, 6.0, |_| {});
    assert_eq!(hindrance(&world, 0), Hindrance::Oscillating);
    let summary = world.summary();
    assert_eq!((summary.hindered.oscillating, summary.stuck, summary.without_progress_30s), (1, 1, 0));
    run_for(&mut world, 30.0, |_| {});
    assert_eq!(world.summary().without_progress_30s, 1, "it is counted once");
    // a loaded world continues the count
    let mut other = crate::world::common::world(0.05, DVec2::ZERO);
    other.add_group(Group { model: Arc::new(Circles), ..Group::default() }).unwrap();
    other.load(&world.save()).unwrap();
    assert_eq!(other.summary(), world.summary());
}

/// A passage too narrow for two, and two agents that meet in it, without resolution.
#[test]
fn agents_that_stand_in_each_other_s_way_are_blocked_and_agents_behind_a_moving_one_queue() {
    let mut world = world(0.05, DVec2::ZERO);
    for y in [-0.3, 0.3] {
        world.add_obstacle(Obstacle::Wall { points: vec![DVec2::new(-20.0, y), DVec2::new(20.0, y)] }).unwrap();
    }
    let group = Group { look_ahead: false, keep_right: 0.0, resolve: false, ..Group::default() };
    let group = world.add_group(group).unwrap();
    for side in [-1.0, 1.0] {
        let agent = walker(&mut world, DVec2::new(8.0 * side, 0.0), DVec2::new(-8.0 * side, 0.0));
        world.add_agent(Agent { group, ..agent }).unwrap();
    }
    run_for(&mut world, 40.0, |_| {});
    assert_eq!([hindrance(&world, 0), hindrance(&world, 1)], [Hindrance::Blocked; 2]);
    let summary = world.summary();
    assert_eq!((summary.hindered.blocked, summary.stuck, summary.without_progress_30s), (2, 2, 0));
}

#[test]
fn agents_behind_a_slow_one_queue_and_are_not_stuck() {
    let mut world = world(0.05, DVec2::ZERO);
    for y in [-0.3, 0.3] {
        world.add_obstacle(Obstacle::Wall { points: vec![DVec2::new(-20.0, y), DVec2::new(20.0, y)] }).unwrap();
    }
    let group = world.add_group(Group { model: Arc::new(Orca::default()), ..Group::default() }).unwrap();
    let journey = journey_to(&mut world, DVec2::new(15.0, 0.0));
    for k in 0..5 {
        let position = DVec2::new(-0.6 * f64::from(k), 0.0);
        // the first agent walks 5 cm a second
        let preferred_speed = if k == 0 { 0.05 } else { 1.3 };
        world
            .add_agent(Agent { position: position.extend(0.0), journey, group, preferred_speed, ..Agent::default() })
            .unwrap();
    }
    run_for(&mut world, 30.0, |_| {});
    assert_eq!(hindrance(&world, 0), Hindrance::None, "nothing is in the way of the slow one");
    assert_eq!([1, 2, 3, 4].map(|row| hindrance(&world, row)), [Hindrance::Queueing; 4]);
    let summary = world.summary();
    assert_eq!((summary.hindered.queueing, summary.stuck), (4, 0));
}
