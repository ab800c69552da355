//! Two agents exchange places: `cargo run -p throng --example hello`.
#![allow(clippy::print_stdout)]

use throng::{Agent, Settings, World};

fn main() -> Result<(), throng::Error> {
    let mut world = World::new(Settings::default())?;
    world.add_agent(Agent::at([-4.0, 0.0]).goal([4.0, 0.0]))?;
    world.add_agent(Agent::at([4.0, 0.0]).goal([-4.0, 0.0]))?;
    while !world.finished() {
        world.step();
    }
    for agent in world.agents() {
        println!("agent {} is at {:.2}", agent.number(), agent.position());
    }
    println!("arrived after {:.1} s; least distance {:.2} of touching", world.time(), world.summary().least_separation);
    Ok(())
}
