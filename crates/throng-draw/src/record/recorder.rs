//! Films and trajectories of a running world, each written by its own thread.

use super::Plan;
use crate::sink::{GifSink, Kind};
use crate::{Error, Film};
use std::path::Path;
use std::sync::Arc;
use throng_record::{BackgroundWriter, Format, Frame, Output, OutputError, Writer};

/// A moment of all runs that are recorded together.
#[derive(Clone)]
pub struct Moment {
    /// One frame per run.
    pub frames: Vec<Arc<Frame>>,
    /// Whether a picture is due.
    pub picture: bool,
    /// Whether films follow this moment, with a picture or without.
    pub follow: bool,
    /// Whether trajectories take this moment.
    pub rows: bool,
}

/// A file being written. If it is dropped before it is finished, the file is deleted, unless its format is readable
/// when incomplete ([`Format::output`]).
pub struct Recorder {
    kind: Written,
    /// The index of the run it records; `None` for all runs.
    run: Option<usize>,
}

/// The kinds of files.
enum Written {
    /// A picture or a video.
    Film(Box<BackgroundWriter<Film, Moment, Error>>),
    /// Trajectories.
    Table(BackgroundWriter<Box<dyn Writer>, Moment, OutputError>),
}

impl Recorder {
    /// Creates the file `path` of one or several runs: trajectories of the first run if the name ends like a
    /// [`Format`], else a [`Film`].
    ///
    /// # Errors
    /// Those of [`Film::create`].
    pub fn create(path: impl AsRef<Path>, plan: &Plan) -> Result<Self, Error> {
        let path = path.as_ref();
        if let Some(format) = table(path) {
            let writer = plan.choice.create(format, format.output(path)?, plan.setting, plan.stop);
            let writer = writer.ok_or_else(|| Error::Extension { path: path.into() })??;
            return Ok(Self::table(writer).of_run(0));
        }
        Ok(Self::film(Film::create(path, plan.shown(), plan.style, plan.rate)?.still(plan.still)))
    }

    /// Creates a recorder that writes to an output outside the file system ([`Output::handed`]): trajectories or a GIF.
    ///
    /// # Errors
    /// The name of the output ends neither like trajectories nor in `.gif`, or the rate or the size is outside its
    /// limits.
    pub fn to(output: Output, plan: &Plan) -> Result<Self, Error> {
        let path = output.path().to_path_buf();
        if let Some(format) = table(&path) {
            let writer =
                plan.choice.create(format, output, plan.setting, plan.stop).ok_or(Error::Extension { path })??;
            return Ok(Self::table(writer).of_run(0));
        }
        match Kind::of(&path)? {
            Kind::Gif => {
                let sink = Box::new(GifSink::new(output, plan.rate)?);
                Ok(Self::film(Film::new(&path, sink, plan.shown(), plan.style)?))
            }
            _ => Err(Error::Extension { path }),
        }
    }

    /// Starts a recorder of a film.
    pub fn film(film: Film) -> Self {
        let film = BackgroundWriter::start("throng-film", film, |film: &mut Film, moment: Moment| {
            let frames: Vec<&Frame> = moment.frames.iter().map(Arc::as_ref).collect();
            if moment.picture { film.push_all(&frames) } else { film.follow_all(&frames) }
        });
        Self { kind: Written::Film(Box::new(film)), run: None }
    }

    /// Starts a recorder of trajectories.
    pub fn table(table: Box<dyn Writer>) -> Self {
        let table = BackgroundWriter::start("throng-table", table, |table: &mut Box<dyn Writer>, moment: Moment| {
            moment.frames.iter().try_for_each(|frame| table.push(frame))
        });
        Self { kind: Written::Table(table), run: None }
    }

    /// Returns the recorder restricted to one of several runs, by index.
    pub fn of_run(self, run: usize) -> Self {
        Self { run: Some(run), ..self }
    }

    /// Whether it takes every moment, not only those of pictures.
    pub fn is_table(&self) -> bool {
        matches!(self.kind, Written::Table(_))
    }

    /// Passes a moment to all of `recorders`.
    ///
    /// # Errors
    /// A file cannot be written. The error can appear a few moments later than its cause.
    pub fn push_all(recorders: &mut Vec<Self>, moment: &Moment) -> Result<(), Error> {
        match recorders.iter_mut().position(|recorder| !recorder.push(moment)) {
            Some(failed) => recorders.swap_remove(failed).finish(),
            None => Ok(()),
        }
    }

    fn push(&mut self, moment: &Moment) -> bool {
        let own = || match self.run.and_then(|run| moment.frames.get(run)) {
            Some(frame) => Moment { frames: vec![frame.clone()], ..*moment },
            None => moment.clone(),
        };
        match &mut self.kind {
            Written::Film(film) => !moment.follow || film.push(own()),
            Written::Table(table) => !moment.rows || table.push(own()),
        }
    }

    /// Completes the file and renames it to its final name.
    ///
    /// # Errors
    /// The file cannot be written or completed.
    pub fn finish(self) -> Result<(), Error> {
        match self.kind {
            Written::Film(film) => film.finish()?.finish()?,
            Written::Table(table) => table.finish()?.finish()?,
        }
        Ok(())
    }
}

/// Returns the trajectory format of a name; `None` for other names and for folders.
fn table(path: &Path) -> Option<&'static Format> {
    Format::of(path).filter(|format| format.is_written() && !path.is_dir())
}
