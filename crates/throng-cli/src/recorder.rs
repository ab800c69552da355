//! Films and tables that grow while the world goes on: another thread writes each.

use crate::failure::Failure;
use std::sync::Arc;
use throng_draw::Film;
use throng_record::csv::CsvWriter;
use throng_record::{Behind, Frame, OutputError};

/// A moment of all runs that are recorded together.
#[derive(Clone)]
pub struct Moment {
    /// One frame a run.
    pub frames: Vec<Arc<Frame>>,
    /// How many pictures are due.
    pub pictures: u64,
    /// Whether it is new to tables.
    pub rows: bool,
}

/// A file being written. Dropped before it is finished, it leaves nothing.
pub enum Recorder {
    /// A picture or a video.
    Film(Box<Behind<Film, Moment, throng_draw::Error>>),
    /// Trajectories.
    Table(Behind<CsvWriter, Moment, OutputError>),
}

impl Recorder {
    /// Lets a film be written.
    pub fn film(film: Film) -> Self {
        Self::Film(Box::new(Behind::start("throng-film", film, |film, moment| {
            let frames: Vec<&Frame> = moment.frames.iter().map(Arc::as_ref).collect();
            (0..moment.pictures).try_for_each(|_| film.push_all(&frames))
        })))
    }

    /// Lets a table be written.
    pub fn table(table: CsvWriter) -> Self {
        Self::Table(Behind::start("throng-table", table, |table, moment| {
            moment.frames.iter().try_for_each(|frame| table.push(frame))
        }))
    }

    /// Whether it takes every moment, not only those of pictures.
    pub fn is_table(&self) -> bool {
        matches!(self, Self::Table(_))
    }

    /// Hands over a moment to all of `recorders`.
    ///
    /// # Errors
    /// A file cannot be written. It may come out a few moments after the one that could not be written.
    pub fn push_all(recorders: &mut Vec<Self>, moment: &Moment) -> Result<(), Failure> {
        match recorders.iter_mut().position(|recorder| !recorder.push(moment)) {
            Some(failed) => recorders.swap_remove(failed).finish(),
            None => Ok(()),
        }
    }

    fn push(&mut self, moment: &Moment) -> bool {
        match self {
            Self::Film(film) => moment.pictures == 0 || film.push(moment.clone()),
            Self::Table(table) => !moment.rows || table.push(moment.clone()),
        }
    }

    /// Completes the file and gives it its name.
    ///
    /// # Errors
    /// It cannot be written or completed.
    pub fn finish(self) -> Result<(), Failure> {
        match self {
            Self::Film(film) => film.finish()?.finish()?,
            Self::Table(table) => table.finish()?.finish()?,
        }
        Ok(())
    }
}
