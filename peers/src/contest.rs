//! Measures contestants in turns, so that disturbances on the machine affect all of them.

use std::error::Error;
use std::time::Duration;
use throng_bench::clock::thread_time;
use throng_bench::median;

/// The time of some steps.
pub struct Turn {
    /// Number of moves of an agent by a step.
    pub agent_steps: u64,
    /// Processor time.
    pub cpu: Duration,
    /// Simulated time, seconds.
    pub seconds: f64,
}

impl Turn {
    /// Measures `count` steps of `agents` agents, each of `seconds`.
    pub fn of(count: u32, agents: usize, seconds: f32, mut step: impl FnMut()) -> Self {
        let begin = thread_time();
        for _ in 0..count {
            step();
        }
        Self {
            agent_steps: u64::from(count) * agents as u64,
            cpu: thread_time() - begin,
            seconds: f64::from(count) * f64::from(seconds),
        }
    }
}

/// A simulator that is measured.
pub trait Contestant {
    /// Returns its name.
    fn name(&self) -> String;

    /// Returns to the state after the warm-up.
    ///
    /// # Errors
    /// Another program does not answer.
    fn restart(&mut self) -> Result<(), Box<dyn Error>>;

    /// Makes `count` steps.
    ///
    /// # Errors
    /// Another program does not answer.
    fn steps(&mut self, count: u32) -> Result<Turn, Box<dyn Error>>;
}

/// The result of a contestant.
pub struct Outcome {
    /// Its name.
    pub name: String,
    /// Processor time per agent-step of each turn, nanoseconds.
    pub ns: Vec<f64>,
    /// Processor seconds per simulated second, the median.
    pub cpu_per_second: f64,
}

impl Outcome {
    /// Returns the median time per agent-step, nanoseconds.
    pub fn median(&self) -> f64 {
        median(self.ns.clone())
    }
}

/// Measures all contestants. In each of `repeat` rounds, each of them returns to the state after the warm-up, makes a
/// step that does not count, and then `steps` steps.
///
/// # Errors
/// Another program does not answer.
pub fn measure(
    mut contestants: Vec<Box<dyn Contestant>>,
    steps: u32,
    repeat: u32,
) -> Result<Vec<Outcome>, Box<dyn Error>> {
    let mut turns: Vec<Vec<Turn>> = contestants.iter().map(|_| Vec::new()).collect();
    for _ in 0..repeat {
        for (contestant, turns) in contestants.iter_mut().zip(&mut turns) {
            contestant.restart()?;
            contestant.steps(1)?;
            turns.push(contestant.steps(steps)?);
        }
    }
    let outcome = |(name, turns): (String, &Vec<Turn>)| Outcome {
        name,
        ns: turns.iter().map(|turn| turn.cpu.as_secs_f64() * 1e9 / turn.agent_steps.max(1) as f64).collect(),
        cpu_per_second: median(turns.iter().map(|turn| turn.cpu.as_secs_f64() / turn.seconds).collect()),
    };
    Ok(contestants.iter().map(|contestant| contestant.name()).zip(&turns).map(outcome).collect())
}
