//! Rings of agents that all go to the opposite side, for many sizes, time steps and time horizons: prints a Markdown
//! table. `cargo run --release -p throng-bench --example rings [-- --large] [--fixed]`
#![allow(clippy::print_stdout)]

use glam::DVec2;
use std::sync::Arc;
use throng::avoid::Orca;
use throng::motion::Holonomic;
use throng::{Agent, Goal, Group, Journey, Settings, Stop, SubSteps, Summary, World};

fn ring(count: usize, radius: f64, step: f64, sub_steps: SubSteps, horizon: f32) -> Result<Summary, throng::Error> {
    let mut world = World::new(Settings { step, sub_steps, ..Settings::default() })?;
    let model = Arc::new(Orca { time_horizon: horizon, ..Orca::default() });
    let group = world.add_group(Group { name: "walkers".into(), model, ..Group::default() })?;
    for i in 0..count {
        let angle = std::f64::consts::TAU * i as f64 / count as f64;
        let position = DVec2::new(angle.cos(), angle.sin()) * radius;
        let goal = world.add_goal(Goal::Point { at: -position, tolerance: 0.1 })?;
        let journey = world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false })?;
        let agent = Agent {
            position: position.extend(0.0),
            group,
            journey,
            preferred_speed: 1.5,
            radius: 0.2,
            motor: Holonomic { max_speed: 1.5, ..Holonomic::default() }.into(),
            ..Agent::default()
        };
        world.add_agent(agent)?;
    }
    let limit = 120.0 + 20.0 * radius;
    while !world.finished() && world.time() < limit {
        world.step();
    }
    Ok(world.summary())
}

fn main() -> Result<(), throng::Error> {
    let has = |flag: &str| std::env::args().any(|arg| arg == flag);
    let sub_steps = if has("--fixed") { SubSteps::Fixed(1) } else { SubSteps::Auto };
    let sizes: Vec<(usize, f64)> = if has("--large") {
        vec![(250, 26.0), (1000, 104.0)]
    } else {
        [2, 3, 4, 6, 8, 12, 16, 24, 36, 60].map(|n| (n, 7.0)).to_vec()
    };
    println!("| people | step | horizon | arrived | seconds | least separation | guard | turning deg/s | stuck |");
    println!("|---|---|---|---|---|---|---|---|---|");
    for (count, radius) in sizes {
        for step in [1.0 / 60.0, 1.0 / 25.0, 0.1, 0.25] {
            for horizon in [1.0, 2.0, 5.0] {
                let s = ring(count, radius, step, sub_steps, horizon)?;
                println!(
                    "| {count} | {step:.4} | {horizon} | {} | {:.1} | {:.6} | {:.2} % | {:.1} | {} |",
                    s.arrived,
                    s.time,
                    s.least_separation,
                    s.guard_share * 100.0,
                    s.heading_change_deg_per_s,
                    s.stuck,
                );
            }
        }
    }
    Ok(())
}
