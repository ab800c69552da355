//! The files of a run, on one clock.

use super::{Moment, Pace, Recorder};
use crate::{Error, Still, Style};
use throng_record::{Frame, Pool, Setting};

/// What the files of a run have in common.
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a> {
    /// The place and the names.
    pub setting: &'a Setting,
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
}

/// All files of a run. They get their names when they are complete; dropped before that, they leave nothing.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("run.csv");
/// use throng_draw::record::{Files, Plan, Recorder};
/// use throng_draw::{Still, Style};
/// use throng_record::Setting;
/// let (setting, style) = (Setting::default(), Style::default());
/// let plan = Plan { setting: &setting, style: &style, rate: 25.0, speed_up: 1.0, still: Still::Last, from: 0.0 };
/// let mut files = Files::new(vec![Recorder::create(&path, &plan)?], &plan);
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
    /// Time of the last picture.
    last: Option<f64>,
}

impl Files {
    /// Files that have been begun.
    pub fn new(files: Vec<Recorder>, plan: &Plan) -> Self {
        let pace = Pace::new(plan.from, plan.speed_up / plan.rate);
        Self { files, frames: Pool::default(), pace, last: None }
    }

    /// Takes in the world after a step of `step` seconds (and before the first): tables every time, pictures when
    /// one is due, which is at the step nearest to its time. `capture` makes the moment.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn push(&mut self, time: f64, step: f64, capture: impl FnOnce(&mut Frame)) -> Result<(), Error> {
        let due = self.pace.due(time, step);
        if due > 0 {
            self.last = Some(time);
        }
        if self.files.iter().any(|file| due > 0 || file.is_table()) {
            let moment = Moment { frames: vec![self.frames.make(capture)], pictures: due, rows: true };
            Recorder::push_all(&mut self.files, &moment)?;
        }
        Ok(())
    }

    /// Shows the end, if no picture did yet, and completes all files.
    ///
    /// # Errors
    /// A file cannot be completed.
    pub fn finish(mut self, time: f64, capture: impl FnOnce(&mut Frame)) -> Result<(), Error> {
        if self.last != Some(time) && self.files.iter().any(|file| !file.is_table()) {
            let moment = Moment { frames: vec![self.frames.make(capture)], pictures: 1, rows: false };
            Recorder::push_all(&mut self.files, &moment)?;
        }
        self.files.into_iter().try_for_each(Recorder::finish)
    }
}
