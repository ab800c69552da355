//! Any motor with any guidance, and guidance that changes.

use super::common::{journey_to, run_for, walker, with_settings, world};
use super::oracle::assert_free;
use super::scenes::clutter;
use crate::draw::Draw;
use glam::{DVec2, Vec2, Vec3};
use std::f64::consts::TAU;
use std::sync::Arc;
use throng::agent::Guidance;
use throng::avoid::{NoAvoidance, Orca};
use throng::field::Governed;
use throng::motion::{Holonomic, Locomotion, Motor, TwoWheels, Vehicle, angle_between};
use throng::parameters::Angle;
use throng::perceive::SimdLevel;
use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};
use throng::{Agent, Body, Group, SubSteps, World};
use throng_steer::{Arrive, Flocking, Seek, Wander};

fn motors(draw: &mut Draw) -> [Motor; 4] {
    let max_speed = draw.between(1.0, 3.0) as f32;
    let max_turn_rate = draw.between(1.0, 6.0) as f32;
    let vehicle = Vehicle { max_speed, max_force: draw.between(2.0, 9.0) as f32, ..Vehicle::default() };
    [
        Holonomic { max_speed, max_acceleration: draw.between(1.0, 9.0) as f32, ..Holonomic::default() }.into(),
        TwoWheels { max_speed, max_turn_rate, tracking_error: 0.05, ..TwoWheels::default() }.into(),
        vehicle.into(),
        Vehicle { max_turn_rate: Angle::from_radians(max_turn_rate), ..vehicle }.into(),
    ]
}

/// Motors and kinds of guidance, all that lead to the same place.
#[test]
fn any_guidance_leads_any_motor_within_its_limits() {
    let mut draw = Draw::new(2611);
    for case in 0..12 {
        let way = DVec2::from_angle(draw.between(0.0, TAU)) * 12.0;
        let to = way.as_vec2().extend(0.0);
        let field = Governed::new(move |at: Vec3, _: f64| (to - at).clamp_length_max(1.0), 1.0);
        let arrive = || Guidance::behaviour(Arrive::new(Target::Point(to)));
        let all = [
            Guidance::JOURNEY,
            Guidance::JOURNEY.governed(field.clone()),
            arrive(),
            arrive().governed(Governed { ratio: 0.5, ..field.clone() }),
            Guidance::behaviour(Arrive::new(Target::Goal)),
        ];
        for motor in motors(&mut draw) {
            for guidance in &all {
                let mut world = with_settings(0.05, SubSteps::Fixed(2), DVec2::ZERO);
                let group = Group { guidance: guidance.clone(), guard: case % 2 == 0, ..Group::default() };
                let group = world.add_group(group).unwrap();
                let agent = walker(&mut world, DVec2::ZERO, way);
                let heading = Some(draw.between(-3.0, 3.0) as f32);
                let id = world.add_agent(Agent { group, heading, ..agent }.motor(motor)).unwrap();
                let name = format!("case {case}: {guidance:?} with {motor:?}");
                assert_eq!(world.agent(id).unwrap().to_agent().motor, motor, "{name}");
                let mut velocity = Vec2::ZERO;
                run_for(&mut world, 40.0, |world| {
                    let now = world.relative_columns().velocity[0];
                    keeps_to(motor, velocity, now, 0.05, &name);
                    velocity = now;
                });
                let left = world.position(id).unwrap().truncate().distance(way);
                assert!(left < 0.5, "{left} m from the place: {name}");
            }
        }
    }
}

/// Checks the motion in a step.
fn keeps_to(motor: Motor, before: Vec2, after: Vec2, seconds: f32, name: &str) {
    let (most, acceleration, turn_rate) = match motor {
        Motor::Holonomic(motor) => (motor.max_speed, motor.max_acceleration, motor.max_turn_rate),
        Motor::TwoWheels(motor) => (motor.max_speed, motor.max_acceleration, motor.max_turn_rate),
        Motor::Vehicle(motor) => (motor.max_speed, motor.max_force / motor.mass, motor.max_turn_rate.radians()),
    };
    assert!(after.length() <= most * 1.001, "{} m/s: {name}", after.length());
    // a body that is limited in turning may lose speed at once
    let gained = if turn_rate.is_finite() { after.length() - before.length() } else { (after - before).length() };
    assert!(gained <= acceleration * seconds * 1.01 + 1e-4, "{gained} m/s gained: {name}");
    let turned = angle_between(before.extend(0.0), after.extend(0.0));
    if before.length().min(after.length()) > 0.05 {
        assert!(turned <= turn_rate * seconds * 1.01 + 1e-3, "turned by {turned}: {name}");
    }
}

