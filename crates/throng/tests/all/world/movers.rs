//! Moving obstacles: they follow their scripts, wait for agents in their way, and catch up.

use crate::world::common::{journey_to, rectangle, run, run_for, with_settings};
use glam::DVec2;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use throng::motion::Holonomic;
use throng::{Agent, AgentId, AgentRef, Body, Error, Group, Keyframe, Script, SubSteps, World};

fn keyframe(time: f64, (x, y): (f64, f64), heading: f64) -> Keyframe {
    Keyframe { time, at: DVec2::new(x, y), heading }
}

fn mover(world: &mut World, body: Body, keyframes: &[Keyframe], repeat: bool) -> AgentId {
    let script = world.add_script(Script { keyframes: keyframes.to_vec(), repeat }).unwrap();
    let first = keyframes[0];
    let agent = Agent {
        position: first.at.extend(0.0),
        heading: Some(first.heading as f32),
        script: Some(script),
        preferred_speed: 0.0,
        avoids: 0,
        motor: Holonomic { max_speed: 3.0, max_turn_rate: 3.0, ..Holonomic::default() }.into(),
        ..Agent::default()
    };
    world.add_agent(agent.with_body(body)).unwrap()
}

/// Distance of a mover from the pose of its script, metres and radians.
fn off(world: &World, id: AgentId, script: usize) -> (f64, f64) {
    let there = world.scripts()[script].at(world.time());
    let row = world.row(id).unwrap();
    let turn = f64::from(world.relative_columns().heading[row]) - there.heading;
    (world.position(id).unwrap().distance(there.at.extend(0.0)), (turn + PI).rem_euclid(TAU) - PI)
}

#[test]
fn unhindered_movers_are_where_their_scripts_are() {
    for step in [1.0 / 60.0, 0.1, 0.5] {
        let mut world = with_settings(step, SubSteps::Auto, DVec2::new(500.0, -20.0));
        let path = [
            keyframe(0.0, (500.0, -20.0), 0.0),
            keyframe(5.0, (507.0, -20.0), 0.0),
            keyframe(9.0, (507.0, -13.0), FRAC_PI_2),
        ];
        let car = mover(&mut world, Body::rectangle(4.0, 1.8), &path, false);
        let bar = [keyframe(1.0, (520.0, -20.0), 0.0), keyframe(5.0, (520.0, -20.0), TAU)];
        let bar = mover(&mut world, Body::capsule(2.0, 0.2), &bar, true);
        run_for(&mut world, 12.0, |world| {
            for (id, script) in [(car, 0), (bar, 1)] {
                let (away, turned) = off(world, id, script);
                assert!(away < 1e-3 && turned.abs() < 1e-3, "{away} m and {turned} off at {} s", world.time());
            }
        });
        assert!(world.finished(), "the end of the run does not wait for movers");
        assert_eq!(world.counts().agents, 0, "movers do not count");
    }
}

/// A sliding door meets an agent that stands at a wall and cannot give way: it waits, and catches up when free.
#[test]
fn a_door_that_is_blocked_waits_and_catches_up() {
    let mut world = with_settings(0.05, SubSteps::Auto, DVec2::ZERO);
    let wall = vec![DVec2::new(1.0, -2.0), DVec2::new(1.0, 2.0)];
    world.add_obstacle(throng::Obstacle::Wall { points: wall }).unwrap();
    let path = [keyframe(0.0, (-1.5, 0.0), 0.0), keyframe(2.0, (0.4, 0.0), 0.0), keyframe(20.0, (0.4, 0.0), 0.0)];
    let leaf = mover(&mut world, Body::rectangle(1.0, 0.6), &path, false);
    // in contact with the wall
    let stands = Agent {
        position: DVec2::new(0.795, 0.0).extend(0.0),
        preferred_speed: 0.0,
        motor: Holonomic { max_speed: 0.001, ..Holonomic::default() }.into(),
        ..Agent::default()
    };
    let person = world.add_agent(stands).unwrap();
    run_for(&mut world, 6.0, |_| ());
    let (away, _) = off(&world, leaf, 0);
    assert!(away > 0.2 && away < 0.4, "it stands at the person: {away} m off");
    assert!(world.summary().overlaps == 0 && world.summary().least_separation > 0.9999);
    assert!(world.remove_agent(person));
    run_for(&mut world, 1.0, |_| ());
    let (away, _) = off(&world, leaf, 0);
    assert!(away < 1e-3, "{away} m off when the way is free");
}

