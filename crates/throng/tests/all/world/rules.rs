//! Rules and their effects: agents that restart, velocities, figures.

use crate::world::common::{Draw, journey_to, walker, world};
use glam::{DVec2, Vec2, Vec3};
use std::sync::Arc;
use throng::agent::Guidance;
use throng::motion::{Steering, Vehicle};
use throng::steer::BoxedBehaviour;
use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
use throng::{Agent, AgentId, AgentRef, Error, Group, GroupId, Obstacle, Rules, World};

/// Agents beyond a distance restart at a random place. Counts the restarts, and the steps.
#[derive(Debug)]
struct Pen(f64);

impl Rules for Pen {
    fn figures(&self) -> Vec<String> {
        vec!["returns".into(), "steps".into()]
    }

    fn act(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error> {
        figures[1] += 1.0;
        for (id, k) in world.agent_ids().into_iter().zip(0..) {
            let Some(agent) = world.agent(id).map(AgentRef::to_agent) else { continue };
            if agent.position.length() > self.0 {
                let position = DVec2::new(world.draw(2 * k).into(), world.draw(2 * k + 1).into()) * 4.0;
                world.replace(id, Agent { position: position.extend(0.0), ..agent })?;
                figures[0] += 1.0;
            }
        }
        Ok(())
    }

    fn standing(&self, _: &World, figures: &[f64]) -> String {
        format!("{} returns", figures[0])
    }
}

fn crowd(order: impl Iterator<Item = u32>) -> World {
    let mut world = world(0.05, DVec2::ZERO);
    for number in order {
        let from = DVec2::new(f64::from(number % 4), f64::from(number / 4)) - 1.5;
        let agent = walker(&mut world, from, from * 20.0 + 1.0);
        world.add_agent(Agent { number: Some(number), ..agent }).unwrap();
    }
    world.set_rules(Arc::new(Pen(6.0))).unwrap();
    world
}

#[test]
fn rules_act_after_every_step_whatever_the_order_of_agents() {
    let (mut world, mut other) = (crowd(0..16), crowd((0..16).rev()));
    for step in 0..400 {
        world.step();
        other.step();
        assert_eq!(world.state_hash(), other.state_hash(), "step {step}");
        assert!(world.relative_columns().position.iter().all(|at| at.length() <= 6.0));
    }
    assert_eq!(world.figure("steps"), Some(400.0));
    assert!(world.figure("returns").is_some_and(|returns| returns > 30.0));
    assert_eq!(world.standing(), format!("{} returns", world.figure("returns").unwrap()));
    assert_eq!((world.summary().overlaps > 0, world.refused()), (true, None), "places are drawn without looking");
}

#[test]
fn figures_are_cloned_saved_and_loaded() {
    let mut original = crowd(0..16);
    (0..150).for_each(|_| original.step());
    let (mut clone, mut loaded) = (original.clone(), crowd(0..16));
    loaded.load(&original.save()).unwrap();
    for _ in 0..150 {
        [&mut original, &mut clone, &mut loaded].into_iter().for_each(World::step);
        assert_eq!((clone.state_hash(), loaded.state_hash()), (original.state_hash(), original.state_hash()));
    }
    let mut without = world(0.05, DVec2::ZERO);
    let before = without.save();
    let error = without.load(&original.save()).unwrap_err();
    assert!(matches!(&error, Error::Snapshot { why } if why.contains("returns")), "{error}");
    assert_eq!(without.save(), before);
}

#[test]
fn replaced_agents_restart_and_keep_their_id() {
    let mut world = world(0.05, DVec2::new(500.0, -80.0));
    let origin = world.settings().origin;
    let ids: Vec<AgentId> = (0..5)
        .map(|k| {
            let agent = walker(&mut world, origin + DVec2::Y * f64::from(k), origin + DVec2::new(30.0, f64::from(k)));
            world.add_agent(agent).unwrap()
        })
        .collect();
    (0..100).for_each(|_| world.step());
    let (time, others) = (world.time(), world.clone());
    let agent = world.agent(ids[2]).map(AgentRef::to_agent).unwrap();
    assert!(world.relative_columns().trip(world.row(ids[2]).unwrap()).walked > 3.0);
    let journey = journey_to(&mut world, origin - DVec2::X * 9.0);
    let at = origin + DVec2::new(-5.0, 2.0);
    world.replace(ids[2], Agent { position: at.extend(0.0), velocity: Vec2::ZERO, journey, ..agent }).unwrap();
    let row = world.row(ids[2]).expect("the id stays");
    assert_eq!((world.position(ids[2]), world.relative_columns().number[row]), (Some(at.extend(0.0)), 2));
    let trip = world.relative_columns().trip(row);
    assert_eq!((trip.walked, trip.entered, trip.shortest), (0.0, time, 0.0));
    for &id in ids.iter().filter(|&&id| id != ids[2]) {
        assert_eq!(world.agent(id).map(AgentRef::to_agent), others.agent(id).map(AgentRef::to_agent));
    }
    assert_eq!(world.agent_ids(), ids);
    (0..300).for_each(|_| world.step());
    let trip = world.relative_columns().trip(world.row(ids[2]).unwrap());
    // to 0.1 m before its goal
    assert!(trip.arrived.is_some() && (trip.walked - (20f64.sqrt() - 0.1)).abs() < 0.1, "{trip:?}");
    assert!(world.summary().time_ratio < 1.2, "{}", world.summary().time_ratio);

    // a removed agent cannot be restored by its id, and no other agent gets that id
    assert!(world.remove_agent(ids[0]));
    assert_eq!(world.replace(ids[0], Agent::default()), Err(Error::Gone));
    assert_eq!(
        (world.set_velocity(ids[0], Vec3::X), world.agent(ids[0]).map(AgentRef::to_agent)),
        (Err(Error::Gone), None)
    );
    // refused changes have no effect
    let hash = world.state_hash();
    let wrong = Agent { radius: -1.0, ..world.agent(ids[1]).map(AgentRef::to_agent).unwrap() };
    assert!(matches!(world.replace(ids[1], wrong), Err(Error::Limit { what: "radius", .. })));
    assert!(world.set_velocity(ids[1], Vec3::NAN).is_err());
    assert_eq!(world.state_hash(), hash);
    assert_eq!(world.group_named("no group"), Err(Error::NoGroup { name: "no group".into() }));
}

#[test]
fn a_place_is_free_without_agents_and_obstacles() {
    let mut draw = Draw::new(5);
    let mut world = world(0.05, DVec2::new(-70.0, 20.0));
    let origin = world.settings().origin;
    world.add_obstacle(Obstacle::Circle { center: origin + DVec2::new(3.0, 3.0), radius: 1.0 }).unwrap();
    let mut discs = vec![(origin + DVec2::new(3.0, 3.0), 1.0)];
    for _ in 0..12 {
        let (position, radius) =
            (origin + draw.point(DVec2::splat(-5.0), DVec2::splat(1.0)), 0.1 + draw.between(0.0, 0.4));
        world.add_agent(Agent { position: position.extend(0.0), radius: radius as f32, ..Agent::default() }).unwrap();
        discs.push((position, f64::from(radius as f32)));
    }
    let mut free = 0;
    for _ in 0..2000 {
        let (at, radius) = (origin + draw.point(DVec2::splat(-6.0), DVec2::splat(6.0)), draw.between(0.05, 0.8) as f32);
        let gap = discs.iter().map(|(p, r)| p.distance(at) - r - f64::from(radius)).fold(f64::INFINITY, f64::min);
        if gap.abs() > 1e-5 {
            assert_eq!(world.is_free(at.extend(0.0), radius), gap > 0.0, "{gap}");
            free += usize::from(gap > 0.0);
        }
    }
    assert!((200..1800).contains(&free));
    assert!(!world.is_free(DVec2::NAN.extend(0.0), 0.2));
}

/// Goes forward at the speed of the first figure.
#[derive(Debug)]
struct Obedient;

impl Behaviour for Obedient {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        Some(view.reach(Vec3::X * *view.figures.first()? as f32))
    }
}

