//! Films and tables that grow while the world goes on: another thread writes each.

use super::Plan;
use crate::sink::{GifSink, Kind};
use crate::{Error, Film};
use std::path::Path;
use std::sync::Arc;
use throng_record::{Behind, Format, Frame, Output, OutputError, Writer};

/// A moment of all runs that are recorded together.
#[derive(Clone)]
pub struct Moment {
    /// One frame a run.
    pub frames: Vec<Arc<Frame>>,
    /// Whether a picture is due.
    pub picture: bool,
    /// Whether it is new to tables.
    pub rows: bool,
}

/// A file being written. Dropped before it is finished, it leaves nothing, or what can be read ([`Format::output`]).
pub struct Recorder {
    kind: Written,
    /// Which of the runs of a moment it takes; none: all of them.
    run: Option<usize>,
}

/// What is written.
enum Written {
    /// A picture or a video.
    Film(Box<Behind<Film, Moment, Error>>),
    /// Trajectories.
    Table(Behind<Box<dyn Writer>, Moment, OutputError>),
}

impl Recorder {
    /// Begins the file `path` of a run, or of several: trajectories of the first where its name says so ([`Format`]), else what a [`Film`] makes of the name.
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

    /// Begins a file of a run that goes somewhere else than to a folder ([`Output::handed`]): trajectories or a GIF.
    ///
    /// # Errors
    /// The name of the output is neither that of trajectories nor ends in `.gif`, or rate or size are out of their limits.
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

    /// Lets a film be written.
    pub fn film(film: Film) -> Self {
        let film = Behind::start("throng-film", film, |film: &mut Film, moment: Moment| {
            let frames: Vec<&Frame> = moment.frames.iter().map(Arc::as_ref).collect();
            film.push_all(&frames)
        });
        Self { kind: Written::Film(Box::new(film)), run: None }
    }

    /// Lets a table be written.
    pub fn table(table: Box<dyn Writer>) -> Self {
        let table = Behind::start("throng-table", table, |table: &mut Box<dyn Writer>, moment: Moment| {
            moment.frames.iter().try_for_each(|frame| table.push(frame))
        });
        Self { kind: Written::Table(table), run: None }
    }

    /// The same, of one of several runs that go on together, by its place among them.
    pub fn of_run(self, run: usize) -> Self {
        Self { run: Some(run), ..self }
    }

    /// Whether it takes every moment, not only those of pictures.
    pub fn is_table(&self) -> bool {
        matches!(self.kind, Written::Table(_))
    }

    /// Hands over a moment to all of `recorders`.
    ///
    /// # Errors
    /// A file cannot be written. It may come out a few moments after the one that could not be written.
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
            Written::Film(film) => !moment.picture || film.push(own()),
            Written::Table(table) => !moment.rows || table.push(own()),
        }
    }

    /// Completes the file and gives it its name.
    ///
    /// # Errors
    /// It cannot be written or completed.
    pub fn finish(self) -> Result<(), Error> {
        match self.kind {
            Written::Film(film) => film.finish()?.finish()?,
            Written::Table(table) => table.finish()?.finish()?,
        }
        Ok(())
    }
}

/// What trajectories a name is of; folders may be called anything.
fn table(path: &Path) -> Option<&'static Format> {
    Format::of(path).filter(|format| format.is_written() && !path.is_dir())
}
