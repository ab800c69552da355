//! The files of a comparison.

use super::figures::Results;
use super::html::Page;
use super::race::{Plan, Run};
use super::{CompareArgs, sheet, table};
use crate::failure::Failure;
use crate::files::{self, distinct, is};
use std::path::PathBuf;
use throng_draw::record::{Moment, Pace, Recorder};
use throng_record::Output;

/// A way to write the table.
type Written = fn(&Plan, &Results, bool) -> String;

/// All files. They get their names when they are complete; dropped before that, they leave nothing.
pub struct Outputs {
    paths: Vec<PathBuf>,
    films: Vec<Recorder>,
    pages: Vec<(Output, Page)>,
    /// Files that hold the table, and how it is written.
    tables: Vec<(Output, Written)>,
    pace: Pace,
    /// Time of the last picture.
    last: Option<f64>,
}

impl Outputs {
    /// Begins all files.
    ///
    /// # Errors
    /// A name does not say what to write or comes twice, or a file cannot be begun.
    pub fn create(args: &CompareArgs, plan: &Plan, runs: &[Run]) -> Result<Self, Failure> {
        let paths = args.output.clone();
        distinct(&paths)?;
        let (mut films, mut pages) = (Vec::new(), Vec::new());
        let mut tables: Vec<(Output, Written)> = Vec::new();
        let rate = args.film.rate(&plan.loaded.scene);
        for path in &paths {
            if is(path, "html") || is(path, "htm") {
                pages.push((Output::create(path)?, Page::new(&args.film, plan, runs)?));
            } else if is(path, "csv") {
                tables.push((Output::create(path)?, |_, results, _| table::csv(results)));
            } else if is(path, "md") {
                tables.push((Output::create(path)?, table::markdown));
            } else {
                let (sheet, style) = sheet::sheet(&args.film, plan, runs)?;
                let film = files::film(path, sheet, &style, rate, &["html", "md", "csv"])?;
                films.push(Recorder::film(film.still(args.film.still())));
            }
        }
        Ok(Self { paths, films, pages, tables, pace: Pace::new(0.0, args.film.speed_up / rate), last: None })
    }

    /// Whether the runs' moments are wanted, or only what comes of them.
    pub fn watch(&self) -> bool {
        !(self.films.is_empty() && self.pages.is_empty())
    }

    /// Takes in the runs as they are after a step (and before the first).
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn push(&mut self, runs: &[Run]) -> Result<(), Failure> {
        let (time, step) = (now(runs), runs[0].world.settings().step);
        let due = self.pace.due(time, step);
        if due > 0 {
            self.show(runs, time, due)?;
        }
        self.pages.iter_mut().for_each(|(_, page)| page.push(runs));
        Ok(())
    }

    /// Shows the end, if no picture did yet.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn end(&mut self, runs: &[Run]) -> Result<(), Failure> {
        let time = now(runs);
        if self.last != Some(time) {
            self.show(runs, time, 1)?;
        }
        self.pages.iter_mut().for_each(|(_, page)| page.end(runs));
        Ok(())
    }

    fn show(&mut self, runs: &[Run], time: f64, pictures: u64) -> Result<(), Failure> {
        let frames = runs.iter().map(|run| run.frame.clone()).collect();
        self.last = Some(time);
        Ok(Recorder::push_all(&mut self.films, &Moment { frames, pictures, rows: false })?)
    }

    /// Completes all files; their names.
    ///
    /// # Errors
    /// A file cannot be completed.
    pub fn finish(self, plan: &Plan, results: &Results, all: bool) -> Result<Vec<PathBuf>, Failure> {
        let pages = self.pages.into_iter().map(|(output, page)| (output, page.text(plan, results, all)));
        let tables = self.tables.into_iter().map(|(output, write)| (output, write(plan, results, all)));
        for (mut output, text) in pages.chain(tables) {
            output.put(text.as_bytes())?;
            output.finish()?;
        }
        self.films.into_iter().try_for_each(Recorder::finish)?;
        Ok(self.paths)
    }
}

/// The time of the run that is farthest.
fn now(runs: &[Run]) -> f64 {
    runs.iter().map(|run| run.world.time()).fold(0.0, f64::max)
}
