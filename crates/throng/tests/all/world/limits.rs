//! A body's limits hold where the guard does not act: acceleration, top speed, turning; and headings rest.

use crate::world::common::{Draw, journey_into, run, run_for, walker, with_settings, world};
use crate::world::oracle::rounding_speed;
use glam::{DVec2, Vec2};
use std::sync::Arc;
use throng::avoid::{AnticipationVelocity, Avo, LocalModel};
use throng::motion::Holonomic;
use throng::{Agent, Body, Goal, Group, Obstacle, SubSteps, World};

/// Steps one sub-step at a time until `limit`, and checks the limits of the first agent.
fn hold_to_limits(world: &mut World, limit: f64) {
    let seconds = world.settings().step;
    let (mut velocity, mut heading) = (world.relative_columns().velocity[0], world.relative_columns().heading[0]);
    while world.time() < limit {
        world.step();
        let agents = world.relative_columns();
        let rounding = 2.0 * rounding_speed(agents.position[0], seconds);
        let change = f64::from(agents.velocity[0].distance(velocity));
        let most = f64::from(agents.max_acceleration[0]) * seconds;
        assert!(change <= most * (1.0 + 1e-4) + rounding, "at {:.3} s: {change} of {most} m/s", world.time());
        let speed = f64::from(agents.velocity[0].length());
        assert!(speed <= f64::from(agents.max_speed[0]) * (1.0 + 1e-5) + rounding, "{speed} m/s");
        let turn = f64::from(agents.heading[0] - heading);
        let turn = turn.sin().atan2(turn.cos()).abs();
        let most = f64::from(agents.max_turn_rate[0]) * seconds;
        assert!(turn <= most * (1.0 + 1e-4) + 1e-5, "at {:.3} s: {turn} of {most} rad", world.time());
        (velocity, heading) = (agents.velocity[0], agents.heading[0]);
    }
}

#[test]
fn a_lone_agent_keeps_its_limits_from_start_to_rest() {
    let mut draw = Draw::new(8);
    for case in 0..30 {
        let step = draw.one_of(&[1.0 / 60.0, 0.04, 0.1, 0.25]);
        let origin = draw.point(DVec2::splat(-8e3), DVec2::splat(8e3));
        let mut world = with_settings(step, SubSteps::Fixed(1), origin);
        let way = DVec2::from_angle(draw.between(0.0, 6.3)) * draw.between(6.0, 12.0);
        let plain = walker(&mut world, origin, origin + way);
        let preferred_speed = draw.between(0.4, 2.0) as f32;
        let agent = Agent {
            heading: Some(draw.between(-3.0, 3.0) as f32),
            preferred_speed,
            motor: Holonomic {
                max_speed: preferred_speed * 1.2,
                max_acceleration: draw.between(0.3, 6.0) as f32,
                max_turn_rate: draw.one_of(&[0.7, 2.0, f32::INFINITY]),
            }
            .into(),
            ..plain
        };
        world.add_agent(agent).unwrap();
        hold_to_limits(&mut world, 40.0 + 12.0 / f64::from(preferred_speed));
        assert_eq!(world.summary().arrived, 1, "case {case} at {step} s: {:?}", world.relative_columns());
        assert!(world.relative_columns().velocity[0].length() < 1e-3, "case {case}: it rests");
    }
}

/// Neighbours avoid the moving ends of a body, so that long bodies that turn fast scatter a crowd.
#[test]
fn the_ends_of_a_long_body_turn_no_faster_than_the_agent_walks() {
    let mut draw = Draw::new(12);
    for case in 0..20 {
        let seconds = draw.one_of(&[0.02, 0.05, 0.1]);
        let origin = draw.point(DVec2::splat(-5e3), DVec2::splat(5e3));
        let mut world = with_settings(seconds, SubSteps::Fixed(1), origin);
        let way = DVec2::from_angle(draw.between(0.0, 6.3)) * 12.0;
        let back = libm::atan2(-way.y, -way.x) as f32;
        let (length, width) = (draw.between(1.0, 4.0) as f32, draw.between(0.3, 0.8) as f32);
        let preferred_speed = draw.between(0.5, 2.0) as f32;
        let agent = Agent {
            heading: Some(back),
            preferred_speed,
            motor: Holonomic {
                max_speed: 2.0 * preferred_speed,
                max_turn_rate: draw.one_of(&[12.0, f32::INFINITY]),
                ..Holonomic::default()
            }
            .into(),
            ..walker(&mut world, origin, origin + way)
        };
        let body = draw.one_of(&[Body::capsule(length, width), Body::rectangle(length, width)]);
        world.add_agent(agent.with_body(body)).unwrap();
        let (mut heading, mut fastest) = (f64::from(world.relative_columns().heading[0]), 0.0);
        run_for(&mut world, 60.0, |world| {
            let turned = f64::from(world.relative_columns().heading[0]) - heading;
            fastest = turned.sin().atan2(turned.cos()).abs().max(fastest);
            heading = f64::from(world.relative_columns().heading[0]);
        });
        let most = f64::from(preferred_speed / body.core.length()) * seconds;
        assert!(fastest <= most + 1e-5, "case {case}: {fastest} of {most} rad");
        assert!(fastest > 0.5 * most, "case {case}: it turns, {fastest} of {most} rad");
        assert_eq!(world.summary().arrived, 1, "case {case}: {:?}", world.relative_columns());
    }
}

