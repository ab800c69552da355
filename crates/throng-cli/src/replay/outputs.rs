//! The output files of a replay: pictures of the recording and every model, trajectories of the agents, pages.

use super::page::ReplayPage;
use super::report::ReplayReport;
use super::setup::Setup;
use super::stage;
use crate::failure::Failure;
use crate::files::{self, distinct, is, title, written};
use crate::interrupt;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use throng_draw::Sheet;
use throng_draw::record::{Files, Plan, Recorder};
use throng_record::pedestrian::replay::{Replay, Seen};
use throng_record::{Choice, Format, Frame, Output, Pool};

/// The output files. They get their names when they are complete; files dropped before that are deleted.
pub struct ReplayOutputs<'a> {
    setup: &'a Setup<'a>,
    files: Files,
    pages: Option<Pages>,
    frames: Pool<Frame>,
    seen: Seen<'a>,
}

/// The pages under construction.
pub struct Pages {
    outputs: Vec<Output>,
    page: ReplayPage,
}

/// Returns the names of all output files.
pub fn paths(setup: &Setup) -> Vec<PathBuf> {
    let models = 0..setup.models.len();
    let of_each = |path: &PathBuf| match is_table(path) {
        true => models.clone().map(|model| of_model(path, setup, model)).collect(),
        false => vec![path.clone()],
    };
    setup.args.output.iter().flat_map(of_each).collect()
}

/// Returns the name of the trajectory file of one of the models.
fn of_model(path: &Path, setup: &Setup, model: usize) -> PathBuf {
    if setup.models.len() == 1 {
        return path.to_path_buf();
    }
    // Names of files keep only characters that all systems allow.
    let plain = |c: char| if c.is_alphanumeric() || "._=-".contains(c) { c } else { '-' };
    let name: String = setup.models[model].chars().map(plain).collect();
    let [stem, ending] = [path.file_stem(), path.extension()].map(|part| part.unwrap_or_default().to_string_lossy());
    path.with_file_name(format!("{stem}-{name}.{ending}"))
}

fn is_table(path: &Path) -> bool {
    !path.is_dir() && Format::of(path).is_some_and(|format| format.is_written())
}

impl<'a> ReplayOutputs<'a> {
    /// Creates all files.
    ///
    /// # Errors
    /// The kind of a file does not follow from its name, a name is given twice, or a file cannot be created.
    pub fn create(setup: &'a Setup<'a>) -> Result<Self, Failure> {
        let Setup { args, models, scene, cast, .. } = setup;
        distinct(&paths(setup))?;
        let panel = stage::style(args, scene, cast)?;
        let name = title(&args.data);
        let (rate, still, speed_up) = (args.film.rate(scene), args.film.still(), args.film.speed_up);
        let (alone, choice, [start, _]) = (setup.setting(&name), Choice::default(), setup.span());
        let plan = Plan {
            setting: &alone,
            sheet: None,
            style: &panel,
            rate,
            speed_up,
            still,
            from: start,
            choice: &choice,
            stop: interrupt::asked,
        };
        let (mut files, mut pages) = (Vec::new(), Vec::new());
        for path in &args.output {
            if is_table(path) {
                for model in 0..models.len() {
                    files.push(Recorder::create(of_model(path, setup, model), &plan)?.of_run(model + 1));
                }
            } else if is(path, "html") || is(path, "htm") {
                pages.push(Output::create(path)?);
            } else {
                let panels = std::iter::once("recorded").chain(models.iter().map(String::as_str));
                let panels: Vec<_> = panels.map(|title| setup.setting(title)).collect();
                let (count, bounds) = (panels.len(), stage::bounds(cast));
                let (style, columns) = args.film.look.side_by_side(panel.clone(), count, "panels", bounds)?;
                let sheet = Sheet { title: name.clone(), panels, columns };
                let others: Vec<&str> = ["html"].into_iter().chain(written()).collect();
                files.push(Recorder::film(files::film(path, sheet, &style, rate, &others)?.still(still)));
            }
        }
        let pages = (!pages.is_empty()).then(|| Pages { outputs: pages, page: ReplayPage::new(setup, &panel) });
        let files = Files::new(files, plan.pace(), &choice).stopped_by(plan.stop);
        Ok(Self { files, pages, frames: Pool::default(), seen: Seen::new(cast), setup })
    }

    /// Adds the replays' current moment. Called before the first step and after every step.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn push(&mut self, replays: &[Replay]) -> Result<(), Failure> {
        if self.files.is_empty() && self.pages.is_none() {
            return Ok(());
        }
        let (time, step) = (replays[0].time(), replays[0].world().settings().step);
        let frames = self.capture(replays);
        if let Some(pages) = &mut self.pages {
            pages.page.push(self.setup, replays[0].world().steps(), &frames);
        }
        Ok(self.files.push_all(time, step, || frames)?)
    }

    /// Returns the frames of the recording and of every model, with bodies coloured by class.
    fn capture(&mut self, replays: &[Replay]) -> Vec<Arc<Frame>> {
        let Self { frames, seen, setup, .. } = self;
        let mut make = |capture: &dyn Fn(&mut Frame)| {
            frames.make(|frame| {
                capture(frame);
                frame.bodies.iter_mut().for_each(|body| body.group = setup.kinds.find(&setup.cast, body.number));
            })
        };
        let recorded = make(&|frame| seen.capture(replays[0].time(), frame));
        std::iter::once(recorded).chain(replays.iter().map(|replay| make(&|frame| replay.capture(frame)))).collect()
    }

    /// Adds the last moment if no picture shows it yet, and completes all files except the pages.
    ///
    /// # Errors
    /// A file cannot be completed.
    pub fn finish(mut self, replays: &[Replay]) -> Result<Option<Pages>, Failure> {
        let frames = self.capture(replays);
        if let Some(pages) = &mut self.pages {
            pages.page.end(self.setup, &frames);
        }
        self.files.finish_all(replays[0].time(), || frames)?;
        Ok(self.pages)
    }
}

impl Pages {
    /// Completes the pages.
    ///
    /// # Errors
    /// A page cannot be written.
    pub fn write(self, report: &ReplayReport) -> Result<(), Failure> {
        let text = self.page.text(report);
        for mut output in self.outputs {
            output.put(text.as_bytes())?;
            output.finish()?;
        }
        Ok(())
    }
}
