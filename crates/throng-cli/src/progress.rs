//! The progress of long work, on standard error; hidden if standard error is not a terminal.

use crate::out::escaped;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressFinish, ProgressStyle};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;
use throng::World;

/// The resolution of the bar.
const PARTS: u64 = 1000;
/// The number of updates per second.
const RATE: u8 = 10;
/// How long work without known progress runs before a line appears.
const SILENCE: Duration = Duration::from_secs(2);

/// A progress bar.
pub struct Progress {
    bar: ProgressBar,
    /// The updates that were due, one for each interval that began before the last of them.
    due: AtomicU64,
}

impl Progress {
    /// Creates an empty bar, hidden if `quiet`.
    pub fn new(quiet: bool) -> Self {
        let bar = ProgressBar::with_draw_target(Some(PARTS), target(quiet)).with_finish(ProgressFinish::AndClear);
        if let Ok(style) = ProgressStyle::with_template("{bar:30} {msg}  {elapsed} (ETA {eta})") {
            bar.set_style(style);
        }
        Self { bar, due: AtomicU64::new(0) }
    }

    /// Whether it is time for the next update. Where progress is costly to compute, ask first.
    pub fn is_due(&self) -> bool {
        let now = (self.bar.elapsed().as_secs_f64() * f64::from(RATE)) as u64 + 1;
        !self.bar.is_hidden() && self.due.fetch_max(now, Ordering::Relaxed) < now
    }

    /// Shows the completed share of the work, 0 to 1, and a message.
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

/// Does work without known progress. After two seconds, a line with `doing` and the elapsed time appears until the work
/// is done.
pub fn waiting<T>(quiet: bool, doing: &str, work: impl FnOnce() -> T) -> T {
    waiting_on(target(quiet), SILENCE, doing, work)
}

fn waiting_on<T>(target: ProgressDrawTarget, silence: Duration, doing: &str, work: impl FnOnce() -> T) -> T {
    if target.is_hidden() {
        return work();
    }
    let (working, over) = mpsc::channel::<()>();
    thread::scope(|scope| {
        scope.spawn(move || {
            if over.recv_timeout(silence) == Err(mpsc::RecvTimeoutError::Timeout) {
                let line = ProgressBar::with_draw_target(None, target).with_elapsed(silence);
                if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}  {elapsed}") {
                    line.set_style(style);
                }
                line.set_message(escaped(doing).into_owned());
                line.enable_steady_tick(Duration::from_secs(1) / u32::from(RATE));
                // This returns when the sender is dropped.
                let _ = over.recv();
                line.finish_and_clear();
            }
        });
        let result = work();
        drop(working);
        result
    })
}

fn target(quiet: bool) -> ProgressDrawTarget {
    if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr_with_hz(RATE) }
}

/// Returns the completed share of a run of at most `limit` seconds: the share of the time or of arrivals, whichever is
/// larger.
pub fn share(world: &World, limit: f64) -> f64 {
    let counts = world.counts();
    (world.time() / limit).max(counts.arrived as f64 / counts.agents.max(1) as f64).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use indicatif::InMemoryTerm;

    /// Returns what a terminal shows during the work and after it.
    fn shown(silence: Duration, hidden: bool) -> [String; 2] {
        let terminal = InMemoryTerm::new(3, 80);
        let target = match hidden {
            true => ProgressDrawTarget::hidden(),
            false => ProgressDrawTarget::term_like(Box::new(terminal.clone())),
        };
        let during = waiting_on(target, silence, "building x\u{1b}[31m", || {
            thread::sleep(Duration::from_millis(500));
            terminal.contents()
        });
        [during, terminal.contents()]
    }

    #[test]
    fn a_line_names_long_work_until_it_is_done() {
        let [during, after] = shown(Duration::ZERO, false);
        assert!(during.contains("building x\\u001b[31m"), "{during}");
        assert_eq!(after, "");
        assert_eq!(shown(Duration::from_secs(3600), false), ["", ""]);
        assert_eq!(shown(Duration::ZERO, true), ["", ""]);
    }

    #[test]
    fn a_panic_of_the_work_ends_the_line_too() {
        let terminal = InMemoryTerm::new(3, 80);
        let target = ProgressDrawTarget::term_like(Box::new(terminal.clone()));
        let work = || waiting_on(target, Duration::ZERO, "building", || panic!("broken"));
        assert!(std::panic::catch_unwind(std::panic::AssertUnwindSafe(work)).is_err());
        assert_eq!(terminal.contents(), "");
    }
}