fn crowd(seed: u64, level: SimdLevel) -> World {
    let mut draw = Draw::new(seed);
    let mut world = world(0.05, DVec2::ZERO);
    world.set_simd_level(level);
    for obstacle in clutter(&mut draw, DVec2::ZERO, 9.0, 4) {
        world.add_obstacle(obstacle).unwrap();
    }
    let wind = Governed::new(|at: Vec3, _: f64| Vec3::new(-at.y, at.x, 0.0).clamp_length_max(1.0), 0.5);
    let wander = || Guidance::behaviour(Wander::default());
    let all = [Guidance::JOURNEY, Guidance::JOURNEY.governed(wind.clone()), wander(), wander().governed(wind)];
    let groups = all.map(|guidance| world.add_group(Group { guidance, ..Group::default() }).unwrap());
    let kinds = motors(&mut draw);
    for _ in 0..60 {
        let [from, to] = [0; 2].map(|_| draw.point(DVec2::splat(-12.0), DVec2::splat(12.0)));
        let agent = walker(&mut world, from, to).group(draw.one_of(&groups)).motor(draw.one_of(&kinds));
        let body = draw.one_of(&[Body::disc(0.2), Body::disc(0.3), Body::rectangle(1.6, 0.7)]);
        // places that are taken or in walls are left out
        if world.is_free(from.extend(0.0), body.bounding_radius()) {
            let _ = world.add_agent(agent.with_body(body));
        }
    }
    world
}

#[test]
fn crowds_of_all_motors_and_guidance_do_not_overlap() {
    for seed in 0..6 {
        let mut world = crowd(seed, SimdLevel::Best);
        assert!(world.relative_columns().len() > 30);
        run_for(&mut world, 15.0, assert_free);
    }
}

#[test]
fn crowds_of_all_motors_have_the_same_bits_on_all_paths() {
    let after = |level, threads: usize, saved: bool| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut world = crowd(77, level);
            run_for(&mut world, 2.0, |_| {});
            if saved {
                let mut again = crowd(77, level);
                again.load(&world.save()).unwrap();
                world = again;
            }
            run_for(&mut world, 2.0, |_| {});
            world.save()
        })
    };
    let one = after(SimdLevel::Plain, 1, false);
    assert!(one == after(SimdLevel::Best, 1, false) && one == after(SimdLevel::Best, 3, true));
}

/// The oracle is a world that had the other guidance from the start and loads the state at the change.
#[test]
fn a_group_switches_its_guidance_while_it_runs() {
    let field = Governed::new(|_: Vec3, _: f64| Vec3::Y, 0.7);
    let all = [
        Guidance::JOURNEY,
        Guidance::behaviour(Wander::default()),
        Guidance::JOURNEY.governed(field.clone()),
        Guidance::behaviour(Seek { target: Target::Goal }).governed(field),
    ];
    for motor in motors(&mut Draw::new(5)) {
        for first in &all {
            for second in &all {
                let build = |guidance: &Guidance| {
                    let mut world = world(0.05, DVec2::ZERO);
                    let group = Group { guidance: guidance.clone(), resolve: false, ..Group::default() };
                    let group = world.add_group(group).unwrap();
                    for k in 0..4 {
                        let from = DVec2::new(0.0, f64::from(k));
                        let agent = walker(&mut world, from, from + DVec2::X * 30.0);
                        world.add_agent(agent.group(group).motor(motor)).unwrap();
                    }
                    (world, group)
                };
                let ((mut world, group), (mut other, _)) = (build(first), build(second));
                run_for(&mut world, 3.0, |_| {});
                world.set_guidance(group, second.clone()).unwrap();
                other.load(&world.save()).unwrap();
                for _ in 0..60 {
                    world.step();
                    other.step();
                    assert_eq!(world.state_hash(), other.state_hash(), "{first:?}, then {second:?}, {motor:?}");
                }
            }
        }
    }
}

