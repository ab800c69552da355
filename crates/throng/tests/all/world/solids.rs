//! Solids: no agent enters them, with any chosen velocity, checked against closed forms in `f64`, throughout every
//! step.

use crate::world::common::Draw;
use crate::world::determinism::with_threads;
use glam::{DQuat, DVec3, Quat, Vec3};
use proptest::prelude::*;
use std::sync::Arc;
use throng::motion::Motor;
use throng::motion::{Locomotion, Steering, Vehicle};
use throng::perceive::SimdLevel;
use throng::space::surface::{Capsule, Cuboid, Moved, Pose, SeenFrom, Sphere, Surface, Union};
use throng::steer::{Barriers, Behaviour, BoxedBehaviour, SteeringInput, TraceRecorder};
use throng::{Agent, Group, Settings, SubSteps, World};
use throng_steer::Flocking;

/// A shape and its distance, in closed form.
#[derive(Clone, Copy, Debug)]
enum Shape {
    Ball(Vec3, f32),
    Block(Vec3, Quat, Vec3),
    Rod(Vec3, Vec3, f32),
}

impl Shape {
    fn surface(self) -> Arc<dyn Surface> {
        match self {
            Self::Ball(center, radius) => Arc::new(Sphere::new(center, radius).unwrap()),
            Self::Block(center, turn, size) => {
                Arc::new(Moved::new(Cuboid::new(size).unwrap(), Pose::new(center, turn).unwrap()))
            }
            Self::Rod(start, end, radius) => Arc::new(Capsule::new(start, end, radius).unwrap()),
        }
    }

    fn distance(self, p: DVec3) -> f64 {
        match self {
            Self::Ball(center, radius) => p.distance(center.as_dvec3()) - f64::from(radius),
            Self::Block(center, turn, size) => {
                let turn: DQuat = turn.as_dquat().normalize();
                let q = (turn.inverse() * (p - center.as_dvec3())).abs() - size.as_dvec3() * 0.5;
                q.max(DVec3::ZERO).length() + q.max_element().min(0.0)
            }
            Self::Rod(start, end, radius) => {
                let (start, along) = (start.as_dvec3(), (end - start).as_dvec3());
                let t = ((p - start).dot(along) / along.length_squared()).clamp(0.0, 1.0);
                (p - start - along * t).length() - f64::from(radius)
            }
        }
    }
}

/// Obstacles, as a union or as single barriers, and a ball that agents stay in.
#[derive(Clone, Debug)]
struct Cage {
    shapes: Vec<Shape>,
    as_one: bool,
    inside: Option<(Vec3, f32)>,
}

impl Cage {
    fn barriers(&self) -> Barriers {
        let all: Vec<Arc<dyn Surface>> = self.shapes.iter().map(|shape| shape.surface()).collect();
        let obstacles = Barriers::default();
        let obstacles = match self.as_one {
            true if !all.is_empty() => obstacles.with(Union::new(all).unwrap(), SeenFrom::Outside),
            _ => all.into_iter().fold(obstacles, |barriers, one| barriers.with(one, SeenFrom::Outside)),
        };
        match self.inside {
            Some((center, radius)) => obstacles.with(Sphere::new(center, radius).unwrap(), SeenFrom::Inside),
            None => obstacles,
        }
    }

    /// The distance from a place to each barrier.
    fn rooms(&self, p: DVec3) -> Vec<f64> {
        let mut rooms: Vec<f64> = self.shapes.iter().map(|shape| shape.distance(p)).collect();
        if self.as_one && !rooms.is_empty() {
            rooms = vec![rooms.iter().copied().fold(f64::INFINITY, f64::min)];
        }
        rooms.extend(self.inside.map(|(center, radius)| f64::from(radius) - p.distance(center.as_dvec3())));
        rooms
    }
}

/// Moves in a random direction at a random speed, with a new one at intervals.
#[derive(Debug)]
struct Jolt {
    /// Seconds for which it keeps a direction.
    keeps: f64,
}

impl Behaviour for Jolt {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        let mut draw = Draw::new(((view.time / self.keeps) as u64) << 20 | view.slot() as u64);
        draw.bits();
        let mut part = || draw.between(-1.0, 1.0) as f32;
        let direction = Vec3::new(part(), part(), part());
        Some(view.reach(view.passable(direction) * view.vehicle.max_speed))
    }
}

fn place(world: &World, row: usize) -> Vec3 {
    world.relative_columns().position[row].extend(world.relative_columns().altitude[row])
}

/// The vehicle of agents that jolt.
fn jolting(max_speed: f32) -> Vehicle {
    Vehicle { max_speed, max_force: 1e9, response: 0.0, locomotion: Locomotion::Level, ..Vehicle::default() }
}