/// A car that can neither turn on the spot nor stop at once drives through crossing pedestrians: it brakes for them as
/// hard as its body can, and only the guard, at a contact, may demand more.
#[test]
fn a_car_brakes_for_people_that_cross_its_way() {
    let (mut steps, mut beyond, mut slowest) = (0, 0, f32::INFINITY);
    for seed in 1..=6 {
        let mut draw = Draw::new(seed);
        let angle = draw.between(0.0, 6.3);
        let origin = draw.point(DVec2::splat(-3e3), DVec2::splat(3e3));
        let turned = |x: f64, y: f64| origin + DVec2::from_angle(angle).rotate(DVec2::new(x, y));
        let seconds = draw.one_of(&[0.02, 0.04, 0.05]);
        let mut world = with_settings(seconds, SubSteps::Fixed(1), origin);
        let plain = Group { name: "car".into(), look_ahead: false, ..Group::default() };
        let cars = world.add_group(plain).unwrap();
        let car = Agent {
            group: cars,
            heading: Some(angle as f32),
            preferred_speed: 2.5,
            priority: 0.8,
            position: turned(-14.0, 0.0).extend(0.0),
            journey: journey_into(&mut world, Goal::Point { at: turned(18.0, 0.0), tolerance: 1.0 }),
            motor: Holonomic { max_speed: 3.0, max_acceleration: 2.0, max_turn_rate: 0.35 }.into(),
            ..Agent::default()
        };
        world.add_agent(car.with_body(Body::rectangle(4.2, 1.8))).unwrap();
        for place in 0..60 {
            let (x, y) = (f64::from(place % 10) * 1.5 - 7.0, 5.0 + f64::from(place / 10 % 3) * 1.8);
            let side = if place < 30 { 1.0 } else { -1.0 };
            let (x, y) = (x + draw.between(-0.4, 0.4), side * (y + draw.between(-0.4, 0.4)));
            let person = walker(&mut world, turned(x, y), turned(x, -y));
            world.add_agent(person).unwrap();
        }
        let mut velocity = Vec2::ZERO;
        let middle = turned(0.0, 0.0);
        run_for(&mut world, 60.0, |world| {
            let agents = world.relative_columns();
            let change = agents.velocity[0].distance(velocity) / seconds as f32;
            velocity = agents.velocity[0];
            steps += 1;
            beyond += u32::from(change > 2.0 * 1.01);
            let heading = Vec2::from_angle(agents.heading[0]);
            assert!(velocity.dot(heading) > -1e-3, "seed {seed}: it goes backwards at {:.2} s", world.time());
            if (agents.position[0].as_dvec2() + origin).distance(middle) < 6.0 {
                slowest = slowest.min(velocity.length());
            }
        });
        let summary = world.summary();
        assert_eq!((summary.arrived, summary.overlaps), (61, 0), "seed {seed}: {summary:?}");
    }
    assert!(slowest < 2.0, "it brakes, to {slowest} m/s");
    assert!(100 * beyond <= steps, "it brakes harder than it can in {beyond} of {steps} steps");
}

#[test]
fn a_lone_agent_reaches_its_preferred_speed_and_no_more() {
    let mut world = with_settings(0.05, SubSteps::Fixed(1), DVec2::new(500.0, 77.0));
    let origin = world.settings().origin;
    let group = world.add_group(Group { relaxation_time: 0.0, ..Group::default() }).unwrap();
    let agent = Agent {
        group,
        motor: Holonomic { max_acceleration: 1.0, ..Holonomic::default() }.into(),
        ..walker(&mut world, origin, origin + DVec2::new(-30.0, 14.0))
    };
    world.add_agent(agent).unwrap();
    run_for(&mut world, 1.0, |_| {});
    assert!((world.relative_columns().velocity[0].length() - 1.0).abs() < 1e-3, "1 m/s2 for 1 s");
    run_for(&mut world, 5.0, |_| {});
    assert!((world.relative_columns().velocity[0].length() - 1.3).abs() < 1e-3);
}

