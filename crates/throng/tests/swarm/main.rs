//! Swarms of insects: what guides ask for, what becomes of it in a world, and that it is the same bits however it is computed.

mod bits;
mod guides;
mod mistakes;
mod together;

use glam::{DVec2, Vec3};
use throng::motion::Vehicle;
use throng::steer::swarm::{Apart, Swarm};
use throng::{Agent, Group, GroupId, Settings, SubSteps, World};

/// Seconds of a step.
pub const STEP: f64 = 1.0 / 60.0;

/// Without noise and separation: only what guides ask for.
pub fn bare() -> Swarm {
    Swarm { noise: None, apart: Apart { distance: 0.0, speed: 0.0 }, ..Swarm::default() }
}

/// A world without anybody.
pub fn empty() -> World {
    World::new(Settings { step: STEP, sub_steps: SubSteps::Fixed(1), ..Settings::default() }).unwrap()
}

/// Adds insects of a group.
pub fn add(world: &mut World, group: GroupId, vehicle: &Vehicle, places: &[Vec3]) {
    for place in places {
        let agent = Agent {
            position: DVec2::new(place.x.into(), place.y.into()),
            altitude: place.z,
            radius: 0.005,
            preferred_speed: vehicle.max_speed,
            max_speed: vehicle.max_speed,
            max_acceleration: f32::INFINITY,
            group,
            ..Agent::default()
        };
        world.add_agent(agent).unwrap();
    }
}

/// A world of one group.
pub fn world(group: Group, places: &[Vec3]) -> World {
    let mut world = empty();
    let vehicle = group.vehicle;
    let group = world.add_group(group).unwrap();
    add(&mut world, group, &vehicle, places);
    world
}

/// Moves it on by so many seconds.
pub fn run(world: &mut World, seconds: f64) {
    let end = world.time() + seconds - 1e-6;
    while world.time() < end {
        world.step();
    }
}

/// Where they are, by number.
pub fn places(world: &World) -> Vec<Vec3> {
    by_number(world, |row| world.agents().position[row].extend(world.agents().altitude[row]))
}

/// How fast, by number.
pub fn velocities(world: &World) -> Vec<Vec3> {
    by_number(world, |row| world.agents().velocity[row].extend(world.agents().climb[row]))
}

fn by_number(world: &World, of: impl Fn(usize) -> Vec3) -> Vec<Vec3> {
    let mut all: Vec<(u32, Vec3)> = world.agents().number.iter().enumerate().map(|(row, &n)| (n, of(row))).collect();
    all.sort_by_key(|one| one.0);
    all.into_iter().map(|one| one.1).collect()
}

/// Places at random in a ball, by a generator of its own.
pub fn scattered(count: usize, middle: Vec3, radius: f32) -> Vec<Vec3> {
    let mut state = 11_u64;
    let mut draw = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        2.0 * ((state >> 40) as f32 / (1 << 24) as f32) - 1.0
    };
    let point = std::iter::repeat_with(|| Vec3::new(draw(), draw(), draw())).filter(|p| p.length_squared() < 1.0);
    point.take(count).map(|p| middle + p * radius).collect()
}
