//! Agents come and go while the world runs: an id names its agent, or none once that agent is gone.

use crate::world::common::{Draw, journey_to, run, run_for, walker, world};
use crate::world::oracle::assert_free;
use glam::DVec2;
use std::collections::BTreeMap;
use throng::{Agent, AgentId, Error, Goal, World};

/// Checks that the world has exactly the agents of the model, each at its id.
fn agree(world: &World, there: &BTreeMap<AgentId, u32>, gone: &[AgentId]) {
    assert_eq!(world.relative_columns().len(), there.len());
    for (&id, &number) in there {
        let row = world.row(id).expect("an agent that was not removed");
        assert_eq!(world.relative_columns().number[row], number);
        assert_eq!(world.id(row), id);
        let expected = world.relative_columns().position[row].as_dvec2() + world.settings().origin;
        assert_eq!(world.position(id), Some(expected.extend(0.0)));
    }
    for &id in gone {
        assert_eq!((world.row(id), world.position(id)), (None, None), "{id:?} was removed");
    }
}

#[test]
fn ids_stay_valid_and_stale_ids_name_no_agent() {
    let mut draw = Draw::new(31);
    let mut world = world(0.05, DVec2::new(-3000.0, 1000.0));
    let origin = world.settings().origin;
    let journeys: Vec<_> = (0..5).map(|k| journey_to(&mut world, origin + DVec2::new(f64::from(k), 3.0))).collect();
    let (mut there, mut gone) = (BTreeMap::new(), Vec::new());
    for round in 0..600u32 {
        if draw.index(5) < 3 {
            let position = origin + draw.point(DVec2::splat(-30.0), DVec2::splat(30.0));
            let agent = Agent { position: position.extend(0.0), journey: draw.one_of(&journeys), ..Agent::default() };
            let id = world.add_agent(agent).unwrap();
            let number = world.relative_columns().number[world.row(id).unwrap()];
            assert_eq!(there.insert(id, number), None, "{id:?} names an agent already");
            assert!(!gone.contains(&id), "{id:?} came back");
        } else if let Some((&id, _)) = there.iter().nth(draw.index(there.len().max(1))) {
            assert!(world.remove_agent(id));
            assert!(!world.remove_agent(id), "removed once only");
            there.remove(&id);
            gone.push(id);
        }
        if round % 20 == 0 {
            world.step();
            agree(&world, &there, &gone);
        }
    }
    assert!(gone.len() > 150 && there.len() > 50);
    agree(&world, &there, &gone);
}

#[test]
fn an_exit_takes_the_id_with_it() {
    let mut world = world(0.05, DVec2::ZERO);
    let exit = Goal::Exit { corners: crate::world::common::rectangle(DVec2::new(3.0, 0.0), DVec2::splat(1.0), 0.0) };
    let journey = crate::world::common::journey_into(&mut world, exit);
    let leaving = world.add_agent(Agent { journey, ..Agent::default() }).unwrap();
    let staying = world.add_agent(Agent::at(DVec2::new(0.0, 5.0))).unwrap();
    run(&mut world, 10.0, |_| {});
    assert_eq!(world.row(leaving), None);
    assert_eq!(world.position(staying), Some(DVec2::new(0.0, 5.0).extend(0.0)));
    let new = world.add_agent(Agent::default()).unwrap();
    assert_ne!(new, leaving);
    assert_eq!((world.row(leaving), world.row(new)), (None, Some(1)));
}

#[test]
fn the_crowd_goes_on_when_an_agent_is_removed() {
    let mut draw = Draw::new(4);
    let mut world = world(1.0 / 30.0, DVec2::new(70.0, -5000.0));
    let origin = world.settings().origin;
    let mut ids = Vec::new();
    for k in 0..30 {
        let at = DVec2::new(f64::from(k % 6) * 0.8 - 2.0, f64::from(k / 6) * 0.8 - 2.0);
        let agent = walker(&mut world, origin + at, origin - at * 3.0 + DVec2::new(0.3, 0.0));
        ids.push(world.add_agent(agent).unwrap());
    }
    for _ in 0..12 {
        run_for(&mut world, 0.4, assert_free);
        assert!(world.remove_agent(ids.swap_remove(draw.index(ids.len()))));
    }
    run(&mut world, 60.0, assert_free);
    assert!(world.finished());
    assert_eq!(world.summary().arrived, 18);
}

#[test]
fn a_number_is_free_again_when_its_agent_is_gone_and_not_before() {
    let mut world = world(0.05, DVec2::ZERO);
    let numbered =
        |number, x| Agent { number: Some(number), position: DVec2::new(x, 0.0).extend(0.0), ..Agent::default() };
    let id = world.add_agent(numbered(7, 0.0)).unwrap();
    assert_eq!(world.add_agent(numbered(7, 1.0)), Err(Error::NumberTaken { number: 7 }));
    assert_eq!(world.schedule_agent(1.0, numbered(7, 1.0)), Err(Error::NumberTaken { number: 7 }));
    world.remove_agent(id);
    world.schedule_agent(1.0, numbered(7, 1.0)).unwrap();
    assert_eq!(world.add_agent(numbered(7, 2.0)), Err(Error::NumberTaken { number: 7 }), "it is on its way in");
}

#[test]
fn numbers_at_their_end_are_given_once() {
    let mut world = world(0.05, DVec2::ZERO);
    let numbered =
        |number, x| Agent { number: Some(number), position: DVec2::new(x, 0.0).extend(0.0), ..Agent::default() };
    let last = u32::MAX - 1;
    world.add_agent(numbered(last, 0.0)).unwrap();
    assert_eq!(world.add_agent(numbered(last, 1.0)), Err(Error::NumberTaken { number: last }));
    // no number is left for an agent without one
    for agent in [numbered(u32::MAX, 2.0), Agent::at(DVec2::new(3.0, 0.0))] {
        let message = world.add_agent(agent).unwrap_err().to_string();
        assert!(message.contains("number is 4294967295"), "{message}");
    }
    world.add_agent(numbered(5, 4.0)).unwrap();
}
