//! The files a run writes.

use crate::failure::Failure;
use crate::pace::Pace;
use crate::recorder::{Moment, Recorder};
use std::path::{Path, PathBuf};
use throng_draw::sink::Kind;
use throng_draw::{Film, Sheet, Still, Style};
use throng_record::csv::CsvWriter;
use throng_record::{Frame, Pool, Setting};

/// All files of a run. They get their names when they are complete; dropped before that, they leave nothing.
pub struct Files {
    files: Vec<Recorder>,
    paths: Vec<PathBuf>,
    frames: Pool<Frame>,
    pace: Pace,
    /// Time of the last picture.
    last: Option<f64>,
}

/// What the files have in common.
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
}

impl Files {
    /// Begins all files.
    ///
    /// # Errors
    /// A name does not say what to write or comes twice, or a file cannot be begun.
    pub fn create(paths: &[PathBuf], plan: &Plan) -> Result<Self, Failure> {
        let mut files = Vec::new();
        distinct(paths)?;
        for path in paths {
            files.push(begin(path, plan)?);
        }
        Ok(Self {
            files,
            paths: paths.to_vec(),
            frames: Pool::default(),
            pace: Pace::new(plan.speed_up / plan.rate),
            last: None,
        })
    }

    /// What the files are called.
    pub fn paths(&self) -> &[PathBuf] {
        &self.paths
    }

    /// Takes in the world after a step of `step` seconds (and before the first): tables every time, pictures when
    /// one is due, which is at the step nearest to its time. `capture` makes the moment.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn push(&mut self, time: f64, step: f64, capture: impl FnOnce(&mut Frame)) -> Result<(), Failure> {
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
    pub fn finish(mut self, time: f64, capture: impl FnOnce(&mut Frame)) -> Result<(), Failure> {
        if self.last != Some(time) && self.files.iter().any(|file| !file.is_table()) {
            let moment = Moment { frames: vec![self.frames.make(capture)], pictures: 1, rows: false };
            Recorder::push_all(&mut self.files, &moment)?;
        }
        self.files.into_iter().try_for_each(Recorder::finish)
    }
}

fn begin(path: &Path, plan: &Plan) -> Result<Recorder, Failure> {
    if is(path, "csv") {
        return Ok(Recorder::table(CsvWriter::create(path, plan.setting)?));
    }
    let film = film(path, plan.setting, plan.style, plan.rate, &["csv"])?;
    Ok(Recorder::film(film.still(plan.still)))
}

/// That no file is named twice.
///
/// # Errors
/// One is.
pub fn distinct(paths: &[PathBuf]) -> Result<(), Failure> {
    for (index, path) in paths.iter().enumerate() {
        if paths[..index].contains(path) {
            return Err(Failure::hint(format!("{} is given twice", path.display()), "leave one of the two out"));
        }
    }
    Ok(())
}

/// Whether a name has this ending, which files have and folders do not.
pub fn is(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(ending)) && !path.is_dir()
}

/// Begins a picture or a video; `others` are the endings of what else could have been written.
///
/// # Errors
/// The name does not say what to write, or the file cannot be begun.
pub fn film(path: &Path, sheet: impl Into<Sheet>, style: &Style, rate: f64, others: &[&str]) -> Result<Film, Failure> {
    let slash = path.as_os_str().as_encoded_bytes().last().is_some_and(|&byte| std::path::is_separator(byte.into()));
    if path.is_dir() && !slash {
        let text = format!("cannot write {}: it is a folder", path.display());
        return Err(Failure::hint(text, "end the name in / to write a PNG file for each picture into it"));
    }
    if let Err(throng_draw::Error::Extension { .. }) = Kind::of(path) {
        let text = format!("{}: cannot tell what to write from this name", path.display());
        let (last, others) = others.split_last().unwrap_or((&"csv", &[]));
        let others: String = others.iter().map(|other| format!(", .{other}")).collect();
        return Err(Failure::hint(
            text,
            format!(
                "end it in .mp4, .gif, .png, .svg{others} or .{last}, in another video's ending such as .avi, .mkv or \
                 .webm, or in / for a folder of PNG files"
            ),
        ));
    }
    Ok(Film::create(path, sheet, style, rate)?)
}

/// That a path names a single picture, which is all that `command` writes.
///
/// # Errors
/// It names something else.
pub fn one_picture(path: &Path, command: &str) -> Result<(), Failure> {
    if matches!(Kind::of(path), Ok(Kind::Png | Kind::Svg)) {
        return Ok(());
    }
    let text = format!("{}: `{command}` draws one picture", path.display());
    Err(Failure::hint(text, "end the name in .png or .svg; `throng run` writes everything else"))
}