fn jolted(solid: Barriers, keeps: f64, guard: bool) -> Group {
    Group { solid, guard, neighbour_distance: 1.0, ..Group::steered(BoxedBehaviour::from(Jolt { keeps })) }
}

/// A world with these balls in it, with undivided steps.
fn filled(group: Group, motor: impl Into<Motor>, balls: &[(Vec3, f32)], step: f64, seed: u64) -> World {
    let settings = Settings { step, sub_steps: SubSteps::Fixed(1), seed, ..Settings::default() };
    let mut world = World::new(settings).unwrap();
    let (motor, group) = (motor.into(), world.add_group(group).unwrap());
    for &(at, radius) in balls {
        let position = at.truncate().as_dvec2();
        let agent = Agent {
            position: position.extend(f64::from(at.z)),
            radius,
            group,
            preferred_speed: motor.max_speed().min(1.0),
            motor,
            ..Agent::default()
        };
        world.add_agent(agent).unwrap();
    }
    world
}

const TIMES: u32 = 64;

/// Makes some steps and checks sampled times of each.
fn check(world: &mut World, cage: &Cage, steps: usize) -> Result<(), TestCaseError> {
    for step in 0..steps {
        let before: Vec<Vec3> = (0..world.relative_columns().len()).map(|row| place(world, row)).collect();
        world.step();
        for (row, &from) in before.iter().enumerate() {
            let (to, radius) = (place(world, row), f64::from(world.relative_columns().radius[row]));
            let rounding = 4e-6 * (1.0 + f64::from(from.abs().max(to.abs()).max_element()));
            let (from, to) = (from.as_dvec3(), to.as_dvec3());
            let start = cage.rooms(from);
            for i in 1..=TIMES {
                let at = from.lerp(to, f64::from(i) / f64::from(TIMES));
                for (k, (room, start)) in cage.rooms(at).into_iter().zip(&start).enumerate() {
                    let needed = radius.min(*start) - rounding;
                    // for an agent that starts inside, only the end counts
                    if *start > 0.0 || i == TIMES {
                        prop_assert!(
                            room >= needed,
                            "{} at {}/{} of step {}: {} of {}, side {}",
                            row,
                            i,
                            TIMES,
                            step,
                            room,
                            needed,
                            k
                        );
                    }
                }
            }
        }
    }
    Ok(())
}

fn vector(size: f32) -> impl Strategy<Value = Vec3> {
    (-size..size, -size..size, -size..size).prop_map(Vec3::from)
}

fn shape() -> impl Strategy<Value = Shape> {
    let at = || vector(4.0).prop_map(|at| at + Vec3::Z * 5.0);
    let turn = (vector(1.0), -1.0f32..1.0).prop_map(|(v, w)| Quat::from_xyzw(v.x, v.y, v.z, w + 1.5));
    let size = (0.1f32..4.0, 0.1f32..4.0, 0.1f32..4.0).prop_map(Vec3::from);
    prop_oneof![
        (at(), 0.1f32..2.0).prop_map(|(at, radius)| Shape::Ball(at, radius)),
        (at(), turn, size).prop_map(|(at, turn, size)| Shape::Block(at, turn, size)),
        (at(), at(), 0.05f32..1.0).prop_map(|(a, b, radius)| Shape::Rod(a, b + Vec3::splat(0.01), radius)),
    ]
}

fn cage() -> impl Strategy<Value = Cage> {
    let inside = prop::option::of((5.0f32..9.0).prop_map(|radius| (Vec3::Z * 5.0, radius)));
    (prop::collection::vec(shape(), 0..6), any::<bool>(), inside).prop_map(|(shapes, as_one, inside)| Cage {
        shapes,
        as_one,
        inside,
    })
}

fn balls() -> impl Strategy<Value = Vec<(Vec3, f32)>> {
    // some on the ground, some in a solid
    let at = (vector(5.0), 0u8..4).prop_map(|(at, k)| if k == 0 { at.with_z(0.0) } else { at + Vec3::Z * 5.0 });
    prop::collection::vec((at, prop_oneof![3 => 0.005f32..0.3, 1 => 0.3f32..1.0]), 1..30)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    /// With any chosen velocity, at any time step, guarded or not.
    #[test]
    fn no_agent_gets_in(
        cage in cage(), balls in balls(), speed in 0.1f32..20.0, step in prop_oneof![0.01f64..0.1, 0.1f64..1.0],
        guard: bool, seed: u64, lanes: bool,
    ) {
        let mut world = filled(jolted(cage.barriers(), 3.0 * step, guard), jolting(speed), &balls, step, seed);
        if !lanes {
            world.set_simd_level(SimdLevel::Plain);
        }
        check(&mut world, &cage, 20)?;
    }
}