/// The speed of an agent that starts follows v (1 - exp(-t / relaxation time)), and its acceleration is at most v over
/// that time.
#[test]
fn an_agent_comes_to_its_speed_in_its_relaxation_time() {
    for (time, step) in [(0.4, 0.004), (0.4, 0.01), (1.5, 0.02)] {
        let mut world = with_settings(step, SubSteps::Fixed(1), DVec2::new(-3e3, 40.0));
        let origin = world.settings().origin;
        let group = world.add_group(Group { relaxation_time: time, ..Group::default() }).unwrap();
        let agent = Agent { group, ..walker(&mut world, origin, origin + DVec2::new(12.0, 31.0)) };
        world.add_agent(agent).unwrap();
        let mut before = 0.0;
        while world.time() < 4.0 * f64::from(time) {
            world.step();
            let speed = f64::from(world.relative_columns().velocity[0].length());
            let exact = 1.3 * (1.0 - (-world.time() / f64::from(time)).exp());
            // an implicit Euler step lags by half a step
            assert!(
                (speed - exact).abs() < 0.7 * step / f64::from(time),
                "{speed} of {exact} m/s at {} s",
                world.time()
            );
            assert!((speed - before) / step < 1.3 / f64::from(time), "{} m/s2", (speed - before) / step);
            before = speed;
        }
    }
}

/// A defect: agents relaxed velocities for models that relax them themselves. Together that took many seconds.
#[test]
fn a_model_with_a_delay_of_its_own_relaxes_by_that_alone() {
    let velocity_after = |model: Arc<dyn LocalModel>, seconds: f64, (angle, start): (f64, Vec2)| {
        let mut world = with_settings(0.01, SubSteps::Fixed(1), DVec2::new(-90.0, 7.0));
        let origin = world.settings().origin;
        let group = world.add_group(Group { model, ..Group::default() }).unwrap();
        let velocity = Vec2::from_angle(angle as f32).rotate(start);
        let walks = walker(&mut world, origin, origin + DVec2::from_angle(angle) * 400.0);
        world
            .add_agent(Agent {
                group,
                velocity,
                motor: Holonomic { max_acceleration: 50.0, ..Holonomic::default() }.into(),
                ..walks
            })
            .unwrap();
        run_for(&mut world, seconds, |_| {});
        Vec2::from_angle(-angle as f32).rotate(world.relative_columns().velocity[0])
    };
    for (delay, angle) in [(0.25f32, 0.7), (0.8, -2.5)] {
        let model = Arc::new(Avo { delay, ..Avo::default() });
        let velocity = velocity_after(model, 3.0 * f64::from(delay), (angle, Vec2::ZERO));
        let exact = 1.3 * (1.0 - (-3.0f32).exp());
        assert!((velocity.x - exact).abs() < 0.03, "delay {delay} s: {velocity}, not {exact} m/s");
    }
    for (reaction_time, angle) in [(0.3f32, 1.9), (1.0, -0.4)] {
        let model = Arc::new(AnticipationVelocity { reaction_time, ..AnticipationVelocity::default() });
        let start = Vec2::from_angle(1.0) * 1.3;
        let velocity = velocity_after(model, 3.0 * f64::from(reaction_time), (angle, start));
        let off = velocity.to_angle().to_degrees();
        assert!(off.abs() < 6.0, "reaction time {reaction_time} s: {off} degrees off the way");
    }
}

/// A sideways velocity decays in half of the relaxation time.
#[test]
fn an_agent_that_is_carried_aside_is_back_in_half_of_its_relaxation_time() {
    for (time, angle) in [(0.45f32, 0.4), (1.2, 3.8)] {
        let mut world = with_settings(0.01, SubSteps::Fixed(1), DVec2::new(15.0, -220.0));
        let origin = world.settings().origin;
        let along = DVec2::from_angle(angle);
        let group = world.add_group(Group { relaxation_time: time, ..Group::default() }).unwrap();
        let velocity = (along * 1.3 + along.perp() * 0.6).as_vec2();
        let agent = Agent { group, velocity, ..walker(&mut world, origin, origin + along * 400.0) };
        world.add_agent(agent).unwrap();
        run_for(&mut world, 0.5 * f64::from(time), |_| {});
        let aside = f64::from(world.relative_columns().velocity[0].dot(along.perp().as_vec2()));
        let exact = 0.6 * (-1.0f64).exp();
        assert!((aside - exact).abs() < 0.02, "{aside} of {exact} m/s aside after half of {time} s");
    }
}

