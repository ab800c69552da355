//! A local model of your own: `cargo run -p throng --example custom_model`.
//!
//! A [`LocalModel`] turns the preferred velocity of an agent into a chosen velocity. The guard then makes the motion
//! certain, so that even a careless model gives no overlap.
#![allow(clippy::print_stdout)]

use glam::Vec2;
use std::sync::Arc;
use throng::avoid::{AvoidanceInput, LocalModel, Workspace};
use throng::{Agent, Group, Settings, World};

/// Slows down and turns right in front of neighbours that come closer than a distance.
#[derive(Debug)]
struct TurnRight {
    /// Metres from rim to rim.
    distance: f32,
}

impl LocalModel for TurnRight {
    fn velocity(&self, input: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        let ahead = input.preferred.normalize_or_zero();
        let gap = input
            .neighbours
            .iter()
            .filter(|neighbour| neighbour.offset.dot(ahead) > 0.0)
            .map(|neighbour| neighbour.offset.length() - neighbour.radii)
            .fold(f32::INFINITY, f32::min);
        let nearness = (1.0 - gap / self.distance).clamp(0.0, 1.0);
        Vec2::from_angle(-1.2 * nearness).rotate(input.preferred) * (1.0 - 0.5 * nearness)
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius + self.distance
    }
}

fn main() -> Result<(), throng::Error> {
    let mut world = World::new(Settings { step: 0.05, ..Settings::default() })?;
    let group = world.add_group(Group { model: Arc::new(TurnRight { distance: 1.5 }), ..Group::default() })?;
    for k in 0..12 {
        let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 12.0).sin_cos();
        world.add_agent(Agent::at([5.0 * cos, 5.0 * sin]).goal([-5.0 * cos, -5.0 * sin]).radius(0.2).group(group))?;
    }
    while !world.finished() && world.time() < 60.0 {
        world.step();
    }
    let summary = world.summary();
    println!("{} of {} agents arrived after {:.1} s", summary.arrived, summary.agents, world.time());
    println!("least distance {:.4} of touching", summary.least_separation);
    Ok(())
}