/// Columns in a bowl, away from the origin.
fn columns() -> Cage {
    let column = |k: u32| {
        let around = std::f32::consts::TAU * k as f32 / 7.0;
        let (sin, cos) = libm::sincosf(around);
        let foot = Vec3::new(2.5 * cos, 2.5 * sin, 0.0);
        let lean = Vec3::new(0.3 * sin, 0.5, 8.0);
        if k.is_multiple_of(2) {
            Shape::Rod(foot, foot + lean, 0.3)
        } else {
            Shape::Block(foot + Vec3::Z * 3.0, Quat::from_rotation_z(around + 0.4), Vec3::new(0.8, 0.5, 9.0))
        }
    };
    Cage { shapes: (0..7).map(column).collect(), as_one: true, inside: Some((Vec3::Z * 4.0, 5.0)) }
}

/// Returns this number of balls that are free of all barriers.
fn free(cage: &Cage, count: usize, radius: f32) -> Vec<(Vec3, f32)> {
    let mut draw = Draw::new(7);
    let mut found: Vec<(Vec3, f32)> = Vec::new();
    while found.len() < count {
        let mut part = |low: f64, high: f64| draw.between(low, high) as f32;
        let at = Vec3::new(part(-5.0, 5.0), part(-5.0, 5.0), part(radius.into(), 9.0));
        let room = cage.rooms(at.as_dvec3()).into_iter().fold(f64::INFINITY, f64::min);
        if room > 1.1 * f64::from(radius) && found.iter().all(|other| other.0.distance(at) > 2.2 * radius) {
            found.push((at, radius));
        }
    }
    found
}

/// Runs for some seconds; no agent is ever inside, and the figures agree.
fn run(mut world: World, cage: &Cage, seconds: f64) -> World {
    while world.time() < seconds {
        world.step();
        for row in 0..world.relative_columns().len() {
            let rooms = cage.rooms(place(&world, row).as_dvec3());
            let room = rooms.into_iter().fold(f64::INFINITY, f64::min);
            let radius = f64::from(world.relative_columns().radius[row]);
            assert!(room >= radius - 2e-5, "{row} at {} s: {room} of {radius}", world.time());
        }
    }
    let summary = world.summary();
    assert!(summary.least_wall_separation >= 0.999_999 && summary.least_wall_separation < 1.1, "{summary:?}");
    world
}

#[test]
fn fast_swarms_stay_out_of_columns_for_ten_minutes() {
    let cage = columns();
    let group = jolted(cage.barriers(), 0.4, false);
    run(filled(group, jolting(6.0), &free(&cage, 250, 0.02), 0.05, 1), &cage, 600.0);
}

#[test]
fn in_a_guarded_swarm_no_agent_overlaps_anything() {
    let cage = columns();
    let group = jolted(cage.barriers(), 0.4, true);
    let world = run(filled(group, jolting(3.0), &free(&cage, 200, 0.15), 0.05, 1), &cage, 60.0);
    let summary = world.summary();
    assert!(summary.overlaps == 0 && summary.least_separation >= 0.9999, "{summary:?}");
    assert!(summary.guard_share > 0.05, "{summary:?}");
}

/// Agents keep moving: no solid holds an agent for good.
#[test]
fn agents_led_along_solids_keep_moving() {
    let cage = columns();
    let mut world = filled(jolted(cage.barriers(), 0.5, false), jolting(2.0), &free(&cage, 100, 0.05), 0.05, 3);
    for row in 0..100 {
        assert_eq!(world.relative_columns().walked[row], 0.0);
    }
    let mut still = vec![0u32; 100];
    for _ in 0..1200 {
        let before: Vec<Vec3> = (0..100).map(|row| place(&world, row)).collect();
        world.step();
        (0..100).filter(|&row| place(&world, row) == before[row]).for_each(|row| still[row] += 1);
    }
    let most = still.into_iter().max().unwrap();
    assert!(most < 60, "an agent stood {most} of 1200 steps");
}

/// Birds of a flock, which use the SIMD path.
fn flock(cage: &Cage, lanes: SimdLevel) -> World {
    let vehicle = Vehicle { max_speed: 5.0, max_force: 20.0, locomotion: Locomotion::Level, ..Vehicle::default() };
    let flocking = Flocking::default();
    let group = Group {
        solid: cage.barriers(),
        neighbours: Group::ALL_NEIGHBOURS,
        neighbour_distance: 1.5,
        ..Group::steered(flocking)
    };
    let mut world = filled(group, vehicle, &free(cage, 300, 0.05), 0.05, 5);
    world.set_simd_level(lanes);
    for id in world.agent_ids() {
        let row = world.row(id).unwrap();
        world.set_velocity(id, Vec3::new(1.0, 0.5 - row as f32 * 0.004, 0.2)).unwrap();
    }
    world
}

