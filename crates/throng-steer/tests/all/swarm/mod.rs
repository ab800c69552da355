//! Swarms of insects: the outputs of guides, the motion in worlds, and equal bits on all paths of the computation.

mod bits;
mod guides;
mod kept;
mod mistakes;
mod together;

use glam::{DVec2, Vec3};
use throng::motion::Vehicle;
use throng::{Agent, Group, GroupId, Settings, SubSteps, World};
use throng_steer::swarm::{Swarm, SwarmSpacing};

/// Seconds of a step.
pub const STEP: f64 = 1.0 / 60.0;

/// Returns a swarm without noise and separation: only guides act.
pub fn bare() -> Swarm {
    Swarm { noise: None, apart: SwarmSpacing { distance: 0.0, speed: 0.0 }, ..Swarm::default() }
}

/// Returns a world without agents.
pub fn empty() -> World {
    World::new(Settings { step: STEP, sub_steps: SubSteps::Fixed(1), ..Settings::default() }).unwrap()
}

/// Adds insects of a group.
pub fn add(world: &mut World, group: GroupId, vehicle: Vehicle, places: &[Vec3]) {
    for place in places {
        let agent = Agent {
            position: DVec2::new(place.x.into(), place.y.into()).extend(f64::from(place.z)),
            radius: 0.005,
            preferred_speed: vehicle.max_speed,
            motor: vehicle.into(),
            group,
            ..Agent::default()
        };
        world.add_agent(agent).unwrap();
    }
}

/// Returns a world of one group.
pub fn world(group: Group, vehicle: Vehicle, places: &[Vec3]) -> World {
    let mut world = empty();
    let group = world.add_group(group).unwrap();
    add(&mut world, group, vehicle, places);
    world
}

/// Runs the world for some seconds.
pub fn run(world: &mut World, seconds: f64) {
    let end = world.time() + seconds - 1e-6;
    while world.time() < end {
        world.step();
    }
}

/// Returns the positions by number.
pub fn places(world: &World) -> Vec<Vec3> {
    by_number(world, |row| world.relative_columns().position[row].extend(world.relative_columns().altitude[row]))
}

/// Returns the velocities by number.
pub fn velocities(world: &World) -> Vec<Vec3> {
    by_number(world, |row| {
        world.relative_columns().velocity[row].extend(world.relative_columns().vertical_velocity[row])
    })
}

fn by_number(world: &World, of: impl Fn(usize) -> Vec3) -> Vec<Vec3> {
    let mut all: Vec<(u32, Vec3)> =
        world.relative_columns().number.iter().enumerate().map(|(row, &n)| (n, of(row))).collect();
    all.sort_by_key(|one| one.0);
    all.into_iter().map(|one| one.1).collect()
}

/// Returns random places in a ball, from an independent generator.
pub fn scattered(count: usize, middle: Vec3, radius: f32) -> Vec<Vec3> {
    let mut state = 11_u64;
    let mut draw = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        2.0 * ((state >> 40) as f32 / (1 << 24) as f32) - 1.0
    };
    let point = std::iter::repeat_with(|| Vec3::new(draw(), draw(), draw())).filter(|p| p.length_squared() < 1.0);
    point.take(count).map(|p| middle + p * radius).collect()
}
