//! The progress bar.

use crate::out::escaped;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressFinish, ProgressStyle};
use throng::World;

/// How fine the bar is.
const PARTS: u64 = 1000;

/// A bar on standard error; nothing where that is no terminal.
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// A bar, empty.
    pub fn new(quiet: bool) -> Self {
        let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr_with_hz(10) };
        let bar = ProgressBar::with_draw_target(Some(PARTS), target).with_finish(ProgressFinish::AndClear);
        if let Ok(style) = ProgressStyle::with_template("{bar:30} {msg}  {elapsed} (ETA {eta})") {
            bar.set_style(style);
        }
        Self { bar }
    }

    /// Shows what share of the work is done, 0 to 1, and says more.
    pub fn show(&self, share: f64, message: impl FnOnce() -> String) {
        if !self.bar.is_hidden() {
            self.bar.set_position((share * PARTS as f64) as u64);
            self.bar.set_message(escaped(&message()).into_owned());
        }
    }

    /// Removes the bar.
    pub fn done(&self) {
        self.bar.finish_and_clear();
    }
}

/// What share of a run of at most `limit` seconds is done: of the time or of the arrivals, whichever is more.
pub fn share(world: &World, limit: f64) -> f64 {
    let counts = world.counts();
    (world.time() / limit).max(counts.arrived as f64 / counts.agents.max(1) as f64).min(1.0)
}