#[test]
fn flocks_on_the_simd_and_the_scalar_path_are_led_alike() {
    let cage = columns();
    let [many, each] = [SimdLevel::Best, SimdLevel::Plain].map(|lanes| run(flock(&cage, lanes), &cage, 20.0));
    assert_eq!(many.state_hash(), each.state_hash());
    assert!(many.save() == each.save());
}

#[test]
fn any_number_of_threads_leads_to_the_same_bits() {
    let cage = columns();
    let worlds = || {
        [false, true].map(|guard| {
            let group = jolted(cage.barriers(), 0.4, guard);
            filled(group, jolting(4.0), &free(&cage, 300, 0.1), 0.05, 9)
        })
    };
    let hashes = |threads| {
        with_threads(threads, || {
            let [mut free, mut guarded] = worlds();
            let mut flock = flock(&cage, SimdLevel::Best);
            for _ in 0..100 {
                free.step();
                guarded.step();
                flock.step();
            }
            [free, guarded, flock].map(|world| (world.state_hash(), world.save()))
        })
    };
    let one = hashes(1);
    assert!(one == hashes(2) && one == hashes(3));
}

#[test]
fn what_is_saved_goes_on_with_the_same_bits() {
    let cage = columns();
    let make = || filled(jolted(cage.barriers(), 0.4, true), jolting(4.0), &free(&cage, 120, 0.1), 0.05, 2);
    let mut world = make();
    (0..50).for_each(|_| world.step());
    let mut other = make();
    other.load(&world.save()).unwrap();
    for _ in 0..50 {
        world.step();
        other.step();
    }
    assert_eq!(world.state_hash(), other.state_hash());
}

#[test]
fn agents_that_start_inside_are_led_out_smoothly_and_counted() {
    for guard in [false, true] {
        let cage = Cage { shapes: vec![Shape::Ball(Vec3::Z * 5.0, 1.0)], as_one: false, inside: None };
        let mut world =
            filled(jolted(cage.barriers(), 0.4, guard), jolting(1.0), &[(Vec3::new(0.1, 0.2, 5.3), 0.1)], 0.05, 2);
        let mut depth = f64::INFINITY;
        let mut steps = 0;
        while cage.rooms(place(&world, 0).as_dvec3())[0] < 0.1 {
            let before = place(&world, 0);
            world.step();
            assert!(place(&world, 0).distance(before) <= 0.05 * 1.001, "no shove");
            let now = -cage.rooms(place(&world, 0).as_dvec3())[0];
            assert!(now <= depth + 1e-6, "{now} after {depth}");
            depth = now;
            steps += 1;
            assert!(steps < 400, "still inside");
        }
        assert!(steps > 10);
        let summary = world.summary();
        assert!(summary.overlaps >= steps - 1 && summary.least_wall_separation < 0.0, "{summary:?}");
    }
}

#[test]
fn walkers_go_round_what_is_solid_to_their_group_only() {
    for lanes in [SimdLevel::Best, SimdLevel::Plain] {
        for guard in [false, true] {
            let cage = Cage { shapes: vec![Shape::Ball(Vec3::new(3.0, 0.05, 0.4), 0.8)], as_one: false, inside: None };
            let settings = Settings { step: 0.05, ..Settings::default() };
            let mut world = World::new(settings).unwrap();
            world.set_simd_level(lanes);
            let group = Group { solid: cage.barriers(), guard, look_ahead: false, keep_right: 0.0, ..Group::default() };
            let group = world.add_group(group).unwrap();
            let to = glam::DVec2::new(6.0, 0.0);
            let journey = crate::world::common::journey_to(&mut world, to);
            for group in [group, throng::GroupId::DEFAULT] {
                let position = glam::DVec2::new(0.0, if group == throng::GroupId::DEFAULT { 10.0 } else { 0.0 });
                world.add_agent(Agent { position: position.extend(0.0), journey, group, ..Agent::default() }).unwrap();
            }
            let mut least = f64::INFINITY;
            for _ in 0..300 {
                world.step();
                assert_eq!(world.relative_columns().altitude[0], 0.0);
                least = least.min(cage.rooms(place(&world, 0).as_dvec3())[0]);
            }
            let radius = f64::from(world.relative_columns().radius[0]);
            assert!((0.999_99..1.05).contains(&(least / radius)), "{least}");
            assert_eq!(world.summary().arrived, 2, "{lanes:?} {guard}: it slides along");
        }
    }
}