/// An agent that left its path while a behaviour steered it goes on to its goal.
#[test]
fn after_a_behaviour_the_journey_goes_on() {
    let mut world = world(0.05, DVec2::ZERO);
    let wall = throng::Obstacle::Wall { points: vec![DVec2::new(5.0, -6.0), DVec2::new(5.0, 6.0)] };
    world.add_obstacle(wall).unwrap();
    let group = world.add_group(Group::default()).unwrap();
    let agent = walker(&mut world, DVec2::ZERO, DVec2::X * 10.0);
    let id = world.add_agent(agent.group(group)).unwrap();
    run_for(&mut world, 2.0, |_| {});
    let aside = Target::Point(Vec3::new(-8.0, -9.0, 0.0));
    world.set_guidance(group, Guidance::behaviour(Arrive::new(aside))).unwrap();
    run_for(&mut world, 20.0, |_| {});
    assert!(world.position(id).unwrap().truncate().distance(DVec2::new(-8.0, -9.0)) < 0.5);
    world.set_guidance(group, Guidance::JOURNEY).unwrap();
    run_for(&mut world, 40.0, assert_free);
    assert_eq!(world.counts().arrived, 1);
}

/// A field with the whole share leads as if there were no behaviour; without a share it does nothing.
#[test]
fn a_field_governs_a_behaviour_by_its_share() {
    let run = |guidance: Guidance, motor: Motor| {
        let mut world = world(0.05, DVec2::ZERO);
        let group = Group { model: Arc::new(NoAvoidance), guidance, ..Group::default() };
        let group = world.add_group(group).unwrap();
        let id = world.add_agent(Agent::at([0.0, 0.0]).group(group).motor(motor)).unwrap();
        run_for(&mut world, 8.0, |_| {});
        (world.position(id).unwrap().truncate(), world.relative_columns().velocity[0])
    };
    let north = |ratio| Governed::new(|_: Vec3, _: f64| Vec3::Y, ratio);
    let east = || Guidance::behaviour(Seek { target: Target::Point(Vec3::X * 1e4) });
    for motor in motors(&mut Draw::new(8)) {
        let own = run(east(), motor);
        assert_eq!(run(east().governed(north(0.0)), motor), own);
        let (_, led) = run(east().governed(north(1.0)), motor);
        assert!((led - Vec2::Y).length() < 0.05, "{led} with {motor:?}");
        let (_, half) = run(east().governed(north(0.5)), motor);
        let angle = half.to_angle().to_degrees();
        assert!((angle - 45.0).abs() < 3.0, "{angle} degrees with {motor:?}");
    }
}

/// The program's velocity is an aim as any other: a vehicle steers towards it.
#[test]
fn a_commanded_vehicle_keeps_to_its_limits() {
    let mut world = world(0.05, DVec2::ZERO);
    let group = world.add_group(Group::steered(Wander::default())).unwrap();
    let vehicle = Vehicle { max_force: 0.5, response: 0.0, ..Vehicle::default() };
    let id = world.add_agent(Agent::at([0.0, 0.0]).group(group).motor(vehicle)).unwrap();
    world.set_preferred_velocity(id, Vec3::Y).unwrap();
    run_for(&mut world, 1.0, |_| {});
    let velocity = world.relative_columns().velocity[0];
    assert!((velocity - Vec2::Y * 0.5).length() < 1e-3, "{velocity}");
    run_for(&mut world, 2.0, |_| {});
    assert!((world.relative_columns().velocity[0] - Vec2::Y).length() < 1e-3);
    let travelled = world.position(id).unwrap().y;
    assert!((travelled - 2.0).abs() < 0.05, "v²/2a + 1 s at 1 m/s: {travelled} m");
}

