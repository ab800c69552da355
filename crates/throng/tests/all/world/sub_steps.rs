//! The division of steps: by a fixed number, or by a rule that depends only on the state.

use crate::world::common::{Draw, run_for, with_settings};
use crate::world::scenes::{Kind, populate};
use glam::{DVec2, Vec3};
use throng::agent::Guidance;
use throng::field::Governed;
use throng::motion::Motor;
use throng::motion::{Holonomic, Vehicle};
use throng::{Agent, Body, Group, Keyframe, Script, Stage, SubSteps, World};
use throng_steer::Wander;

/// Number of sub-steps of the next step.
fn parts_of_next(world: &mut World) -> u64 {
    let before = world.summary().sub_steps;
    world.step();
    world.summary().sub_steps - before
}

/// Two agents at this distance.
fn pair(step: f64, apart: f64) -> World {
    let mut world = with_settings(step, SubSteps::Auto, DVec2::new(-44.0, 5000.0));
    let position = world.settings().origin;
    for offset in [DVec2::ZERO, DVec2::new(0.0, apart)] {
        world.add_agent(Agent { position: (position + offset).extend(0.0), ..Agent::default() }).unwrap();
    }
    world
}

#[test]
fn a_fixed_number_is_kept_to() {
    for parts in [1, 2, 7] {
        let mut world = with_settings(0.1, SubSteps::Fixed(parts), DVec2::ZERO);
        populate(&mut world, &mut Draw::new(1), (DVec2::splat(-3.0), DVec2::splat(3.0)), 20, &Kind::default());
        let there = world.relative_columns().len() as u64;
        run_for(&mut world, 2.0, |_| {});
        let summary = world.summary();
        assert_eq!((summary.steps, summary.sub_steps), (20, 20 * u64::from(parts)));
        assert_eq!(summary.agent_steps, 20 * u64::from(parts) * there);
    }
}

/// Whether an agent deviates by at most a sixth of its clearance radius in a sub-step and moves at most that radius.
fn keeps_to_the_rule(agent: &Agent, seconds: f64) -> bool {
    let radius = f64::from(agent.body().clearance_radius());
    let Motor::Holonomic(motor) = agent.motor else { return false };
    let [speed, acceleration] = [motor.max_speed, motor.max_acceleration].map(f64::from);
    let deviation = (acceleration * seconds).min(speed) * seconds;
    deviation <= radius / 6.0 && speed * seconds <= radius
}

fn random_agent(draw: &mut Draw) -> Agent {
    let speed = draw.between(0.1, 12.0) as f32;
    let body = match draw.index(3) {
        0 => Body::disc(draw.between(0.1, 1.0) as f32),
        1 => Body::capsule(draw.between(0.5, 2.0) as f32, draw.between(0.1, 0.5) as f32),
        _ => Body::rectangle(draw.between(0.5, 4.0) as f32, draw.between(0.1, 2.0) as f32),
    };
    let acceleration = if draw.index(3) == 0 { f32::INFINITY } else { draw.between(0.5, 40.0) as f32 };
    let agent = Agent {
        preferred_speed: speed,
        motor: Holonomic { max_speed: speed, max_acceleration: acceleration, ..Holonomic::default() }.into(),
        ..Agent::default()
    };
    agent.with_body(body)
}

/// Adds agents 8 m apart, on a grid that is turned by `angle` about the origin.
fn add_apart(world: &mut World, agents: &[Agent], angle: f64) {
    let origin = world.settings().origin;
    for (place, agent) in agents.iter().enumerate() {
        let at = DVec2::from_angle(angle).rotate(8.0 * DVec2::new((place % 5) as f64, (place / 5) as f64));
        let heading = Some(angle as f32);
        world.add_agent(Agent { position: (origin + at).extend(0.0), heading, ..agent.clone() }).unwrap();
    }
}

/// The rule: in a sub-step no agent gets farther than a sixth of its clearance radius from where its velocity leads, nor
/// moves farther than that radius; no more sub-steps than that takes.
#[test]
fn the_rule_is_what_its_page_says() {
    for case in 0..200 {
        let mut draw = Draw::new(case);
        let step = draw.between(0.005, 1.0);
        let agents: Vec<Agent> = (0..=draw.index(12)).map(|_| random_agent(&mut draw)).collect();
        let [upright, turned] = [(DVec2::ZERO, 0.0), (DVec2::new(-44.0, 5000.0), 1.1)].map(|(origin, angle)| {
            let mut world = with_settings(step, SubSteps::Auto, origin);
            add_apart(&mut world, &agents, angle);
            parts_of_next(&mut world)
        });
        assert_eq!(upright, turned, "case {case}: it depends on the place or the direction");
        let all_keep = |parts: f64| agents.iter().all(|agent| keeps_to_the_rule(agent, step / parts));
        let parts = upright as f64;
        assert!(all_keep(parts * 1.002), "case {case}: {parts} at {step} s are too few");
        assert!(parts == 1.0 || !all_keep((parts - 1.0) * 0.999), "case {case}: {parts} at {step} s are too many");
    }
}

