//! Measuring one world.

use super::args::BenchArgs;
use super::plan::Subject;
use crate::failure::Failure;
use crate::{MEMORY, interrupt, threads};
use std::time::Duration;
use throng::World;
use throng_bench::{Lap, lap, median};

/// What was measured of one world with one number of threads.
pub struct Run {
    /// The name of the work or scene.
    pub work: String,
    /// How many agents there were.
    pub agents: usize,
    /// Threads for the steps.
    pub threads: usize,
    /// Whether the guard was on: on, off, or some.
    pub guard: &'static str,
    /// Steps made before.
    pub warm_up: u32,
    /// Simulated seconds a step.
    pub step: f64,
    /// Bytes allocated for the world, an agent.
    pub bytes: f64,
    /// The repeats, at least one.
    pub laps: Vec<Lap>,
}

impl Run {
    /// Nanoseconds an agent-step of what `time` says of a lap: the median.
    pub fn ns(&self, time: impl Fn(&Lap) -> Duration) -> f64 {
        median(self.laps.iter().map(|lap| lap.ns(time(lap))).collect())
    }

    /// Nanoseconds of processor time an agent-step, the median; not a number where the system does not tell.
    pub fn cpu_ns(&self) -> f64 {
        median(self.laps.iter().filter_map(|lap| Some(lap.ns(lap.cpu?))).collect())
    }

    /// The least nanoseconds on the clock.
    pub fn least_ns(&self) -> f64 {
        self.laps.iter().map(|lap| lap.ns(lap.wall)).fold(f64::INFINITY, f64::min)
    }

    /// Processor seconds a simulated second, the median; not a number where the system does not tell.
    pub fn cpu_per_second(&self) -> f64 {
        let share = |lap: &Lap| Some(lap.cpu?.as_secs_f64() / (f64::from(lap.steps) * self.step));
        median(self.laps.iter().filter_map(share).collect())
    }
}

/// Measures a world with each number of threads; `lap_done` is told of each repeat. Whoever has no whole repeat when
/// interrupted is left out.
///
/// # Errors
/// The world cannot be built, or the threads cannot be started.
pub fn measure(
    subject: &Subject,
    args: &BenchArgs,
    counts: &[usize],
    mut lap_done: impl FnMut(),
) -> Result<Vec<Run>, Failure> {
    let before = in_use();
    let mut world = subject.build()?;
    let going = || !interrupt::asked();
    let most = counts.iter().copied().max().unwrap_or(1);
    threads::with(most, || Ok(lap(&mut world, args.warm_up, going)))?;
    let agents = world.agents().len();
    let bytes = in_use().saturating_sub(before) as f64 / agents.max(1) as f64;
    let steps = args.steps(agents);
    let mut runs: Vec<Run> = counts
        .iter()
        .map(|&threads| Run {
            work: subject.name().to_owned(),
            agents,
            threads,
            guard: guard(&world),
            warm_up: args.warm_up,
            step: world.settings().step,
            bytes,
            laps: Vec::new(),
        })
        .collect();
    // in turns, so that what else happens on the machine happens to all
    for _ in 0..args.repeat {
        for run in &mut runs {
            let measured = threads::with(run.threads, || {
                let mut world = world.clone();
                lap(&mut world, 1, going);
                Ok(lap(&mut world, steps, going))
            })?;
            if measured.steps == steps {
                run.laps.push(measured);
                lap_done();
            }
        }
    }
    runs.retain(|run| !run.laps.is_empty());
    Ok(runs)
}

/// Bytes that this program has allocated and not given back.
fn in_use() -> usize {
    let all = MEMORY.stats();
    all.bytes_allocated.saturating_sub(all.bytes_deallocated)
}

fn guard(world: &World) -> &'static str {
    let guards = || world.agents().group.iter().map(|group| world.group(group).guard);
    match (guards().all(|guard| guard), guards().any(|guard| guard)) {
        (true, _) => "on",
        (_, false) => "off",
        _ => "some",
    }
}