/// A command is not a walker's own plan: neither its path nor its goal bends it or slows it down.
#[test]
fn an_agent_that_looks_ahead_goes_where_it_is_commanded() {
    let mut draw = Draw::new(2804);
    for case in 0..20 {
        let mut world = world(0.05, DVec2::ZERO);
        let group = world.add_group(Group { look_ahead: true, ..Group::default() }).unwrap();
        let goal = DVec2::from_angle(draw.between(0.0, TAU)) * draw.between(0.5, 9.0);
        let id = world.add_agent(Agent { group, ..Agent::at([0.0, 0.0]) }.goal(goal)).unwrap();
        let command = Vec2::from_angle(draw.between(0.0, TAU) as f32) * draw.between(0.5, 1.2) as f32;
        world.set_preferred_velocity(id, command.extend(0.0)).unwrap();
        for _ in 0..30 {
            world.step();
            let velocity = world.relative_columns().velocity[0];
            assert!(velocity.angle_to(command).abs() < 1e-3, "case {case}: {velocity} of {command}");
        }
        assert!((world.relative_columns().velocity[0] - command).length() < 1e-3, "case {case}");
    }
}

/// A behaviour that goes east and faces north.
#[derive(Clone, Debug)]
struct Sidestep;

impl Behaviour for Sidestep {
    fn steer(
        &self,
        view: &SteeringInput<'_>,
        _: &mut [f32],
        _: &mut TraceRecorder<'_>,
    ) -> Option<throng::motion::Steering> {
        Some(throng::motion::Steering { facing: Some(Vec3::Y), ..view.reach(Vec3::X) })
    }
}

#[test]
fn agents_face_what_their_behaviour_requests() {
    for motor in [Motor::default(), Vehicle::default().into()] {
        let mut world = world(0.05, DVec2::ZERO);
        let group = world.add_group(Group::steered(Sidestep)).unwrap();
        world.add_agent(Agent::at([0.0, 0.0]).group(group).motor(motor)).unwrap();
        run_for(&mut world, 4.0, |_| {});
        let heading = world.relative_columns().heading[0];
        assert!((heading - std::f32::consts::FRAC_PI_2).abs() < 0.05, "{heading} with {motor:?}");
        assert!(world.relative_columns().position[0].x > 2.5);
    }
}

/// A request to face a direction ends with the behaviour, also while other agents of the world have plans.
#[test]
fn agents_on_their_journeys_face_their_paths_again() {
    let mut world = world(0.05, DVec2::ZERO);
    let group = world.add_group(Group::steered(Sidestep)).unwrap();
    let agent = walker(&mut world, DVec2::ZERO, DVec2::X * 40.0);
    let id = world.add_agent(agent.group(group)).unwrap();
    world.add_agent(Agent::at([0.0, 30.0]).motor(Vehicle::default())).unwrap();
    let heading = |world: &World| world.relative_columns().heading[world.row(id).unwrap()];
    run_for(&mut world, 4.0, |_| {});
    assert!(heading(&world) > 1.5);
    world.set_guidance(group, Guidance::JOURNEY).unwrap();
    run_for(&mut world, 4.0, |_| {});
    assert!(heading(&world).abs() < 0.1, "{}", heading(&world));
}

/// Birds of one flock with vehicles of their own: each keeps to its top speed, and both paths give the same bits.
#[test]
fn vehicles_differ_within_a_group() {
    let build = |level| {
        let mut world = with_settings(0.05, SubSteps::Fixed(1), DVec2::ZERO);
        world.set_simd_level(level);
        let flock = Group { neighbours: Group::ALL_NEIGHBOURS, ..Group::steered(Flocking::default()) };
        let group = world.add_group(flock).unwrap();
        for k in 0..90_u32 {
            let max_speed = 2.0 + (k % 3) as f32;
            let vehicle = Vehicle { max_speed, locomotion: Locomotion::Level, ..Vehicle::default() };
            let at = [f64::from(k % 10), f64::from(k / 10), 20.0 + f64::from(k % 4)];
            world.add_agent(Agent { radius: 0.1, ..Agent::at(at) }.group(group).motor(vehicle)).unwrap();
        }
        world
    };
    let (mut many, mut each) = (build(SimdLevel::Best), build(SimdLevel::Plain));
    for _ in 0..200 {
        many.step();
        each.step();
        let agents = many.relative_columns();
        for row in 0..agents.len() {
            let most = 2.0 + (agents.number[row] % 3) as f32;
            assert!(agents.speed(row) <= most * 1.001);
        }
    }
    assert!(many.save() == each.save());
    let fastest = (0..90).map(|row| many.relative_columns().speed(row)).fold(0.0, f32::max);
    assert!(fastest > 3.5, "{fastest}");
}

