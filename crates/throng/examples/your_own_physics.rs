//! Another physics engine moves the bodies: `cargo run -p throng --example your_own_physics`.
//!
//! The world proposes a safe velocity for each agent. The program moves its own bodies, here with some inertia, and
//! tells the world where they are. A player's character takes its velocity from the program: the engine keeps it safe.
#![allow(clippy::print_stdout)]

use glam::{DVec3, Vec3};
use throng::{Agent, AgentId, Settings, World};

/// A body of the other physics engine.
struct Body {
    agent: AgentId,
    position: DVec3,
    velocity: Vec3,
}

fn main() -> Result<(), throng::Error> {
    let mut world = World::new(Settings { step: 0.05, ..Settings::default() })?;
    let mut bodies = Vec::new();
    for k in 0..10 {
        let position = DVec3::new(-4.0, f64::from(k) - 4.5, 0.0);
        let agent =
            world.add_agent(Agent::at(position).goal([4.0, 4.5 - f64::from(k)]).radius(0.2).user_data(k as u64))?;
        bodies.push(Body { agent, position, velocity: Vec3::ZERO });
    }
    let player = world.add_agent(Agent::at([4.0, 0.0]).radius(0.2).user_data(u64::MAX))?;
    while world.time() < 12.0 {
        world.set_preferred_velocity(player, Vec3::NEG_X * if world.time() < 5.0 { 1.5 } else { 0.0 })?;
        world.step();
        for body in &mut bodies {
            let proposed = world.agent(body.agent).expect("no agent was removed").velocity();
            body.velocity += (proposed - body.velocity) * 0.5;
            body.position += body.velocity.as_dvec3() * world.settings().step;
            world.set_position(body.agent, body.position)?;
        }
    }
    for agent in world.agents() {
        let name = if agent.user_data() == u64::MAX { "player" } else { "body" };
        println!("{name} at {:.2}", agent.position());
    }
    Ok(())
}
