//! Runs every case of every experiment with every seed.

use super::results::{Validated, ValidationRow};
use crate::failure::Failure;
use crate::interrupt;
use crate::progress::{Progress, share};
use crate::threads::Workers;
use std::sync::atomic::{AtomicU64, Ordering};
use throng_record::validate::{Case, Experiment, Figure, Run};
use throng_scene::{Model, Scene};

/// The runs to make.
pub struct ValidatePlan {
    /// The experiments with their cases.
    pub experiments: Vec<(&'static Experiment, Vec<Case>)>,
    /// The model that replaces the default.
    pub model: Option<Model>,
    /// Changes to every scene.
    pub set: Vec<(String, String)>,
    /// The seeds; at least one.
    pub seeds: Vec<u64>,
}

/// One run.
#[derive(Clone, Copy)]
struct Task<'p> {
    experiment: &'static Experiment,
    case: &'p Case,
    seed: u64,
    index: usize,
}

/// A completed run, in millionths.
const WHOLE: f64 = 1e6;

impl ValidatePlan {
    /// Returns the scene of a case, with the model and the changes.
    ///
    /// # Errors
    /// The scene has no such key, or the model cannot replace the scene's.
    pub fn scene(&self, experiment: &Experiment, case: &Case, seed: u64) -> Result<Scene, Failure> {
        let place = |mut error: throng_scene::Error| {
            error.file = Some(format!("{} {}", experiment.name, case.name).into());
            Failure::from(error)
        };
        let mut scene = case.scene(seed).map_err(place)?;
        for (key, value) in &self.set {
            scene.set(key, value).map_err(place)?;
        }
        match &self.model {
            Some(model) => scene.with_model(model).map_err(place),
            None => Ok(scene),
        }
    }

    /// Makes all runs. Leaves out cases that were not completed with every seed.
    ///
    /// # Errors
    /// A scene cannot be built.
    pub fn run(&self, workers: &Workers, progress: &Progress) -> Result<Vec<Validated>, Failure> {
        let cases =
            self.experiments.iter().flat_map(|(experiment, cases)| cases.iter().map(move |case| (*experiment, case)));
        let tasks = cases.flat_map(|(experiment, case)| self.seeds.iter().map(move |&seed| (experiment, case, seed)));
        let tasks: Vec<Task> =
            tasks.enumerate().map(|(index, (experiment, case, seed))| Task { experiment, case, seed, index }).collect();
        let done: Vec<AtomicU64> = tasks.iter().map(|_| AtomicU64::new(0)).collect();
        let values = workers.map(tasks, |task| self.one(task, &done, progress));
        progress.done();
        let values: Vec<Option<Vec<f64>>> = values.into_iter().collect::<Result<_, Failure>>()?;
        let mut values = values.chunks(self.seeds.len());
        let validated = |(experiment, cases): &(&'static Experiment, Vec<Case>)| {
            let of_cases: Vec<&[Option<Vec<f64>>]> = values.by_ref().take(cases.len()).collect();
            Validated { experiment, rows: rows(experiment, cases, &of_cases) }
        };
        Ok(self.experiments.iter().map(validated).filter(|validated| !validated.rows.is_empty()).collect())
    }

    /// Returns the values of one run; `None` if it was interrupted.
    fn one(&self, task: Task, done: &[AtomicU64], progress: &Progress) -> Result<Option<Vec<f64>>, Failure> {
        if interrupt::asked() {
            return Ok(None);
        }
        let Task { experiment, case, seed, index } = task;
        let scene = self.scene(experiment, case, seed)?;
        let limit = scene.time.limit;
        let goes_on = |world: &throng::World| {
            if world.steps().is_multiple_of(25) {
                done[index].store((0.999 * share(world, limit) * WHOLE) as u64, Ordering::Relaxed);
                let parts = done.iter().map(|part| part.load(Ordering::Relaxed));
                let sum: u64 = parts.sum();
                progress.show(sum as f64 / WHOLE / done.len() as f64, || {
                    format!("{} {}, seed {seed}", experiment.name, case.name)
                });
            }
            !interrupt::asked()
        };
        let run = Run::of(&scene, case.interval, goes_on).map_err(|mut error| {
            error.file = Some(format!("{} {}, seed {seed}", experiment.name, case.name).into());
            Failure::from(error)
        })?;
        done[index].store(WHOLE as u64, Ordering::Relaxed);
        Ok(run.map(|run| case.measure(&run)))
    }
}

/// Returns the rows of an experiment from the values of its cases by seed.
fn rows(experiment: &Experiment, cases: &[Case], values: &[&[Option<Vec<f64>>]]) -> Vec<ValidationRow> {
    let mut rows = Vec::new();
    let mut add = |case: &str, figures: Vec<Figure>, values: Vec<Vec<f64>>| {
        for (k, figure) in figures.into_iter().enumerate() {
            let values = values.iter().map(|values| values.get(k).copied().unwrap_or(f64::NAN)).collect();
            let before = experiment.before(case, figure.name);
            rows.push(ValidationRow { case: case.to_owned(), figure, before, values });
        }
    };
    let complete: Vec<Option<Vec<Vec<f64>>>> = values.iter().map(|of_case| of_case.iter().cloned().collect()).collect();
    for (case, values) in cases.iter().zip(&complete) {
        if let Some(values) = values {
            add(&case.name, case.figures.clone(), values.clone());
        }
    }
    let seeds = values.first().map_or(0, |of_case| of_case.len());
    if let Some(overall) = &experiment.overall {
        // Cases that did not run have no values.
        let all = experiment.cases();
        let ran =
            |case: &Case| cases.iter().position(|other| other.name == case.name).and_then(|at| complete[at].as_ref());
        let of_case = |case: &Case, seed: usize| ran(case).map_or(Vec::new(), |values| values[seed].clone());
        let of_seed = |seed: usize| overall.measure(&all.iter().map(|case| of_case(case, seed)).collect::<Vec<_>>());
        add("all", overall.figures(), (0..seeds).map(of_seed).collect());
        if all.iter().any(|case| ran(case).is_none()) {
            // Figures that need a case that did not run are left out.
            rows.retain(|row| row.case != "all" || row.mean().is_finite());
        }
    }
    rows
}