#[test]
fn one_agent_divides_its_steps_and_no_agents_need_no_division() {
    let mut world = with_settings(0.1, SubSteps::Auto, DVec2::ZERO);
    assert_eq!(parts_of_next(&mut world), 1);
    let agent = Agent {
        radius: 0.2,
        motor: Holonomic { max_speed: 2.0, max_acceleration: f32::INFINITY, ..Holonomic::default() }.into(),
        ..Agent::default()
    };
    world.add_agent(agent).unwrap();
    assert_eq!(parts_of_next(&mut world), 6);
    let mut world = with_settings(10.0, SubSteps::Auto, DVec2::ZERO);
    world
        .add_agent(Agent {
            preferred_speed: 0.0,
            motor: Holonomic { max_speed: 0.0, ..Holonomic::default() }.into(),
            ..Agent::default()
        })
        .unwrap();
    assert_eq!(parts_of_next(&mut world), 1);
}

/// A thin door that slides, and a thin body that is slow: neither divides the steps of the whole world.
#[test]
fn thin_bodies_that_are_slow_or_scripted_do_not_count() {
    let mut world = with_settings(0.2, SubSteps::Auto, DVec2::ZERO);
    add_apart(&mut world, &vec![Agent::default(); 9], 0.0);
    let before = parts_of_next(&mut world);
    let [closed, open] =
        [(0.0, 4.0), (1.0, 6.0)].map(|(time, y)| Keyframe { time, at: DVec2::new(-5.0, y), heading: 0.0 });
    let script = world.add_script(Script { keyframes: vec![closed, open], repeat: true }).unwrap();
    let position = closed.at.extend(0.0);
    let thin =
        Agent { position, motor: Holonomic { max_speed: 4.0, ..Holonomic::default() }.into(), ..Agent::default() }
            .with_body(Body::rectangle(1.1, 0.01));
    world.add_agent(Agent { script: Some(script), ..thin.clone() }).unwrap();
    assert_eq!(parts_of_next(&mut world), before);
    let position = DVec2::new(-9.0, 0.0).extend(0.0);
    let slow = Agent {
        preferred_speed: 0.01,
        position,
        motor: Holonomic { max_speed: 0.01, ..Holonomic::default() }.into(),
        ..thin.clone()
    };
    world.add_agent(slow).unwrap();
    assert_eq!(parts_of_next(&mut world), before);
    let position = DVec2::new(-9.0, 9.0).extend(0.0);
    world.add_agent(Agent { position, ..thin }).unwrap();
    assert!(parts_of_next(&mut world) > before, "a fast thin agent counts");
}

/// Agents that do not look ahead move at most a sixth of their radius, agents that a field governs at most 3/8.
#[test]
fn agents_that_do_not_look_ahead_need_shorter_sub_steps() {
    let parts = |group: Group| {
        let mut world = with_settings(0.2, SubSteps::Auto, DVec2::ZERO);
        let group = world.add_group(group).unwrap();
        world
            .add_agent(Agent {
                group,
                radius: 0.3,
                motor: Holonomic { max_speed: 1.8, ..Holonomic::default() }.into(),
                ..Agent::default()
            })
            .unwrap();
        parts_of_next(&mut world)
    };
    let guidance = Guidance::JOURNEY.governed(Governed::new(|_: Vec3, _: f64| Vec3::Y, 1.0));
    let led = Group { guidance, look_ahead: false, ..Group::default() };
    let blind = Group { look_ahead: false, ..Group::default() };
    // sqrt(0.3 / 6 / 5) s, 0.375 * 0.3 / 1.8 s, 0.3 / 6 / 1.8 s
    assert_eq!([Group::default(), led, blind].map(parts), [2, 4, 8]);
}

/// They move at most 0.375 of their radius, and the limit of their acceleration is the force of their vehicle.
#[test]
fn agents_that_steer_have_the_limits_of_their_vehicles() {
    let parts = |max_force| {
        let mut world = with_settings(0.2, SubSteps::Auto, DVec2::ZERO);
        let vehicle = Vehicle { mass: 2.0, max_force, ..Vehicle::default() };
        let group = world.add_group(Group::steered(Wander::default())).unwrap();
        let agent = Agent { group, radius: 0.3, motor: vehicle.into(), ..Agent::default() };
        world.add_agent(agent).unwrap();
        parts_of_next(&mut world)
    };
    // 0.375 * 0.3 / 1.8 s, sqrt(0.3 / 6 / 30) s, 0.3 / 6 / 1.8 s
    assert_eq!((parts(10.0), parts(60.0), parts(1e6)), (4, 5, 8));
}

/// A world that reached a state by loading divides steps as the world that ran to it.
#[test]
fn only_the_state_decides() {
    let crowd = |seed| {
        let mut world = with_settings(0.2, SubSteps::Auto, DVec2::ZERO);
        populate(&mut world, &mut Draw::new(seed), (DVec2::splat(-4.0), DVec2::splat(4.0)), 12, &Kind::default());
        world
    };
    let mut walked = crowd(5);
    let mut loaded = crowd(6);
    for _ in 0..40 {
        loaded.step();
        loaded.load(&walked.save()).unwrap();
        assert_eq!(parts_of_next(&mut loaded), parts_of_next(&mut walked));
    }
}

#[test]
fn every_stage_of_every_sub_step_is_reported_and_changes_nothing() {
    let mut told = pair(0.3, 1.0);
    let mut plain = told.clone();
    let parts = parts_of_next(&mut plain);
    let mut stages = Vec::new();
    told.step_in_stages(|stage| stages.push(stage));
    assert!(parts > 1);
    assert_eq!(stages, Stage::ALL.repeat(parts as usize));
    assert_eq!(told.state_hash(), plain.state_hash());
}