/// Sets the speed, and requests impossible changes.
#[derive(Debug)]
struct Leader;

impl Rules for Leader {
    fn figures(&self) -> Vec<String> {
        vec!["speed".into()]
    }

    fn begin(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error> {
        figures[0] = 0.5;
        world.group_named("obedient").map(drop)
    }

    fn act(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error> {
        assert_eq!(world.figure("speed"), Some(figures[0]), "the old ones are seen");
        if world.time() > 2.0 {
            figures[0] = 1.5;
        }
        world.group_named("no group").map(drop)
    }
}

#[test]
fn behaviours_see_figures_and_kicks_last() {
    let mut world = world(0.05, DVec2::ZERO);
    let missing = world.set_rules(Arc::new(Leader)).unwrap_err();
    assert_eq!((missing.to_string().as_str(), world.figures().len()), ("there is no group `obedient`", 0));
    let vehicle = Vehicle { max_speed: 4.0, response: 0.1, ..Vehicle::default() };
    let group = |name: &str, steering: BoxedBehaviour| Group {
        name: name.into(),
        guidance: Guidance::behaviour(steering),
        guard: false,
        ..Group::default()
    };
    let obedient = world.add_group(group("obedient", Obedient.into())).unwrap();
    let free = world.add_group(group("free", throng_steer::Fear { range: 1.0, fades: 1.0 }.into())).unwrap();
    let add = |world: &mut World, group: GroupId, y: f64| {
        let position = DVec2::new(0.0, y);
        world
            .add_agent(Agent {
                position: position.extend(0.0),
                group,
                preferred_speed: 4.0,
                motor: vehicle.into(),
                ..Agent::default()
            })
            .unwrap()
    };
    let (one, ball) = (add(&mut world, obedient, 0.0), add(&mut world, free, 9.0));
    world.set_rules(Arc::new(Leader)).unwrap();
    let speed = |world: &World, id| world.agent(id).map(AgentRef::to_agent).unwrap().velocity.x;
    (0..40).for_each(|_| world.step());
    assert!((speed(&world, one) - 0.5).abs() < 0.01);
    assert_eq!(world.refused(), Some(&Error::NoGroup { name: "no group".into() }));
    world.set_velocity(ball, Vec3::new(0.6, 0.8, 0.0)).unwrap();
    (0..40).for_each(|_| world.step());
    assert!((speed(&world, one) - 1.5).abs() < 0.01);
    let gone = world.position(ball).unwrap().truncate() - DVec2::Y * 9.0;
    // each sub-step rounds the position, 10 m from the origin
    assert!(gone.distance(DVec2::new(1.2, 1.6)) < 5e-4, "two seconds at its velocity: {gone}");
    assert_eq!(world.members(obedient), [one]);
}
