//! The progress bar.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressFinish, ProgressStyle};
use throng::World;

/// How fine the bar is.
const PARTS: u64 = 1000;

/// A bar on standard error; nothing where that is no terminal.
pub struct Progress {
    bar: ProgressBar,
    limit: f64,
}

impl Progress {
    /// A bar for a run of at most `limit` seconds.
    pub fn new(quiet: bool, limit: f64) -> Self {
        let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr_with_hz(10) };
        let bar = ProgressBar::with_draw_target(Some(PARTS), target).with_finish(ProgressFinish::AndClear);
        if let Ok(style) = ProgressStyle::with_template("{bar:30} {msg}  {elapsed} (ETA {eta})") {
            bar.set_style(style);
        }
        Self { bar, limit }
    }

    /// Shows where the run is. The bar follows time or arrivals, whichever is farther.
    pub fn show(&self, world: &World) {
        if self.bar.is_hidden() {
            return;
        }
        let counts = world.counts();
        let (arrived, total) = (counts.arrived, counts.agents);
        let share = (world.time() / self.limit).max(arrived as f64 / total.max(1) as f64).min(1.0);
        self.bar.set_position((share * PARTS as f64) as u64);
        self.bar.set_message(format!("{:.1} s, {arrived}/{total} arrived", world.time()));
    }

    /// Removes the bar.
    pub fn done(&self) {
        self.bar.finish_and_clear();
    }
}
