//! Contestants take turns, so that what else happens on the machine happens to all.

use std::error::Error;
use std::time::Duration;
use throng_bench::clock::thread_time;
use throng_bench::median;

/// What some steps took.
pub struct Turn {
    /// Moves of one agent by one step.
    pub agent_steps: u64,
    /// Processor time.
    pub cpu: Duration,
    /// Simulated seconds.
    pub seconds: f64,
}

impl Turn {
    /// What `count` steps of so many agents take, each of `seconds`.
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

/// Someone who is measured.
pub trait Contestant {
    /// What it is.
    fn name(&self) -> String;

    /// Goes back to where everybody was after the warm-up.
    ///
    /// # Errors
    /// Another program does not answer.
    fn restart(&mut self) -> Result<(), Box<dyn Error>>;

    /// Makes so many steps.
    ///
    /// # Errors
    /// Another program does not answer.
    fn steps(&mut self, count: u32) -> Result<Turn, Box<dyn Error>>;
}

/// What came of a contestant.
pub struct Outcome {
    /// What it is.
    pub name: String,
    /// Nanoseconds of processor time an agent-step, a turn each.
    pub ns: Vec<f64>,
    /// Processor seconds a simulated second, the median.
    pub cpu_per_second: f64,
}

impl Outcome {
    /// The median.
    pub fn median(&self) -> f64 {
        median(self.ns.clone())
    }
}

/// Measures everybody: in each of `repeat` rounds everybody begins where the warm-up ended, makes one step that does not count,
/// and then `steps`.
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
