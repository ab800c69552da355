//! The clocks of a rank: when a checkpoint or a line of progress is due, and what the steps have cost.

use crate::args::RunArgs;
use crate::memory;
use crate::ranks::Ranks;
use crate::report::Figures;
use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};
use throng::Counts;
use throng::halo::DividedWorld;

/// The cost of the slowest rank, relative to the mean, from which the ground is divided anew.
const UNEVEN: f64 = 1.15;
/// Time between two lines of progress on a terminal, and in the log of a job.
const ON_TERMINAL: Duration = Duration::from_secs(1);
const IN_LOG: Duration = Duration::from_secs(30);

/// Times and costs of a rank.
pub struct Clocks {
    /// When the last checkpoint was written.
    pub checkpoint: Instant,
    /// The time between two checkpoints; `None`: none are written.
    period: Option<Duration>,
    shown: Instant,
    begin: Instant,
    /// Time computed since the ground was divided, and in the whole run.
    since: Duration,
    computed: Duration,
    divisions: u32,
}

impl Clocks {
    /// Returns clocks that begin now.
    pub fn new(args: &RunArgs) -> Self {
        let now = Instant::now();
        let period = (args.checkpoint > 0.0).then(|| Duration::from_secs_f64((args.checkpoint * 60.0).min(1e9)));
        Self {
            checkpoint: now,
            period,
            shown: now,
            begin: now,
            since: Duration::ZERO,
            computed: Duration::ZERO,
            divisions: 1,
        }
    }

    /// Whether it is time for a checkpoint.
    pub fn checkpoint_is_due(&self) -> bool {
        self.period.is_some_and(|period| self.checkpoint.elapsed() >= period)
    }

    /// Whether it is time for a line of progress.
    pub fn progress_is_due(&mut self, args: &RunArgs) -> bool {
        let period = if std::io::stderr().is_terminal() { ON_TERMINAL } else { IN_LOG };
        let due = !args.quiet && self.shown.elapsed() >= period;
        if due {
            self.shown = Instant::now();
        }
        due
    }

    /// Makes a step, and measures it without the time in which the rank waits.
    pub fn step(&mut self, part: &mut DividedWorld<Ranks>) {
        let (start, waited) = (Instant::now(), part.halo().waited);
        part.step();
        let computed = start.elapsed().saturating_sub(part.halo().waited - waited);
        self.since += computed;
        self.computed += computed;
    }

    /// Divides the ground anew if the ranks are uneven.
    pub fn balance(&mut self, part: &mut DividedWorld<Ranks>) {
        let costs = part.halo().gather(self.since.as_secs_f64());
        let mean = costs.iter().sum::<f64>() / costs.len() as f64;
        let most = costs.iter().copied().fold(0.0, f64::max);
        if most > UNEVEN * mean {
            let cuts = part.balanced(self.since.as_secs_f64());
            part.halo_mut().cuts = cuts;
            self.divisions += 1;
        }
        self.since = Duration::ZERO;
    }

    /// Shows a line of progress.
    pub fn show(&self, time: f64, limit: f64, counts: &Counts) {
        let share = (time / limit).max(counts.arrived as f64 / counts.agents.max(1) as f64).min(1.0);
        let left = self.begin.elapsed().as_secs_f64() * (1.0 / share.max(1e-6) - 1.0);
        let line = format!(
            "{time:.1} s, {}/{} arrived, {:.0} %, {left:.0} s left",
            counts.arrived,
            counts.agents,
            share * 100.0
        );
        let mut to = std::io::stderr();
        // progress that cannot be shown is no error
        let _ = if to.is_terminal() { write!(to, "\r\x1b[K{line}") } else { writeln!(to, "{line}") };
    }

    /// Returns the figures of all ranks.
    pub fn figures(&self, part: &DividedWorld<Ranks>) -> Figures {
        let ranks = part.halo();
        let memory = ranks.gather(memory::peak());
        let mean = |own: f64| ranks.gather(own).iter().sum::<f64>() / ranks.count() as f64;
        Figures {
            stepping: self.begin.elapsed().as_secs_f64(),
            computing: mean(self.computed.as_secs_f64()),
            waiting: mean(ranks.waited.as_secs_f64()),
            sent: ranks.gather(ranks.sent).iter().sum(),
            divisions: self.divisions,
            largest: memory.iter().copied().max().unwrap_or(0),
            memory: memory.iter().sum(),
        }
    }
}
