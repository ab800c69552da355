//! A recording in time slices.

use super::{Begin, Source, Subject, Take};
use std::sync::Arc;
use std::time::Duration;
use throng_draw::Still;
use throng_draw::record::{Files, Plan};
use throng_record::{Frame, Pool};
use web_time::Instant;

/// A recording under way: let it [`work`](Self::work). Dropping it before it is complete removes its file.
pub struct Job {
    /// The runs recorded side by side, on the same clock.
    sources: Vec<Box<dyn Source>>,
    /// The output, `None` once the file is complete.
    files: Option<Files>,
    frames: Pool<Frame>,
    from: f64,
    to: f64,
}

impl Job {
    /// Builds the runs and creates the file.
    ///
    /// # Errors
    /// The scene cannot be built, the choice does not fit the scene, or the file cannot be created.
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

    /// Works until `budget` is used up; the last step may exceed it. Returns whether the file is complete.
    ///
    /// # Errors
    /// Code of the scene panicked, or the file cannot be written. The file is removed.
    pub fn work(&mut self, budget: Duration) -> Result<bool, String> {
        let begin = Instant::now();
        while self.files.is_some() && begin.elapsed() < budget {
            if self.sources.iter().all(|source| source.over()) || self.time() >= self.to - SLACK {
                self.finish()?;
            } else {
                // a run that has ended stays at its last moment
                self.sources.iter_mut().filter(|source| !source.over()).try_for_each(|source| source.advance())?;
                self.take()?;
            }
        }
        Ok(self.files.is_none())
    }

    /// Returns the completed share, 0 to 1.
    pub fn share(&self) -> f32 {
        let end = self.sources.iter().map(|source| source.end()).fold(0.0, f64::max);
        (self.time() / self.to.min(end).max(1e-9)).clamp(0.0, 1.0) as f32
    }

    /// Returns the time of the most advanced run, seconds.
    fn time(&self) -> f64 {
        self.sources.iter().map(|source| source.time()).fold(f64::NEG_INFINITY, f64::max)
    }

    fn take(&mut self) -> Result<(), String> {
        let (time, step) = (self.time(), self.sources[0].step());
        let Self { sources, files, frames, .. } = self;
        let Some(files) = files else { return Ok(()) };
        files.push_all(time, step, || captured(sources, frames)).map_err(|error| error.to_string())
    }

    /// Completes the file with the frames that exist.
    ///
    /// # Errors
    /// The recorded time span has not begun yet, or the file cannot be written. The file is removed.
    pub fn finish(&mut self) -> Result<(), String> {
        let (end, from) = (self.time(), self.from);
        if end + 0.5 * self.sources[0].step() <= from + SLACK {
            return Err(format!("the run ends at {end:.2} s, before the recording begins, at {from:.2} s"));
        }
        let Self { sources, files, frames, .. } = self;
        let Some(files) = files.take() else { return Ok(()) };
        files.finish_all(end, || captured(sources, frames)).map_err(|error| error.to_string())
    }
}

/// The tolerance of times, seconds.
const SLACK: f64 = 1e-9;

/// Captures one frame of each run.
fn captured(sources: &[Box<dyn Source>], frames: &mut Pool<Frame>) -> Vec<Arc<Frame>> {
    sources.iter().map(|source| frames.make(|frame| source.capture(frame))).collect()
}
