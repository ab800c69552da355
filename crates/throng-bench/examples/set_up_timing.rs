//! Times what precedes the steps of a reference work: `set_up_timing WORK AGENTS [WARM_UP [STEPS]]`, seconds. The first
//! step builds the navigation mesh and plans all paths. With steps it also prints nanoseconds per agent-step.

#![allow(clippy::print_stdout)]

use std::time::Instant;
use throng_bench::{lap, work};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().ok_or("which work?")?;
    let agents = arguments.next().ok_or("how many agents?")?.parse()?;
    let [warm_up, steps] = [arguments.next(), arguments.next()].map(|text| text.map_or(Ok(0), |text| text.parse()));
    let clock = Instant::now();
    let mut world = work(&name).ok_or("no such work")?.world(agents, true)?;
    println!("{name}, {agents} agents, world: {:.2} s", clock.elapsed().as_secs_f64());
    let first = lap(&mut world, 1, || true);
    println!("first step: {:.2} s", first.wall.as_secs_f64());
    lap(&mut world, warm_up?, || true);
    let lap = lap(&mut world, steps?, || true);
    if lap.steps > 0 {
        let stages = lap.stages.map(|stage| lap.ns(stage).round());
        println!("{:.0} ns an agent-step, of it {stages:?}", lap.ns(lap.wall));
    }
    println!("{} agents at the end, {:?}", world.relative_columns().len(), world.counts());
    Ok(())
}
