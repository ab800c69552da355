//! A recording, piece by piece.

use super::{Begin, Source, Subject, Take};
use std::time::Duration;
use throng_draw::Still;
use throng_draw::record::{Files, Plan};
use throng_record::Choice;
use web_time::Instant;

/// A recording under way: let it [`work`](Self::work). Dropped, it leaves nothing.
pub struct Job {
    source: Box<dyn Source>,
    /// `None` once the file is complete.
    files: Option<Files>,
    from: f64,
    to: f64,
}

impl Job {
    /// Goes to the start of what is recorded, and begins the file.
    ///
    /// # Errors
    /// The scene cannot be built, or the file cannot be begun; why.
    pub fn new(subject: &Subject, take: &Take, begin: Begin) -> Result<Self, String> {
        let source = subject.begin(&take.style.annotations)?;
        let plan = Plan {
            setting: source.setting(),
            style: &take.style,
            rate: take.rate,
            speed_up: take.speed_up,
            still: Still::Last,
            from: take.from,
            choice: &Choice::default(),
        };
        let files = Files::new(vec![begin(&take.path, &plan)?], plan.pace(), plan.choice);
        let to = take.to.unwrap_or(f64::INFINITY);
        let mut job = Self { source, files: Some(files), from: take.from, to };
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
            if self.source.over() || self.reached(self.to) {
                self.finish()?;
            } else {
                self.source.advance()?;
                self.take()?;
            }
        }
        Ok(self.files.is_none())
    }

    /// How much is done, 0 to 1.
    pub fn share(&self) -> f32 {
        (self.source.time() / self.to.min(self.source.end()).max(1e-9)).clamp(0.0, 1.0) as f32
    }

    /// Whether the moment is nearest to this time, or after that.
    fn reached(&self, time: f64) -> bool {
        self.source.time() + 0.5 * self.source.step() > time + 1e-9
    }

    fn take(&mut self) -> Result<(), String> {
        if !self.reached(self.from) {
            return Ok(());
        }
        let (Some(files), source) = (&mut self.files, &self.source) else { return Ok(()) };
        let pushed = files.push(source.time(), source.step(), |frame| source.capture(frame));
        pushed.map_err(|error| error.to_string())
    }

    /// Completes the file with what there is of it.
    ///
    /// # Errors
    /// What is to be recorded has not begun yet, or the file cannot be written; why. Then nothing is left of it.
    pub fn finish(&mut self) -> Result<(), String> {
        if !self.reached(self.from) {
            let (end, from) = (self.source.time(), self.from);
            return Err(format!("it ends at {end:.2} s, before what is to be recorded begins, at {from:.2} s"));
        }
        let (Some(files), source) = (self.files.take(), &self.source) else { return Ok(()) };
        files.finish(source.time(), |frame| source.capture(frame)).map_err(|error| error.to_string())
    }
}
