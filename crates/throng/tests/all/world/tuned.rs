//! Groups and agents that are changed while the world runs.

use crate::world::common::{Draw, journey_to, run_for, world};
use glam::{DVec2, DVec3};
use std::sync::Arc;
use throng::avoid::{Hrvo, LocalModel, NoAvoidance, Orca};
use throng::motion::Motor;
use throng::motion::Vehicle;
use throng::{Agent, Error, Group, GroupId, JourneyId, Status, World};
use throng_steer::Wander;

fn with(model: impl LocalModel + 'static) -> Group {
    Group { name: "walkers".into(), model: Arc::new(model), resolve: false, ..Group::default() }
}

/// Sixty agents that cross an open square.
fn crossing(group: Group) -> (World, GroupId) {
    let mut world = world(0.05, DVec2::new(-900.0, 400.0));
    let origin = world.settings().origin;
    let group = world.add_group(group).unwrap();
    let mut draw = Draw::new(5);
    for k in 0..60 {
        let position = origin + DVec2::new(f64::from(k % 10) * 1.2, f64::from(k / 10) * 1.2);
        let journey = journey_to(&mut world, origin + draw.point(DVec2::splat(-12.0), DVec2::splat(22.0)));
        world.add_agent(Agent { position: position.extend(0.0), journey, group, ..Agent::default() }).unwrap();
    }
    (world, group)
}

/// The oracle: a world that had the other group from the start, and loaded the state.
#[test]
fn a_group_goes_on_as_if_it_had_always_been_so() {
    let looks =
        Group { neighbour_distance: 2.0, neighbours: 4, keep_right: -0.1, look_ahead: false, ..with(Orca::default()) };
    for other in [with(Hrvo::default()), looks, Group { guard: false, ..with(NoAvoidance) }] {
        let (mut changed, group) = crossing(with(Orca::default()));
        run_for(&mut changed, 2.0, |_| {});
        let (mut always, _) = crossing(other.clone());
        always.load(&changed.save()).unwrap();
        changed.set_group(group, other).unwrap();
        for _ in 0..80 {
            changed.step();
            always.step();
            assert_eq!(changed.state_hash(), always.state_hash(), "at {}", changed.time());
        }
    }
}

#[test]
fn walkers_become_vehicles_and_walkers_again() {
    let (mut world, group) = crossing(with(Orca::default()));
    run_for(&mut world, 1.0, |_| {});
    let before = world.group(group).clone();
    let cars = Group { name: "walkers".into(), ..Group::steered(Wander::default()) };
    world.set_group(group, cars).unwrap();
    world.adjust(|_, agent| agent.motor = Vehicle::default().into()).unwrap();
    run_for(&mut world, 2.0, |_| {});
    world.set_group(group, before).unwrap();
    world.adjust(|_, agent| agent.motor = Motor::default()).unwrap();
    run_for(&mut world, 80.0, |_| {});
    assert!(world.relative_columns().status.iter().all(|&status| status == Status::Arrived));
}

#[test]
fn agents_change_and_so_do_scheduled_agents() {
    let mut world = world(0.05, DVec2::ZERO);
    let journey = journey_to(&mut world, DVec2::X * 300.0);
    for (k, y) in [0.0, 5.0, 10.0].into_iter().enumerate() {
        let agent = Agent { position: (DVec2::Y * y).extend(0.0), journey, preferred_speed: 1.0, ..Agent::default() };
        match k {
            2 => world.schedule_agent(5.0, agent).unwrap(),
            _ => drop(world.add_agent(agent).unwrap()),
        }
    }
    run_for(&mut world, 3.0, |_| {});
    let places = world.relative_columns().position.clone();
    world
        .adjust(|number, agent| {
            agent.preferred_speed = 1.5 + number as f32 * 0.1;
            agent.motor.set_max_speed(2.0);
            (agent.position, agent.journey, agent.heading) = (DVec3::splat(77.0), JourneyId::STAY, Some(3.0));
        })
        .unwrap();
    assert_eq!(world.relative_columns().position, places);
    run_for(&mut world, 9.0, |_| {});
    assert_eq!(world.relative_columns().len(), 3);
    for row in 0..3 {
        let number = world.relative_columns().number[row];
        let expected = 1.5 + number as f32 * 0.1;
        assert!((world.relative_columns().velocity[row].length() - expected).abs() < 0.02, "{number}");
    }
}

#[test]
fn agents_that_grow_into_neighbours_part_from_them() {
    let (mut world, group) = crossing(with(Orca::default()));
    world.adjust(|_, agent| agent.radius = 0.8).unwrap();
    assert!(!world.overlapping().is_empty());
    run_for(&mut world, 60.0, |_| {});
    assert!(world.overlapping().is_empty());
    world.set_group(group, Group { guard: false, ..with(Orca::default()) }).unwrap();
    world.step();
}

#[test]
fn what_is_out_of_its_limits_changes_nothing() {
    let (mut world, group) = crossing(with(Orca::default()));
    run_for(&mut world, 1.0, |_| {});
    let hash = world.state_hash();
    let wrong = Group { neighbours: 0, ..with(Orca::default()) };
    assert!(matches!(world.set_group(group, wrong), Err(Error::Limit { .. })));
    assert!(
        world.adjust(|number, agent| agent.motor.set_max_speed(if number == 40 { f32::NAN } else { 3.0 })).is_err()
    );
    assert_eq!(world.state_hash(), hash);
    assert!(world.relative_columns().max_speed.values().iter().all(|&speed| speed < 3.0));
}
