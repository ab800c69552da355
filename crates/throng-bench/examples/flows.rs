//! Dense flows: a corridor with two streams, and doors.
#![allow(clippy::print_stdout)]
use glam::DVec2;
use throng::{Agent, Goal, Journey, Obstacle, Settings, Stop, World};

fn rect(x0: f64, y0: f64, x1: f64, y1: f64) -> Vec<DVec2> {
    vec![DVec2::new(x0, y0), DVec2::new(x1, y0), DVec2::new(x1, y1), DVec2::new(x0, y1)]
}

fn report(name: &str, mut world: World, limit: f64) {
    let start = std::time::Instant::now();
    let n = world.counts().agents;
    let mut quarter = vec![];
    while !world.finished() && world.time() < limit {
        world.step();
        let arrived = world.counts().arrived;
        for q in quarter.len() + 1..=4 {
            if arrived >= n * q / 4 {
                quarter.push(world.time());
            }
        }
    }
    let last = start.elapsed().as_secs_f64();
    let s = world.summary();
    println!(
        "{name}: {} of {} in {:.1} s (quarters {:.0?}), separation {:.6}, walls {:.6}, overlaps {}, guard {:.2} %, turning {:.1}, time ratio {:.2}, path ratio {:.2}, stuck {}, cpu {:.1} s, {:.0} ns/agent-step, substeps/step {:.1}, stranded {}",
        s.arrived,
        s.agents,
        s.time,
        quarter,
        s.least_separation,
        s.least_wall_separation,
        s.overlaps,
        s.guard_share * 100.0,
        s.heading_change_deg_per_s,
        s.time_ratio,
        s.path_ratio,
        s.stuck,
        last,
        last * 1e9 / s.agent_steps as f64,
        s.sub_steps as f64 / s.steps as f64,
        world.stranded().len(),
    );
    for row in 0..world.relative_columns().len().min(3) {
        println!(
            "   left: {:?} v {:?} {:?}",
            world.relative_columns().position[row],
            world.relative_columns().velocity[row],
            world.relative_columns().status[row]
        );
    }
}

fn corridor(seed: u64) -> Result<World, throng::Error> {
    let mut world = World::new(Settings { step: 0.04, seed, ..Settings::default() })?;
    for y in [-3.0, 3.0] {
        world.add_obstacle(Obstacle::Wall { points: vec![DVec2::new(-40.0, y), DVec2::new(40.0, y)] })?;
    }
    for side in [-1.0, 1.0] {
        let goal = world.add_goal(Goal::Exit { corners: rect(-side * 30.0 - 2.0, -3.0, -side * 30.0 + 2.0, 3.0) })?;
        let journey = world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false })?;
        for i in 0..200 {
            let (col, row) = (i / 8, i % 8);
            let wobble = |k: usize| ((i * 7919 + k * 104729 + seed as usize * 31) % 1000) as f64 / 1000.0 - 0.5;
            let position = DVec2::new(
                side * (5.0 + col as f64 * 0.68 + 0.2 * wobble(1)),
                -2.6 + row as f64 * 0.74 + 0.2 * wobble(2),
            );
            world.add_agent(Agent { position: position.extend(0.0), journey, ..Agent::default() })?;
        }
    }
    Ok(world)
}

fn door(width: f64, seed: u64) -> Result<World, throng::Error> {
    let mut world = World::new(Settings { step: 0.04, seed, ..Settings::default() })?;
    let h = width / 2.0;
    for s in [-1.0, 1.0] {
        world.add_obstacle(Obstacle::Wall {
            points: vec![DVec2::new(0.0, s * h), DVec2::new(0.0, s * 5.0), DVec2::new(-12.0, s * 5.0)],
        })?;
    }
    world.add_obstacle(Obstacle::Wall { points: vec![DVec2::new(-12.0, 5.0), DVec2::new(-12.0, -5.0)] })?;
    let goal = world.add_goal(Goal::Exit { corners: rect(4.0, -2.0, 6.0, 2.0) })?;
    let journey = world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false })?;
    for i in 0..100 {
        let (col, row) = (i / 10, i % 10);
        let wobble = |k: usize| ((i * 7919 + k * 104729 + seed as usize * 31) % 1000) as f64 / 1000.0 - 0.5;
        let position =
            DVec2::new(-10.0 + col as f64 * 0.8 + 0.3 * wobble(1), -4.0 + row as f64 * 0.8 + 0.3 * wobble(2));
        world.add_agent(Agent { position: position.extend(0.0), journey, ..Agent::default() })?;
    }
    Ok(world)
}

fn point(n: usize) -> Result<World, throng::Error> {
    let mut world = World::new(Settings { step: 0.04, ..Settings::default() })?;
    let goal = world.add_goal(Goal::Point { at: DVec2::ZERO, tolerance: 0.1 })?;
    let journey = world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false })?;
    for i in 0..n {
        let a = i as f64 * 2.4;
        let r = 3.0 + (i as f64).sqrt() * 0.6;
        world.add_agent(Agent {
            position: (DVec2::new(a.cos(), a.sin()) * r).extend(0.0),
            journey,
            ..Agent::default()
        })?;
    }
    Ok(world)
}

fn main() -> Result<(), throng::Error> {
    for seed in 1..=2 {
        report("corridor", corridor(seed)?, 240.0);
        for width in [1.0, 0.8, 0.6] {
            report(&format!("door {width}"), door(width, seed)?, 240.0);
        }
    }
    report("point", point(200)?, 60.0);
    Ok(())
}
