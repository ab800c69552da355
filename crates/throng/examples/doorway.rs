//! Forty agents leave a room through a door: `cargo run -p throng --example doorway`.
//!
//! The agents plan their routes around the walls, queue at the door, and leave the world at an exit behind it.
#![allow(clippy::print_stdout)]

use glam::DVec2;
use throng::{Agent, EventKind, Goal, Obstacle, Settings, World};

/// Width of the door, metres.
const DOOR: f64 = 1.0;

fn main() -> Result<(), throng::Error> {
    let mut world = World::new(Settings { step: 0.05, ..Settings::default() })?;
    let wall = |points: &[[f64; 2]]| Obstacle::Wall { points: points.iter().copied().map(DVec2::from).collect() };
    world.add_obstacle(wall(&[
        [8.0, DOOR / 2.0],
        [8.0, 4.0],
        [0.0, 4.0],
        [0.0, -4.0],
        [8.0, -4.0],
        [8.0, -DOOR / 2.0],
    ]))?;
    let exit = [[9.0, -1.0], [11.0, -1.0], [11.0, 1.0], [9.0, 1.0]].map(DVec2::from);
    let exit = Goal::Exit { corners: exit.to_vec() };
    for k in 0..40 {
        let place = [1.0 + 0.7 * f64::from(k % 8), -2.0 + f64::from(k / 8)];
        world.add_agent(Agent::at(place).radius(0.2).goal(exit.clone()))?;
    }
    let mut left = 0;
    while !world.finished() && world.time() < 120.0 {
        world.step();
        let leaving = world.events().iter().filter(|event| event.kind == EventKind::Left).count();
        if (left + leaving) / 10 > left / 10 {
            println!("{:5.1} s: {} agents have left", world.time(), left + leaving);
        }
        left += leaving;
    }
    println!("{:.2} agents per second and metre of door", f64::from(left as u32) / world.time() / DOOR);
    Ok(())
}