/// A hinged door swings through agents, to and fro, and a revolving door takes them round: no agent is crushed.
#[test]
fn doors_that_turn_crush_no_agent() {
    for step in [1.0 / 60.0, 0.1, 0.5] {
        let mut world = with_settings(step, SubSteps::Auto, DVec2::ZERO);
        let hinge = |time, angle: f64| keyframe(time, (0.6 * angle.cos(), 0.6 * angle.sin()), angle);
        let swing = |from: f64, to: f64, start: f64| {
            (0..=8).map(move |k| hinge(start + 0.25 * f64::from(k), from + (to - from) * f64::from(k) / 8.0))
        };
        let script: Vec<Keyframe> = swing(-1.2, 1.2, 0.0).chain(swing(1.2, -1.2, 3.0)).collect();
        mover(&mut world, Body::rectangle(1.2, 0.1), &script, true);
        for wing in [0.0, FRAC_PI_2] {
            let turn = [keyframe(0.0, (4.0, 0.0), wing), keyframe(8.0, (4.0, 0.0), wing + TAU)];
            mover(&mut world, Body::capsule(2.4, 0.1), &turn, true);
        }
        for k in 0..14 {
            let position = DVec2::new(-3.0 - 0.5 * f64::from(k / 4), 0.5 * f64::from(k % 4) - 0.75);
            let journey = journey_to(&mut world, DVec2::new(8.0 + 0.5 * f64::from(k / 4), -position.y));
            world.add_agent(Agent { position: position.extend(0.0), journey, ..Agent::default() }).unwrap();
        }
        run(&mut world, 90.0, |_| ());
        let summary = world.summary();
        assert_eq!((summary.arrived, summary.overlaps), (14, 0), "step {step}: {summary:?}");
    }
}

/// Walls do not count for a mover without guard: the figures are those of the walker alone.
#[test]
fn a_mover_that_leaves_the_ground_is_in_no_wall_figure() {
    let summary = |moves: bool, guard: bool| {
        let mut world = with_settings(0.05, SubSteps::Fixed(4), DVec2::ZERO);
        let ground = rectangle(DVec2::ZERO, DVec2::new(20.0, 30.0), 0.0);
        world.set_walkable(vec![throng::Walkable { outer: ground, holes: vec![] }]).unwrap();
        // the walker passes a corner as close as its body permits
        world.add_obstacle(throng::Obstacle::rectangle(DVec2::new(0.0, -3.0), DVec2::splat(2.0), 0.0)).unwrap();
        let journey = journey_to(&mut world, DVec2::new(8.0, -3.0));
        let straight = world.add_group(Group { look_ahead: false, keep_right: 0.0, ..Group::default() }).unwrap();
        let position = DVec2::new(-8.0, -3.0);
        world
            .add_agent(Agent { position: position.extend(0.0), journey, group: straight, ..Agent::default() })
            .unwrap();
        if moves {
            let group = world.add_group(Group { guard, ..Group::default() }).unwrap();
            let path = [keyframe(0.0, (-8.0, 12.0), 0.0), keyframe(10.0, (14.0, 12.0), 0.0)];
            let id = mover(&mut world, Body::rectangle(1.0, 0.6), &path, false);
            let agent = world.agent(id).map(AgentRef::to_agent).unwrap();
            world.replace(id, Agent { group, ..agent }).unwrap();
        }
        run_for(&mut world, 15.0, |_| ());
        world.summary()
    };
    let (alone, beside) = (summary(false, true), summary(true, false));
    assert!(alone.least_wall_separation < 2.0 && alone.overlaps == 0, "{alone:?}");
    assert_eq!((beside.least_wall_separation, beside.overlaps), (alone.least_wall_separation, 0));
    // a guarded mover is held at the wall, and counts
    let held = summary(true, true);
    assert!((0.9999..1.01).contains(&held.least_wall_separation) && held.overlaps == 0, "{held:?}");
}

#[test]
fn what_is_no_script_is_refused() {
    let mut world = with_settings(0.05, SubSteps::Auto, DVec2::ZERO);
    for (keyframes, repeat) in [
        (vec![], false),
        (vec![keyframe(0.0, (0.0, 0.0), 0.0)], true),
        (vec![keyframe(1.0, (0.0, 0.0), 0.0), keyframe(1.0, (1.0, 0.0), 0.0)], false),
        (vec![keyframe(0.0, (f64::NAN, 0.0), 0.0)], false),
        (vec![keyframe(0.0, (0.0, 0.0), f64::INFINITY)], false),
        (vec![keyframe(0.0, (1e6, 0.0), 0.0)], false),
    ] {
        let error = world.add_script(Script { keyframes, repeat }).unwrap_err();
        assert!(matches!(error, Error::Limit { .. }), "{error}");
    }
}
