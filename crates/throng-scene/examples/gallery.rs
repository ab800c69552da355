//! Runs scenes of the gallery (all, or the named ones) and prints their figures and the outcome of their `[expect]`.
#![allow(clippy::print_stdout)]
use throng_scene::{Expectations, gallery};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    for name in gallery::names() {
        if !wanted.is_empty() && !wanted.iter().any(|w| w == name) {
            continue;
        }
        let scene = gallery::scene(name)?;
        let (mut world, built) = scene.build()?;
        let mut watch = Expectations::new(&scene.expect, &world, &built);
        let start = std::time::Instant::now();
        while !scene.time.over(&world) {
            world.step();
            watch.step(&world);
        }
        let wall = start.elapsed().as_secs_f64();
        let s = world.summary();
        println!(
            "{name}: {}/{} in {:.2} s, sep {:.5} walls {:.5} overlaps {} guard {:.2}% turn {:.1} time x{:.2} path x{:.2} stuck {} | {:.2} s wall, {:.0} ns",
            s.arrived,
            s.agents,
            s.time,
            s.least_separation,
            s.least_wall_separation,
            s.overlaps,
            s.guard_share * 100.0,
            s.heading_change_deg_per_s,
            s.time_ratio,
            s.path_ratio,
            s.stuck,
            wall,
            wall * 1e9 / s.agent_steps as f64
        );
        for check in watch.verdict(&world).checks.iter().filter(|check| !check.passed) {
            println!("   {check}");
        }
        for (n, why) in world.stranded().iter().take(2) {
            println!("   stranded {n}: {why}");
        }
    }
    Ok(())
}
