//! A recording, piece by piece.

use super::{Begin, Source, Subject, Take};
use std::sync::Arc;
use std::time::Duration;
use throng_draw::Still;
use throng_draw::record::{Files, Plan};
use throng_record::{Frame, Pool};
use web_time::Instant;

/// A recording under way: let it [`work`](Self::work). Dropped, it leaves nothing.
pub struct Job {
    /// What is recorded side by side, on one clock.
    sources: Vec<Box<dyn Source>>,
    /// `None` once the file is complete.
    files: Option<Files>,
    frames: Pool<Frame>,
    from: f64,
    to: f64,
}

impl Job {
    /// Goes to the start of what is recorded, and begins the file.
    ///
    /// # Errors
    /// The scene cannot be built, what is chosen is not there, or the file cannot be begun; why.
    pub fn new(subject: &Subject, take: &Take, begin: Begin) -> Result<Self, String> {
        let sources = subject.begin(&take.style.annotations)?;
        let (setting, sheet) = (sources[0].setting(), subject.sheet(&sources, take.style.legend));
        take.choice.check(setting, throng_record::Format::of(&take.path)).map_err(|error| error.to_string())?;
        let from = take.choice.from.max(sources[0].time());
        let plan = Plan {
            setting,
            sheet: sheet.as_ref(),
            style: &take.style,
            rate: take.rate,
            speed_up: take.speed_up,
            still: Still::Last,
            from,
            choice: &take.choice,
            stop: || false,
        };
        let files = Files::new(vec![begin(&take.path, &plan)?], plan.pace(), plan.choice);
        let mut job = Self { sources, files: Some(files), frames: Pool::default(), from, to: take.choice.to };
        job.take()?;
        Ok(job)
    }

    /// Goes on for as long as `budget`, or a step more; whether the file is complete.
    ///
    /// # Errors
    /// Code of the scene panicked, or the file cannot be written; why. Then nothing is left of it.
    pub fn work(&mut self, budget: Duration) -> Result<bool, String> {
        let begin = Instant::now();
        while self.files.is_some() && begin.elapsed() < budget {
            if self.sources.iter().all(|source| source.over()) || self.time() >= self.to - SLACK {
                self.finish()?;
            } else {
                // who is over keeps the last moment
                self.sources.iter_mut().filter(|source| !source.over()).try_for_each(|source| source.advance())?;
                self.take()?;
            }
        }
        Ok(self.files.is_none())
    }

    /// How much is done, 0 to 1.
    pub fn share(&self) -> f32 {
        let end = self.sources.iter().map(|source| source.end()).fold(0.0, f64::max);
        (self.time() / self.to.min(end).max(1e-9)).clamp(0.0, 1.0) as f32
    }

    /// The time of the source that is farthest, seconds.
    fn time(&self) -> f64 {
        self.sources.iter().map(|source| source.time()).fold(f64::NEG_INFINITY, f64::max)
    }

    fn take(&mut self) -> Result<(), String> {
        let (time, step) = (self.time(), self.sources[0].step());
        let Self { sources, files, frames, .. } = self;
        let Some(files) = files else { return Ok(()) };
        files.push_all(time, step, || captured(sources, frames)).map_err(|error| error.to_string())
    }

    /// Completes the file with what there is of it.
    ///
    /// # Errors
    /// What is to be recorded has not begun yet, or the file cannot be written; why. Then nothing is left of it.
    pub fn finish(&mut self) -> Result<(), String> {
        let (end, from) = (self.time(), self.from);
        if end + 0.5 * self.sources[0].step() <= from + SLACK {
            return Err(format!("it ends at {end:.2} s, before what is to be recorded begins, at {from:.2} s"));
        }
        let Self { sources, files, frames, .. } = self;
        let Some(files) = files.take() else { return Ok(()) };
        files.finish_all(end, || captured(sources, frames)).map_err(|error| error.to_string())
    }
}

/// Rounding of times, seconds.
const SLACK: f64 = 1e-9;

/// A frame a source.
fn captured(sources: &[Box<dyn Source>], frames: &mut Pool<Frame>) -> Vec<Arc<Frame>> {
    sources.iter().map(|source| frames.make(|frame| source.capture(frame))).collect()
}