/// Vehicles stop at a point and in an area without overshoot, and do not turn round there.
#[test]
fn vehicles_stop_at_their_goals() {
    let mut draw = Draw::new(31);
    for case in 0..40 {
        let vehicle = Vehicle {
            max_speed: draw.between(1.0, 12.0) as f32,
            max_force: draw.between(1.0, 8.0) as f32,
            response: draw.one_of(&[0.0, 0.1, 0.25, 0.6]),
            max_turn_rate: Angle::degrees(draw.between(30.0, 400.0)),
            ..Vehicle::default()
        };
        let mut world = world(draw.one_of(&[0.02, 0.05, 0.1]), DVec2::ZERO);
        let way = DVec2::from_angle(draw.between(0.0, TAU));
        let group = world.add_group(Group::default()).unwrap();
        let agent = walker(&mut world, DVec2::ZERO, way * 40.0).group(group).heading(way.to_angle() as f32);
        let agent = Agent { preferred_speed: vehicle.max_speed, ..agent }.motor(vehicle);
        let id = world.add_agent(agent).unwrap();
        let (mut farthest, mut aside): (f64, f64) = (0.0, 1.0);
        run_for(&mut world, 90.0, |world| {
            let at = world.position(id).unwrap().truncate();
            farthest = farthest.max(at.dot(way));
            let heading = f64::from(world.relative_columns().heading[0]);
            aside = aside.min(DVec2::from_angle(heading).dot(way));
        });
        assert_eq!(world.counts().arrived, 1, "case {case}: {vehicle:?}");
        assert!(farthest < 40.1 && aside > 0.99, "case {case}: {farthest} m, {aside}, {vehicle:?}");
    }
}

/// A car that turns slowly drives its journey through a gap in a wall, around pedestrians.
#[test]
fn a_car_drives_its_journey_among_pedestrians() {
    let mut world = world(0.05, DVec2::ZERO);
    for points in [[DVec2::new(0.0, 2.5), DVec2::new(0.0, 30.0)], [DVec2::new(0.0, -2.5), DVec2::new(0.0, -30.0)]] {
        world.add_obstacle(throng::Obstacle::Wall { points: points.to_vec() }).unwrap();
    }
    let group = world.add_group(Group { model: Arc::new(Orca::default()), ..Group::default() }).unwrap();
    let vehicle = Vehicle {
        mass: 1000.0,
        max_force: 3000.0,
        max_speed: 4.0,
        max_turn_rate: Angle::degrees(40.0),
        ..Vehicle::default()
    };
    let car = walker(&mut world, DVec2::new(-20.0, 9.0), DVec2::new(20.0, -6.0)).group(group);
    let car = Agent { preferred_speed: 4.0, heading: Some(0.0), ..car }.motor(vehicle);
    let car = world.add_agent(car.with_body(Body::rectangle(3.6, 1.6))).unwrap();
    let across = journey_to(&mut world, DVec2::new(-12.0, 0.0));
    for k in 0..20 {
        let at = DVec2::new(6.0 + f64::from(k % 4) * 1.5, f64::from(k / 4) * 1.5 - 3.0);
        world.add_agent(Agent { journey: across, ..Agent::at(at).group(group) }).unwrap();
    }
    let mut heading = 0.0;
    let mut fastest: f32 = 0.0;
    run_for(&mut world, 60.0, |world| {
        assert_free(world);
        let row = world.row(car).unwrap();
        let now = world.relative_columns().heading[row];
        let turned = (now - heading + std::f32::consts::PI).rem_euclid(std::f32::consts::TAU) - std::f32::consts::PI;
        fastest = fastest.max(turned.abs() / 0.05);
        heading = now;
    });
    assert!(fastest.to_degrees() < 40.5, "{} degrees a second", fastest.to_degrees());
    assert_eq!(world.counts().arrived, 21);
}
