//! All files of a run.

use super::{Moment, Pace, Recorder};
use crate::{Error, Sheet, Still, Style};
use std::sync::Arc;
use throng_record::{Choice, Frame, Pool, Setting};

/// How far after the end of the choice a picture can be, seconds, because times are rounded.
const SLACK: f64 = 1e-6;

/// The settings that the files of a run share.
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a> {
    /// The place and the names.
    pub setting: &'a Setting,
    /// The panels of pictures, for several runs side by side; trajectories are of the first run.
    pub sheet: Option<&'a Sheet>,
    /// The look of pictures.
    pub style: &'a Style,
    /// Pictures per second of video.
    pub rate: f64,
    /// Seconds of the world per second of video.
    pub speed_up: f64,
    /// The moment that single pictures show.
    pub still: Still,
    /// The time of the first picture, seconds.
    pub from: f64,
    /// What is written to trajectories. No file has moments after the end of the choice.
    pub choice: &'a Choice,
    /// Whether to stop between two moments. Called often while pictures or moments fill a long gap.
    pub stop: fn() -> bool,
}

impl Plan<'_> {
    /// Returns the panels of pictures.
    pub(super) fn shown(&self) -> Sheet {
        self.sheet.cloned().unwrap_or_else(|| self.setting.into())
    }

    /// Returns the times of pictures.
    pub fn pace(&self) -> Pace {
        Pace::new(self.from, self.speed_up / self.rate)
    }
}

/// What is due at a moment.
struct Due {
    /// The number of pictures.
    pictures: u64,
    /// Whether films follow the moment.
    follow: bool,
    /// Whether trajectories take it.
    rows: bool,
}

/// All files of a run, or of several runs with a common clock. They get their names when they are complete; files
/// dropped before that are deleted.
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
    /// The time of the last moment.
    before: Option<f64>,
    /// The time of the last picture.
    last: Option<f64>,
}

impl Files {
    /// Creates the set of already created files, with pictures at this pace and the chosen trajectories.
    pub fn new(files: Vec<Recorder>, pace: Pace, choice: &Choice) -> Self {
        Self { files, frames: Pool::default(), pace, choice: choice.clone(), stop: || false, before: None, last: None }
    }

    /// Sets the condition on which [`push`](Self::push) skips the remaining pictures of a moment: `stop` returns true.
    pub fn stopped_by(self, stop: fn() -> bool) -> Self {
        Self { stop, ..self }
    }

    /// Whether there are no files.
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }

    /// Adds the world's moment after a step (and before the first); the next step is `step` seconds long. Trajectories
    /// take every chosen moment. Pictures take the step nearest to their due time. `capture` writes the frame if a file
    /// needs it.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn push(&mut self, time: f64, step: f64, capture: impl FnOnce(&mut Frame)) -> Result<(), Error> {
        let Some(due) = self.due(time, step) else { return Ok(()) };
        let frames = vec![self.frames.make(capture)];
        self.hand_over(frames, due)
    }

    /// Adds a moment of several runs, with one frame for each run.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn push_all(&mut self, time: f64, step: f64, frames: impl FnOnce() -> Vec<Arc<Frame>>) -> Result<(), Error> {
        let Some(due) = self.due(time, step) else { return Ok(()) };
        self.hand_over(frames(), due)
    }

    /// Passes a moment to the recorders, once per due picture.
    fn hand_over(&mut self, frames: Vec<Arc<Frame>>, due: Due) -> Result<(), Error> {
        let mut moment = Moment { frames, picture: due.pictures > 0, follow: due.follow, rows: due.rows };
        Recorder::push_all(&mut self.files, &moment)?;
        moment.rows = false;
        (1..due.pictures).take_while(|_| !(self.stop)()).try_for_each(|_| Recorder::push_all(&mut self.files, &moment))
    }

    /// Returns what is due at this moment; `None` if no file takes it.
    fn due(&mut self, time: f64, step: f64) -> Option<Due> {
        let before = self.before.replace(time).unwrap_or(time - step);
        let rows = self.choice.needs(before, time, time + step);
        let films = self.files.iter().any(|file| !file.is_table());
        let pictures = if films { self.pace.due((time + 0.5 * step).min(self.choice.to + SLACK)) } else { 0 };
        if pictures > 0 {
            self.last = Some(time);
        }
        // Trails and motion blur are made of all steps.
        let follow = films && self.last.is_some() && (pictures > 0 || time <= self.choice.to + SLACK);
        let takes = |file: &Recorder| if file.is_table() { rows } else { follow };
        self.files.iter().any(takes).then_some(Due { pictures, follow, rows })
    }

    /// Adds the last moment if no picture shows it yet, and completes all files.
    ///
    /// # Errors
    /// A file cannot be completed.
    pub fn finish(mut self, time: f64, capture: impl FnOnce(&mut Frame)) -> Result<(), Error> {
        let frames = self.lacks(time).then(|| vec![self.frames.make(capture)]);
        self.complete(frames)
    }

    /// Completes all files for several runs, with one frame for each run.
    ///
    /// # Errors
    /// A file cannot be completed.
    pub fn finish_all(self, time: f64, frames: impl FnOnce() -> Vec<Arc<Frame>>) -> Result<(), Error> {
        let frames = self.lacks(time).then(frames);
        self.complete(frames)
    }

    /// Whether this is the last moment and no picture shows it.
    fn lacks(&self, time: f64) -> bool {
        let within = self.last.is_none() || time <= self.choice.to;
        within && self.last != Some(time) && self.files.iter().any(|file| !file.is_table())
    }

    fn complete(mut self, last: Option<Vec<Arc<Frame>>>) -> Result<(), Error> {
        if let Some(frames) = last {
            Recorder::push_all(&mut self.files, &Moment { frames, picture: true, follow: true, rows: false })?;
        }
        self.files.into_iter().try_for_each(Recorder::finish)
    }
}
