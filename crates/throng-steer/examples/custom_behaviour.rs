//! A steering behaviour of your own: `cargo run -p throng-steer --example custom_behaviour`.
//!
//! A [`Behaviour`] returns a steering force for a vehicle. It can be combined with the behaviours of the library.
#![allow(clippy::print_stdout)]

use glam::Vec3;
use throng::agent::Guidance;
use throng::motion::Steering;
use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};
use throng::{Agent, Group, Settings, World};
use throng_steer::{Priority, Wander};

/// Circles around a place, counter-clockwise, at a distance.
#[derive(Debug)]
struct Circle {
    around: Target,
    /// Metres.
    distance: f32,
}

impl Behaviour for Circle {
    fn steer(&self, input: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        let outwards = input.position() - self.around.find(input)?.position;
        let correction = self.distance - outwards.length();
        input.turn(Vec3::Z.cross(outwards).normalize_or_zero() + outwards.normalize_or_zero() * correction)
    }
}

fn main() -> Result<(), throng::Error> {
    let mut world = World::new(Settings { step: 0.05, ..Settings::default() })?;
    let circle = Circle { around: Target::Point(Vec3::ZERO), distance: 4.0 };
    let behaviour = Priority { epsilon: 0.0, parts: vec![circle.into(), Wander::default().into()] };
    let group = world.add_group(Group { guidance: Guidance::behaviour(behaviour), ..Group::default() })?;
    let id = world.add_agent(Agent::at([8.0, 0.0]).group(group))?;
    for _ in 0..1200 {
        world.step();
    }
    let agent = world.agent(id).expect("no agent was removed");
    println!(
        "distance from the middle: {:.2} m, speed {:.2} m/s",
        agent.position().length(),
        agent.velocity().length()
    );
    Ok(())
}
