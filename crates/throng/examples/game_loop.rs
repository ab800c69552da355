//! A game loop in the terminal: `cargo run -p throng --example game_loop [SECONDS]`.
//!
//! Frames have any length. Each frame makes as many steps as the time that has passed holds, and draws the agents between
//! their last two positions. So the run has the same bits at every frame rate.
#![allow(clippy::print_stdout)]

use glam::DVec3;
use std::time::{Duration, Instant};
use throng::{Agent, EventKind, Settings, World};

const COLUMNS: usize = 64;
const ROWS: usize = 20;

fn main() -> Result<(), throng::Error> {
    let seconds = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(10.0);
    let mut world = World::new(Settings { step: 1.0 / 30.0, ..Settings::default() })?;
    for k in 0..24 {
        let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 24.0).sin_cos();
        world.add_agent(
            Agent::at([8.0 * cos, 8.0 * sin]).goal([-8.0 * cos, -8.0 * sin]).radius(0.25).user_data(k as u64),
        )?;
    }
    let (mut before, mut now) = (Vec::new(), Vec::new());
    world.positions_into(&mut now);
    let (start, mut rest) = (Instant::now(), 0.0);
    let mut last = start;
    while start.elapsed().as_secs_f64() < seconds {
        std::thread::sleep(Duration::from_millis(40));
        rest += last.elapsed().as_secs_f64().min(0.25);
        last = Instant::now();
        while rest >= world.settings().step {
            rest -= world.settings().step;
            std::mem::swap(&mut before, &mut now);
            world.step();
            world.positions_into(&mut now);
            // agents that have arrived turn back
            let arrived = world.events().iter().filter(|event| event.kind == EventKind::Arrived);
            for id in arrived.map(|event| event.agent).collect::<Vec<_>>() {
                let at = world.position(id).unwrap_or_default();
                world.set_goal(id, [-at.x, -at.y])?;
            }
        }
        draw(&before, &now, rest / world.settings().step);
    }
    Ok(())
}

/// Draws the agents at a fraction of the way between two steps.
fn draw(before: &[DVec3], now: &[DVec3], fraction: f64) {
    let mut picture = vec![[b' '; COLUMNS]; ROWS];
    for (number, (from, to)) in before.iter().zip(now).enumerate() {
        let at = from.lerp(*to, fraction);
        let column = (at.x / 20.0 + 0.5) * COLUMNS as f64;
        let row = (0.5 - at.y / 20.0) * ROWS as f64;
        picture[(row as usize).min(ROWS - 1)][(column as usize).min(COLUMNS - 1)] = b'a' + number as u8 % 26;
    }
    let lines = picture.iter().map(|line| String::from_utf8_lossy(line).into_owned());
    println!("\x1b[H\x1b[2J{}", lines.collect::<Vec<_>>().join("\n"));
}
