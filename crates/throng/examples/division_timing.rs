//! Times one crowd in several worlds: `cargo run --release -p throng --example division_timing -- WORLDS AGENTS STEPS
//! [DENSITY]`. Each world is in a thread of its own. With 0 worlds the crowd is not divided.
//!
//! Prints processor time of the counted steps, on Linux, and what is sent. For instructions run it with `valgrind
//! --tool=callgrind --toggle-collect='*counted_steps*'`, and divide the collected events by the agent-steps.
#![allow(clippy::print_stdout)]

#[path = "../tests/shared/draw.rs"]
#[allow(dead_code, reason = "tests use more")]
mod draw;
#[path = "../tests/divided/threads.rs"]
#[allow(dead_code, reason = "tests use more")]
mod threads;

use draw::Draw;
use glam::{DVec2, Vec2};
use std::thread;
use threads::{Threads, halos};
use throng::halo::{Cuts, DividedWorld, Load};
use throng::{Agent, Goal, Group, Journey, Settings, Stop, SubSteps, World};

/// Steps before the counted ones.
const WARM_UP: u32 = 4;
/// Number of far goals that the agents share.
const GOALS: usize = 64;

/// Returns a crowd of the default group, and the side of the square on which it is.
fn crowd(count: usize, density: f64) -> Result<(World, f64), Box<dyn std::error::Error>> {
    let settings = Settings { step: 0.1, sub_steps: SubSteps::Fixed(1), ..Settings::default() };
    let mut world = World::new(settings)?;
    let group = world.add_group(Group::default())?;
    let side = (count as f64 / density).sqrt();
    let mut journeys = Vec::new();
    for k in 0..GOALS {
        let angle = std::f64::consts::TAU * k as f64 / GOALS as f64;
        let at = DVec2::splat(0.5 * side) + DVec2::from_angle(angle) * 2.0 * side;
        let goal = world.add_goal(Goal::Point { at, tolerance: 0.2 })?;
        journeys.push(world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false })?);
    }
    let mut draw = Draw::new(1);
    let across = (count as f64).sqrt().ceil() as usize;
    let spacing = side / across as f64;
    // how far an agent may be from the middle of its square, so that bodies do not touch
    let free = DVec2::splat((0.5 * spacing - 0.15).max(0.0));
    for k in 0..count {
        let middle = DVec2::new((k % across) as f64 + 0.5, (k / across) as f64 + 0.5) * spacing;
        let at = middle + draw.point(-free, free);
        world.add_agent(Agent { journey: draw.one_of(&journeys), group, ..Agent::at(at) })?;
    }
    Ok((world, side))
}

/// Valgrind counts the instructions of this function, by name.
#[inline(never)]
fn counted_steps(steps: u32, mut step: impl FnMut()) {
    (0..steps).for_each(|_| step());
}

/// Returns the nanoseconds of processor time of this thread so far; 0 if the system does not tell.
fn thread_time() -> u64 {
    let times = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    times.split(' ').next().and_then(|time| time.parse().ok()).unwrap_or(0)
}

/// Returns the processor time of the counted steps, nanoseconds.
fn time(steps: u32, mut step: impl FnMut()) -> u64 {
    (0..WARM_UP).for_each(|_| step());
    let start = thread_time();
    counted_steps(steps, step);
    thread_time() - start
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [worlds, count, steps, density @ ..] = &arguments[..] else {
        return Err("usage: division_timing WORLDS AGENTS STEPS [DENSITY]".into());
    };
    let (worlds, count, steps): (usize, usize, u32) = (worlds.parse()?, count.parse()?, steps.parse()?);
    let density = density.first().map_or(Ok(0.25), |density| density.parse())?;
    let (mut whole, side) = crowd(count, density)?;
    let mut all = Vec::new();
    if worlds == 0 {
        all.push((time(steps, || whole.step()), 0));
    } else {
        let mut load = Load::within(Vec2::ZERO, Vec2::splat(side as f32));
        whole.relative_columns().position.iter().for_each(|&place| load.add(place, 1));
        let cuts = Cuts::balanced(worlds, &load);
        let run = |halo: Threads, world: World| {
            let mut part = DividedWorld::new(world, halo).expect("a crowd that can be divided");
            let (mut before, mut step) = (0, 0);
            let time = time(steps, || {
                part.step();
                step += 1;
                if step == WARM_UP {
                    before = part.halo().bytes;
                }
            });
            (time, part.halo().bytes - before)
        };
        thread::scope(|scope| {
            let threads: Vec<_> = halos(cuts)
                .into_iter()
                .map(|halo| {
                    let world = whole.clone();
                    scope.spawn(move || run(halo, world))
                })
                .collect();
            all.extend(threads.into_iter().map(|thread| thread.join().expect("a world that steps")));
        });
    }
    let agent_steps = count as f64 * f64::from(steps);
    let time: u64 = all.iter().map(|&(time, _)| time).sum();
    let bytes: usize = all.iter().map(|&(_, bytes)| bytes).sum();
    println!("worlds {worlds}, agents {count}, agent-steps {agent_steps}");
    println!("nanoseconds of processor time an agent-step: {:.1}", time as f64 / agent_steps);
    println!("bytes sent a step: {:.0}", bytes as f64 / f64::from(steps));
    Ok(())
}
