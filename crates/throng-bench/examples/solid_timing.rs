//! Times solids: `cargo run --release -p throng-bench --example solid_timing`.
#![allow(clippy::print_stdout)]

use glam::{DVec2, Vec3};
use std::sync::Arc;
use std::time::Instant;
use throng::motion::{Locomotion, Vehicle};
use throng::space::surface::{Capsule, SeenFrom, Sphere, Surface, Union};
use throng::steer::Barriers;
use throng::{Agent, Group, Settings, SubSteps, World};
use throng_steer::Wander;

const SIZE: f64 = 40.0;

/// Forty columns in a ball.
fn columns() -> Result<Barriers, throng::Error> {
    let mut members: Vec<Arc<dyn Surface>> = Vec::new();
    for k in 0..40 {
        let foot = Vec3::new((k % 8) as f32 - 3.5, (k / 8) as f32 - 2.0, 0.0) * 4.5;
        members.push(Arc::new(Capsule::new(foot, foot + Vec3::Z * SIZE as f32, 0.4)?));
    }
    let ball = Sphere::new(Vec3::Z * 20.0, 45.0)?;
    Ok(Barriers::default().with(Union::new(members)?, SeenFrom::Outside).with(ball, SeenFrom::Inside))
}

/// Returns microseconds per agent and step: the fastest of 60 steps, after some steps of warm-up.
fn time(solid: Barriers, count: u32) -> Result<f64, throng::Error> {
    let settings = Settings { step: 1.0 / 60.0, sub_steps: SubSteps::Fixed(1), ..Settings::default() };
    let mut world = World::new(settings)?;
    let vehicle = Vehicle { max_speed: 2.0, locomotion: Locomotion::Level, ..Vehicle::default() };
    let group = Group { solid, neighbours: 1, neighbour_distance: 0.1, ..Group::steered(Wander::default()) };
    let group = world.add_group(group)?;
    let side = f64::from(count).cbrt().ceil();
    for k in 0..count {
        let k = f64::from(k);
        let grid = [k % side, (k / side).floor() % side, (k / side / side).floor()].map(|i| i / side * SIZE);
        let position = DVec2::new(grid[0], grid[1]) - 0.5 * SIZE;
        let agent = Agent { position: position.extend(1.0 + grid[2]), group, radius: 0.01, ..Agent::default() };
        world.add_agent(agent.motor(vehicle))?;
    }
    (0..30).for_each(|_| world.step());
    let steps = (0..60).map(|_| {
        let start = Instant::now();
        world.step();
        start.elapsed().as_secs_f64()
    });
    Ok(steps.fold(f64::INFINITY, f64::min) * 1e6 / f64::from(count))
}

fn main() -> Result<(), throng::Error> {
    for count in [1000, 20_000, 100_000] {
        let (free, solid) = (time(Barriers::default(), count)?, time(columns()?, count)?);
        println!("{count:7} insects: {free:.3} us each and step, {solid:.3} us among columns in a ball");
    }
    Ok(())
}
