//! The output files of a comparison.

use super::figures::CompareResults;
use super::html::ComparePage;
use super::race::{ComparePlan, ModelRun};
use super::telling::TellingPicture;
use super::{CompareArgs, sheet, table};
use crate::failure::Failure;
use crate::files::{self, distinct, is};
use std::path::PathBuf;
use std::sync::Arc;
use throng_draw::Still;
use throng_draw::record::{Files, Pace, Recorder};
use throng_draw::sink::Kind;
use throng_record::{Choice, Frame, Output};

/// A function that formats the table for a file.
type TableFormat = fn(&ComparePlan, &CompareResults, bool) -> String;

/// The output files. They get their names when they are complete; files dropped before that are deleted.
pub struct CompareOutputs {
    paths: Vec<PathBuf>,
    /// Pictures and videos; `None` once they are complete.
    films: Option<Files>,
    /// Pictures of the moment at which the models differ most.
    telling: Vec<TellingPicture>,
    pages: Vec<(Output, ComparePage)>,
    /// Files that hold the table, and the functions that format it.
    tables: Vec<(Output, TableFormat)>,
}

impl CompareOutputs {
    /// Creates all files.
    ///
    /// # Errors
    /// The kind of a file does not follow from its name, a name is given twice, or a file cannot be created.
    pub fn create(args: &CompareArgs, plan: &ComparePlan, runs: &[ModelRun]) -> Result<Self, Failure> {
        let paths = args.output.clone();
        distinct(&paths)?;
        let (mut films, mut pages, mut telling) = (Vec::new(), Vec::new(), Vec::new());
        let mut tables: Vec<(Output, TableFormat)> = Vec::new();
        let rate = args.film.rate(&plan.loaded.scene);
        for path in &paths {
            if is(path, "html") || is(path, "htm") {
                pages.push((Output::create(path)?, ComparePage::new(&args.film, plan, runs)?));
            } else if is(path, "csv") {
                tables.push((Output::create(path)?, |_, results, _| table::csv(results)));
            } else if is(path, "md") {
                tables.push((Output::create(path)?, table::markdown));
            } else {
                let (sheet, style) = sheet::sheet(&args.film, plan, runs)?;
                let film = files::film(path, sheet, &style, rate, &["html", "md", "csv"])?;
                let given = args.film.frame.or(plan.loaded.scene.view.moment);
                match given {
                    None if matches!(Kind::of(path), Ok(Kind::Png | Kind::Svg)) => {
                        telling.push(TellingPicture::new(film, style.trails, runs)?);
                    }
                    _ => films.push(Recorder::film(film.still(given.map_or(Still::Last, Still::Time)))),
                }
            }
        }
        let films = Files::new(films, Pace::new(0.0, args.film.speed_up / rate), &Choice::default());
        Ok(Self { paths, films: Some(films), telling, pages, tables })
    }

    /// Whether the outputs need the moments of the runs, not only their results.
    pub fn watch(&self) -> bool {
        let films = self.films.as_ref().is_some_and(|films| !films.is_empty());
        films || !self.telling.is_empty() || !self.pages.is_empty()
    }

    /// Adds the runs' current moment. Called before the first step and after every step.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn push(&mut self, runs: &[ModelRun]) -> Result<(), Failure> {
        if let Some(films) = &mut self.films {
            films.push_all(now(runs), runs[0].world.settings().step, || frames(runs))?;
        }
        self.telling.iter_mut().for_each(|picture| picture.push(runs));
        self.pages.iter_mut().for_each(|(_, page)| page.push(runs));
        Ok(())
    }

    /// Adds the last moment if no picture shows it yet, and completes pictures and videos.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn end(&mut self, runs: &[ModelRun]) -> Result<(), Failure> {
        self.pages.iter_mut().for_each(|(_, page)| page.end(runs));
        std::mem::take(&mut self.telling).into_iter().try_for_each(TellingPicture::finish)?;
        Ok(self.films.take().map_or(Ok(()), |films| films.finish_all(now(runs), || frames(runs)))?)
    }

    /// Completes all other files and returns the names of all files.
    ///
    /// # Errors
    /// A file cannot be completed.
    pub fn finish(self, plan: &ComparePlan, results: &CompareResults, all: bool) -> Result<Vec<PathBuf>, Failure> {
        let pages = self.pages.into_iter().map(|(output, page)| (output, page.text(plan, results, all)));
        let tables = self.tables.into_iter().map(|(output, write)| (output, write(plan, results, all)));
        for (mut output, text) in pages.chain(tables) {
            output.put(text.as_bytes())?;
            output.finish()?;
        }
        Ok(self.paths)
    }
}

fn frames(runs: &[ModelRun]) -> Vec<Arc<Frame>> {
    runs.iter().map(|run| run.frame.clone()).collect()
}

/// Returns the time of the run that is farthest ahead.
fn now(runs: &[ModelRun]) -> f64 {
    runs.iter().map(|run| run.world.time()).fold(0.0, f64::max)
}
