//! The files of a comparison.

use super::figures::Results;
use super::html::Page;
use super::race::{Plan, Run};
use super::{CompareArgs, sheet, table};
use crate::failure::Failure;
use crate::files::{self, distinct, is};
use std::path::PathBuf;
use std::sync::Arc;
use throng_draw::record::{Files, Pace, Recorder};
use throng_record::{Choice, Frame, Output};

/// A way to write the table.
type Written = fn(&Plan, &Results, bool) -> String;

/// All files. They get their names when they are complete; dropped before that, they leave nothing.
pub struct Outputs {
    paths: Vec<PathBuf>,
    /// Pictures and video; `None` once they are complete.
    films: Option<Files>,
    pages: Vec<(Output, Page)>,
    /// Files that hold the table, and how it is written.
    tables: Vec<(Output, Written)>,
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
        let films = Files::new(films, Pace::new(0.0, args.film.speed_up / rate), &Choice::default());
        Ok(Self { paths, films: Some(films), pages, tables })
    }

    /// Whether the runs' moments are wanted, or only what comes of them.
    pub fn watch(&self) -> bool {
        self.films.as_ref().is_some_and(|films| !films.is_empty()) || !self.pages.is_empty()
    }

    /// Takes in the runs as they are after a step (and before the first).
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn push(&mut self, runs: &[Run]) -> Result<(), Failure> {
        if let Some(films) = &mut self.films {
            films.push_all(now(runs), runs[0].world.settings().step, || frames(runs))?;
        }
        self.pages.iter_mut().for_each(|(_, page)| page.push(runs));
        Ok(())
    }

    /// Shows the end, if no picture did yet, and completes pictures and video.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn end(&mut self, runs: &[Run]) -> Result<(), Failure> {
        self.pages.iter_mut().for_each(|(_, page)| page.end(runs));
        Ok(self.films.take().map_or(Ok(()), |films| films.finish_all(now(runs), || frames(runs)))?)
    }

    /// Completes all other files; the names of all.
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
        Ok(self.paths)
    }
}

fn frames(runs: &[Run]) -> Vec<Arc<Frame>> {
    runs.iter().map(|run| run.frame.clone()).collect()
}

/// The time of the run that is farthest.
fn now(runs: &[Run]) -> f64 {
    runs.iter().map(|run| run.world.time()).fold(0.0, f64::max)
}
