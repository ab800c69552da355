//! Measures the time of steps of a world.

use crate::clock::process_time;
use std::time::{Duration, Instant};
use throng::{Stage, World};

/// The time of some steps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lap {
    /// Number of steps.
    pub steps: u32,
    /// Number of moves of an agent by a sub-step.
    pub agent_steps: u64,
    /// Wall-clock time.
    pub wall: Duration,
    /// Processor time, all threads; `None` if the system does not report it.
    pub cpu: Option<Duration>,
    /// Wall-clock time in each stage, in the order of [`Stage::ALL`].
    pub stages: [Duration; 5],
}

impl Lap {
    /// Returns nanoseconds per agent-step of a time.
    pub fn ns(&self, time: Duration) -> f64 {
        time.as_secs_f64() * 1e9 / self.agent_steps.max(1) as f64
    }
}

/// Advances a world by `steps` steps, as long as `go_on`, called before each, returns `true`.
pub fn lap(world: &mut World, steps: u32, mut go_on: impl FnMut() -> bool) -> Lap {
    let mut lap = Lap::default();
    let agent_steps = world.summary().agent_steps;
    let cpu = process_time();
    while lap.steps < steps && go_on() {
        let begin = Instant::now();
        let mut last = begin;
        world.step_in_stages(|stage: Stage| {
            let now = Instant::now();
            lap.stages[stage as usize] += now - last;
            last = now;
        });
        lap.wall += begin.elapsed();
        lap.steps += 1;
    }
    lap.cpu = process_time().zip(cpu).map(|(now, before)| now.saturating_sub(before));
    lap.agent_steps = world.summary().agent_steps - agent_steps;
    lap
}

/// Returns the median, the mean of the two middle values for an even number of values; NaN for no values.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let n = values.len();
    if n == 0 { f64::NAN } else { 0.5 * (values[(n - 1) / 2] + values[n / 2]) }
}