/// Round a block, at all angles: the path bends, the limits hold.
#[test]
fn limits_hold_on_the_way_round_a_corner() {
    for (case, turn_rate) in [1.0f32, 2.0, 5.0, f32::INFINITY].into_iter().enumerate() {
        let angle = 0.3 + 1.1 * case as f64;
        let along = DVec2::from_angle(angle);
        let mut world = with_settings(1.0 / 30.0, SubSteps::Fixed(1), DVec2::new(-6000.0, 700.0));
        let origin = world.settings().origin;
        world.add_obstacle(Obstacle::rectangle(origin, DVec2::new(2.0, 6.0), angle)).unwrap();
        let plain = walker(&mut world, origin - along * 5.0, origin + along * 5.0 + along.perp());
        let agent = Agent {
            motor: Holonomic { max_acceleration: 2.5, max_turn_rate: turn_rate, ..Holonomic::default() }.into(),
            ..plain
        };
        world.add_agent(agent).unwrap();
        hold_to_limits(&mut world, 25.0);
        let summary = world.summary();
        assert_eq!((summary.arrived, summary.overlaps), (1, 0), "turning {turn_rate} rad/s");
    }
}

/// A body that turns slowly faces its direction of motion.
#[test]
fn with_a_turn_limit_no_agent_walks_sideways() {
    let mut world = with_settings(1.0 / 30.0, SubSteps::Fixed(1), DVec2::ZERO);
    let plain = walker(&mut world, DVec2::ZERO, DVec2::new(-9.0, 3.0));
    let agent = Agent {
        heading: Some(0.4),
        motor: Holonomic { max_acceleration: 2.0, max_turn_rate: 1.2, ..Holonomic::default() }.into(),
        ..plain
    };
    world.add_agent(agent).unwrap();
    run(&mut world, 30.0, |world| {
        let (velocity, heading) = (world.relative_columns().velocity[0], world.relative_columns().heading[0]);
        if velocity.length() > 0.1 {
            let off = Vec2::from_angle(heading).angle_to(velocity).abs();
            assert!(off < 0.01, "at {:.2} s it moves {off} rad off its heading", world.time());
        }
    });
    assert!(world.finished());
}

#[test]
fn standing_agents_keep_their_heading_to_the_bit() {
    let mut world = world(0.05, DVec2::new(12.0, 4000.0));
    let agent = Agent { position: DVec2::new(11.0, 4001.0).extend(0.0), heading: Some(2.5), ..Agent::default() };
    let id = world.add_agent(agent).unwrap();
    let start = world.position(id);
    for _ in 0..400 {
        world.step();
    }
    assert_eq!(world.relative_columns().heading[0], 2.5);
    assert_eq!(world.position(id), start);
}

/// A defect: the speed for arriving uses the whole braking force, so an agent that is off the straight line (by
/// keep-right, or by a late step) has none left to turn with, and circles the goal for ever, wider and wider.
#[test]
fn vehicles_stop_at_their_goals() {
    for (speed, max_acceleration) in [(10.0f32, 1.0), (30.0, 3.0), (30.0, 5.0), (10.0, 0.3)] {
        let mut world = with_settings(0.02, SubSteps::Fixed(1), DVec2::ZERO);
        let braking = f64::from(speed * speed / max_acceleration) * 0.5;
        let plain = walker(&mut world, DVec2::new(-braking - 5.0, 0.0), DVec2::new(braking + 5.0, 0.0));
        let agent = Agent {
            preferred_speed: speed,
            motor: Holonomic { max_speed: speed, max_acceleration, ..Holonomic::default() }.into(),
            ..plain
        };
        world.add_agent(agent).unwrap();
        let free = f64::from(speed / max_acceleration) + (2.0 * braking + 10.0) / f64::from(speed);
        run(&mut world, 3.0 * free, |_| {});
        let walked = world.relative_columns().trip(0).walked;
        assert!(world.finished(), "{speed} m/s, {max_acceleration} m/s2: {walked} m in {} s", world.time());
    }
}
