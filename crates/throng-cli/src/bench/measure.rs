//! Measures one world.

use super::args::BenchArgs;
use super::plan::BenchSubject;
use crate::failure::Failure;
use crate::{MEMORY, interrupt, threads};
use std::time::Duration;
use throng::World;
use throng_bench::{Lap, lap, median};

/// The measurements of one world with one number of threads.
pub struct MeasuredRun {
    /// The name of the work or scene.
    pub work: String,
    /// The number of agents.
    pub agents: usize,
    /// Threads for the steps.
    pub threads: usize,
    /// Whether the guard was on: on, off, or some (of the agents).
    pub guard: &'static str,
    /// Steps before measuring.
    pub warm_up: u32,
    /// Simulated seconds per step.
    pub step: f64,
    /// Bytes allocated for the world, per agent.
    pub bytes: f64,
    /// The repeats; at least one.
    pub laps: Vec<Lap>,
}

impl MeasuredRun {
    /// Returns the median nanoseconds per agent-step of the duration that `time` takes from a lap.
    pub fn ns(&self, time: impl Fn(&Lap) -> Duration) -> f64 {
        median(self.laps.iter().map(|lap| lap.ns(time(lap))).collect())
    }

    /// Returns the median processor nanoseconds per agent-step; NaN where the system does not report them.
    pub fn cpu_ns(&self) -> f64 {
        median(self.laps.iter().filter_map(|lap| Some(lap.ns(lap.cpu?))).collect())
    }

    /// Returns the least wall-clock nanoseconds per agent-step.
    pub fn least_ns(&self) -> f64 {
        self.laps.iter().map(|lap| lap.ns(lap.wall)).fold(f64::INFINITY, f64::min)
    }

    /// Returns the median processor seconds per simulated second; NaN where the system does not report them.
    pub fn cpu_per_second(&self) -> f64 {
        let share = |lap: &Lap| Some(lap.cpu?.as_secs_f64() / (f64::from(lap.steps) * self.step));
        median(self.laps.iter().filter_map(share).collect())
    }
}

/// Measures a world with each number of threads and calls `lap_done` after each repeat. Leaves out thread counts
/// without a complete repeat at an interruption.
///
/// # Errors
/// The world cannot be built, or the threads cannot be started.
pub fn measure(
    subject: &BenchSubject,
    args: &BenchArgs,
    counts: &[usize],
    mut lap_done: impl FnMut(),
) -> Result<Vec<MeasuredRun>, Failure> {
    let before = in_use();
    let mut world = subject.build()?;
    let going = || !interrupt::asked();
    let most = counts.iter().copied().max().unwrap_or(1);
    threads::with(most, || Ok(lap(&mut world, args.warm_up, going)))?;
    let agents = world.relative_columns().len();
    let bytes = in_use().saturating_sub(before) as f64 / agents.max(1) as f64;
    let steps = args.steps(agents);
    let mut runs: Vec<MeasuredRun> = counts
        .iter()
        .map(|&threads| MeasuredRun {
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
    // Thread counts take turns, so that other load on the machine affects all of them equally.
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

/// Returns the bytes that this program has allocated and not freed.
fn in_use() -> usize {
    let all = MEMORY.stats();
    all.bytes_allocated.saturating_sub(all.bytes_deallocated)
}

fn guard(world: &World) -> &'static str {
    let guards = || world.relative_columns().group.iter().map(|group| world.group(group).guard);
    match (guards().all(|guard| guard), guards().any(|guard| guard)) {
        (true, _) => "on",
        (_, false) => "off",
        _ => "some",
    }
}
