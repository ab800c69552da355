//! How long some steps of a world take.

use crate::clock::process_time;
use std::time::{Duration, Instant};
use throng::{Stage, World};

/// How long some steps took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lap {
    /// Steps made.
    pub steps: u32,
    /// Moves of one agent by one sub-step.
    pub agent_steps: u64,
    /// Time on the clock.
    pub wall: Duration,
    /// Processor time, all threads; `None` where the system does not tell.
    pub cpu: Option<Duration>,
    /// Time on the clock in each stage, in the order of [`Stage::ALL`].
    pub stages: [Duration; 5],
}

impl Lap {
    /// Nanoseconds an agent-step of some of the time.
    pub fn ns(&self, time: Duration) -> f64 {
        time.as_secs_f64() * 1e9 / self.agent_steps.max(1) as f64
    }
}

/// Moves a world on by so many steps, as long as `go_on` says, which is asked before each.
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

/// The middle value; the mean of the two in the middle of an even number; not a number for none.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let n = values.len();
    if n == 0 { f64::NAN } else { 0.5 * (values[(n - 1) / 2] + values[n / 2]) }
}
