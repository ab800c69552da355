//! A long run of scenes: memory stays constant, and a world that is saved, dropped and loaded by another process
//! continues with the same bits.
//!
//! `cargo run --release -p throng-scene --example soak -- [MINUTES [MOMENTS [SCENE...]]]`: each scene of the gallery,
//! or each that is named (of the gallery, or a file), runs for MINUTES simulated minutes (default: 60). A scene that is
//! over starts again. At MOMENTS random moments (default: 100) its state is written to a file, and another process
//! continues from it. The exit status is 1 if a state differs or memory grows.
//! memory grows.
#![allow(clippy::print_stdout)]

use stats_alloc::{INSTRUMENTED_SYSTEM, StatsAlloc};
use std::alloc::System;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;
use throng::World;
use throng_scene::{Purpose, Random, Scene, gallery};

#[global_allocator]
static MEMORY: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// The number of steps that the other process makes from a saved state.
const STEPS: usize = 40;
/// The first word of the command line of the other process.
const CONTINUE: &str = "--continue";
/// Memory is constant if the second half of a run needs at most this many times what the first half needs.
const GROWTH: f64 = 1.1;

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if let [first, name, state] = &words[..]
        && first == CONTINUE
    {
        println!("{:016x}", go_on(name, Path::new(state))?);
        return Ok(ExitCode::SUCCESS);
    }
    let minutes: f64 = words.first().map_or(Ok(60.0), |word| word.parse())?;
    let moments: u32 = words.get(1).map_or(Ok(100), |word| word.parse())?;
    let names: Vec<&str> = match words.get(2..) {
        Some(names @ [_, ..]) => names.iter().map(String::as_str).collect(),
        _ => gallery::names().collect(),
    };
    println!("| scene | agents | runs | steps | kB in the first half | in the second | continued | wall s |");
    println!("|---|--:|--:|--:|--:|--:|--:|--:|");
    let mut good = true;
    for name in names {
        let begin = Instant::now();
        let soaked = soak(name, minutes * 60.0, moments)?;
        let [first, second] = soaked.most.map(|bytes| bytes as f64 / 1024.0);
        let flat = second <= first * GROWTH;
        let remark = if flat && soaked.different.is_empty() { "" } else { " **BAD**" };
        println!(
            "| {name} | {} | {} | {} | {first:.0} | {second:.0} | {} | {:.0} |{remark}",
            soaked.agents,
            soaked.runs,
            soaked.steps,
            soaked.continued,
            begin.elapsed().as_secs_f64()
        );
        soaked.different.iter().for_each(|state| println!("  other bits after {}", state.display()));
        good &= flat && soaked.different.is_empty();
    }
    Ok(if good { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The measures of a long run of a scene.
#[derive(Default)]
struct Soaked {
    agents: usize,
    runs: u32,
    steps: u64,
    /// The greatest number of bytes in use at the end of a step, in either half of the run.
    most: [usize; 2],
    /// How many times another process continued with the same bits.
    continued: u32,
    /// Saved states from which it did not.
    different: Vec<PathBuf>,
}

/// A scene of the gallery, or of a file.
fn scene(name: &str) -> Result<Scene, throng_scene::Error> {
    if Path::new(name).exists() { Scene::load(name) } else { gallery::scene(name) }
}

/// Runs a scene for a number of seconds.
fn soak(name: &str, seconds: f64, moments: u32) -> Result<Soaked, Box<dyn Error>> {
    let scene = scene(name)?;
    let steps = (seconds / scene.time.step).ceil() as u64;
    let mut random = Random::new(1, 0, 0, Purpose::Choice);
    let mut chosen: Vec<u64> = (0..moments).map(|_| random.bits() % steps.max(1)).collect();
    chosen.sort_unstable();
    let mut chosen = chosen.into_iter().peekable();
    let before = in_use();
    let mut soaked = Soaked::default();
    while soaked.steps < steps {
        let (mut world, _) = scene.build()?;
        soaked.runs += 1;
        while soaked.steps < steps && !scene.time.over(&world) {
            while chosen.next_if(|&step| step == soaked.steps).is_some() {
                same(name, &scene, &world, &mut soaked)?;
            }
            world.step();
            soaked.agents = soaked.agents.max(world.relative_columns().len());
            let half = usize::from(soaked.steps >= steps / 2);
            soaked.most[half] = soaked.most[half].max(in_use() - before);
            soaked.steps += 1;
        }
    }
    Ok(soaked)
}

/// Continues from the world's saved state in another process, and compares the results.
fn same(name: &str, scene: &Scene, world: &World, soaked: &mut Soaked) -> Result<(), Box<dyn Error>> {
    let title = Path::new(name).file_stem().unwrap_or_default().display();
    let file = format!("throng-soak-{}-{title}-{}.state", std::process::id(), soaked.steps);
    let path = std::env::temp_dir().join(file);
    std::fs::write(&path, world.save())?;
    let output = Command::new(std::env::current_exe()?).arg(CONTINUE).arg(name).arg(&path).output()?;
    let mut own = world.clone();
    run(scene, &mut own);
    if String::from_utf8_lossy(&output.stdout).trim() == format!("{:016x}", own.state_hash()) {
        std::fs::remove_file(&path)?;
        soaked.continued += 1;
    } else {
        soaked.different.push(path);
    }
    Ok(())
}

/// Returns the result of the other process from a saved state.
fn go_on(name: &str, state: &Path) -> Result<u64, Box<dyn Error>> {
    let scene = scene(name)?;
    let (mut world, _) = scene.build()?;
    world.load(&std::fs::read(state)?)?;
    run(&scene, &mut world);
    Ok(world.state_hash())
}

fn run(scene: &Scene, world: &mut World) {
    for _ in 0..STEPS {
        if !scene.time.over(world) {
            world.step();
        }
    }
}

/// Returns the number of bytes that are allocated now.
fn in_use() -> usize {
    let stats = MEMORY.stats();
    stats.bytes_allocated.wrapping_sub(stats.bytes_deallocated)
}
