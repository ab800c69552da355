//! The files of a run, on one clock.

use super::{Moment, Pace, Recorder};
use crate::{Error, Sheet, Still, Style};
use std::sync::Arc;
use throng_record::{Choice, Frame, Pool, Setting};

/// How far after the end of what is chosen a picture may be, seconds: times are rounded.
const SLACK: f64 = 1e-6;

/// What the files of a run have in common.
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a> {
    /// The place and the names.
    pub setting: &'a Setting,
    /// What pictures show, where that is several runs side by side; trajectories are of the first.
    pub sheet: Option<&'a Sheet>,
    /// The look of pictures.
    pub style: &'a Style,
    /// Pictures a second of video.
    pub rate: f64,
    /// Seconds of the world in a second of video.
    pub speed_up: f64,
    /// Which moment single pictures show.
    pub still: Still,
    /// When the first picture is due, seconds.
    pub from: f64,
    /// What of it is written to trajectories; none of the files has anything after its end.
    pub choice: &'a Choice,
    /// Whether to stop between two moments: it is called often while a long gap is filled with pictures or moments.
    pub stop: fn() -> bool,
}

impl Plan<'_> {
    /// What pictures show.
    pub(super) fn shown(&self) -> Sheet {
        self.sheet.cloned().unwrap_or_else(|| self.setting.into())
    }

    /// When pictures are due.
    pub fn pace(&self) -> Pace {
        Pace::new(self.from, self.speed_up / self.rate)
    }
}

/// All files of a run, or of several that go on together. They get their names when they are complete; dropped before that, they leave nothing.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("run.csv");
/// use throng_draw::record::{Files, Plan, Recorder};
/// use throng_draw::{Still, Style};
/// use throng_record::{Choice, Setting};
/// let (setting, style, choice) = (Setting::default(), Style::default(), Choice::default());
/// let (rate, speed_up, still) = (25.0, 1.0, Still::Last);
/// let (sheet, from, stop) = (None, 0.0, || false);
/// let plan = Plan { setting: &setting, sheet, style: &style, rate, speed_up, still, from, choice: &choice, stop };
/// let mut files = Files::new(vec![Recorder::create(&path, &plan)?], plan.pace(), &choice);
/// for k in 0..3 {
///     files.push(f64::from(k) * 0.1, 0.1, |frame| frame.time = f64::from(k) * 0.1)?;
/// }
/// files.finish(0.2, |frame| frame.time = 0.2)?;
/// assert!(path.exists());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Files {
    files: Vec<Recorder>,
    frames: Pool<Frame>,
    pace: Pace,
    choice: Choice,
    stop: fn() -> bool,
    /// Time of the last moment.
    before: Option<f64>,
    /// Time of the last picture.
    last: Option<f64>,
}

impl Files {
    /// Files that have been begun, with pictures at this pace and trajectories of what is chosen.
    pub fn new(files: Vec<Recorder>, pace: Pace, choice: &Choice) -> Self {
        Self { files, frames: Pool::default(), pace, choice: choice.clone(), stop: || false, before: None, last: None }
    }

    /// The same files, of which [`push`](Self::push) leaves out the rest of a moment's pictures as soon as `stop` returns true.
    pub fn stopped_by(self, stop: fn() -> bool) -> Self {
        Self { stop, ..self }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }

    /// Takes in the world after a step (and before the first), with the next one in `step` seconds: trajectories every time
    /// that is chosen, pictures when one is due, which is at the step nearest to its time. `capture` makes the moment.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn push(&mut self, time: f64, step: f64, capture: impl FnOnce(&mut Frame)) -> Result<(), Error> {
        let Some((pictures, rows)) = self.due(time, step) else { return Ok(()) };
        let frames = vec![self.frames.make(capture)];
        self.hand_over(frames, pictures, rows)
    }

    /// The same of several runs, a frame each.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn push_all(&mut self, time: f64, step: f64, frames: impl FnOnce() -> Vec<Arc<Frame>>) -> Result<(), Error> {
        let Some((pictures, rows)) = self.due(time, step) else { return Ok(()) };
        self.hand_over(frames(), pictures, rows)
    }

    /// Hands over a moment picture by picture.
    fn hand_over(&mut self, frames: Vec<Arc<Frame>>, pictures: u64, rows: bool) -> Result<(), Error> {
        let mut moment = Moment { frames, picture: pictures > 0, rows };
        Recorder::push_all(&mut self.files, &moment)?;
        moment.rows = false;
        (1..pictures).take_while(|_| !(self.stop)()).try_for_each(|_| Recorder::push_all(&mut self.files, &moment))
    }

    /// How many pictures are due, and whether trajectories take this moment; none where no file takes it.
    fn due(&mut self, time: f64, step: f64) -> Option<(u64, bool)> {
        let before = self.before.replace(time).unwrap_or(time - step);
        let rows = self.choice.needs(before, time, time + step);
        let films = self.files.iter().any(|file| !file.is_table());
        let pictures = if films { self.pace.due((time + 0.5 * step).min(self.choice.to + SLACK)) } else { 0 };
        if pictures > 0 {
            self.last = Some(time);
        }
        let takes = |file: &Recorder| if file.is_table() { rows } else { pictures > 0 };
        self.files.iter().any(takes).then_some((pictures, rows))
    }

    /// Shows the end, if no picture did yet, and completes all files.
    ///
    /// # Errors
    /// A file cannot be completed.
    pub fn finish(mut self, time: f64, capture: impl FnOnce(&mut Frame)) -> Result<(), Error> {
        let frames = self.lacks(time).then(|| vec![self.frames.make(capture)]);
        self.complete(frames)
    }

    /// The same of several runs, a frame each.
    ///
    /// # Errors
    /// A file cannot be completed.
    pub fn finish_all(self, time: f64, frames: impl FnOnce() -> Vec<Arc<Frame>>) -> Result<(), Error> {
        let frames = self.lacks(time).then(frames);
        self.complete(frames)
    }

    /// Whether this is the last moment and no picture has shown it.
    fn lacks(&self, time: f64) -> bool {
        let within = self.last.is_none() || time <= self.choice.to;
        within && self.last != Some(time) && self.files.iter().any(|file| !file.is_table())
    }

    fn complete(mut self, last: Option<Vec<Arc<Frame>>>) -> Result<(), Error> {
        if let Some(frames) = last {
            Recorder::push_all(&mut self.files, &Moment { frames, picture: true, rows: false })?;
        }
        self.files.into_iter().try_for_each(Recorder::finish)
    }
}
