//! The runs of all models and seeds. Runs of the first seed step together where an output needs their moments; all
//! other runs start as threads become free.

use super::bounds::figure_name;
use super::contender::Contender;
use super::worker::WorkerModel;
use crate::failure::Failure;
use crate::interrupt;
use crate::progress::{Progress, share};
use crate::report::{figures, number};
use crate::source::Loaded;
use crate::threads::Workers;
use serde_json::{Map, Value, json};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;
use throng::World;
use throng_bench::clock::thread_time;
use throng_record::series::Series;
use throng_record::{Frame, Pool, moment};
use throng_scene::{Built, Time};

/// The models and seeds to compare.
pub struct ComparePlan {
    /// The scene; its seed is the first of `seeds`.
    pub loaded: Loaded,
    /// The models.
    pub models: Vec<Contender>,
    /// The seeds; at least one.
    pub seeds: Vec<u64>,
    /// Whether the figures over time of all runs are needed, and not only those that an output shows.
    pub all_series: bool,
}

/// The run of one model with one seed.
pub struct ModelRun {
    /// The index of the model in the plan.
    pub model: usize,
    /// The seed.
    pub seed: u64,
    /// The world in its current state.
    pub world: World,
    /// What was built from the scene.
    pub built: Built,
    /// The current moment, where an output needs it.
    pub frame: Arc<Frame>,
    frames: Pool<Frame>,
    /// The figures over time, where an output needs them.
    pub series: Series,
    time: Time,
    stepping: Duration,
    /// The model, if it is in Python.
    python: Option<Arc<WorkerModel>>,
}

/// The result of a run.
pub struct RunOutcome {
    /// The index of the model in the plan.
    pub model: usize,
    /// The seed.
    pub seed: u64,
    /// The figures by name: those of `throng run --json`, and some more.
    pub figures: Map<String, Value>,
    /// The figures over time, where an output or a bound needs them.
    pub series: Series,
    /// The least separation of two bodies in any sub-step.
    pub least_separation: f64,
    /// The least separation of a body and a wall in any sub-step.
    pub least_wall_separation: f64,
}

impl RunOutcome {
    /// Returns a figure by its name; NaN if it is unknown.
    pub fn figure(&self, name: &str) -> f64 {
        self.figures.get(name).and_then(Value::as_f64).unwrap_or(f64::NAN)
    }
}

impl ModelRun {
    fn build(plan: &ComparePlan, model: usize, seed: u64) -> Result<Self, Failure> {
        let contender = &plan.models[model];
        let mut loaded = plan.loaded.clone();
        loaded.scene.seed = seed;
        let (world, built, python) = contender.build(loaded).map_err(|failure| match failure {
            Failure::Error(text) => Failure::Error(format!("{contender} with seed {seed}: {text}")),
            other => other,
        })?;
        let time = plan.loaded.scene.time.clone();
        let (frame, frames, series) = (Arc::default(), Pool::default(), Series::default());
        Ok(Self { model, seed, world, built, frame, frames, series, time, stepping: Duration::ZERO, python })
    }

    /// Whether the run has ended.
    pub fn over(&self) -> bool {
        self.time.over(&self.world)
    }

    /// Makes a step.
    ///
    /// # Errors
    /// The model is in Python and has failed.
    fn step(&mut self) -> Result<(), Failure> {
        let begin = thread_time();
        self.world.step();
        self.stepping += thread_time().saturating_sub(begin);
        self.python.as_ref().map_or(Ok(()), |python| python.check(self.seed))
    }

    /// Captures the current moment.
    fn show(&mut self) {
        self.frame = self.frames.make(|frame| moment::capture(&self.world, frame));
        self.series.push(&self.frame);
    }

    fn outcome(self) -> RunOutcome {
        let summary = self.world.summary();
        let mut figures = figures(&summary, self.stepping);
        let rate = figures["agent_steps_per_second"].as_f64();
        figures.insert("us_per_agent_step".into(), json!(rate.map(|rate| 1e6 / rate)));
        figures.extend(self.world.figures().map(|(name, value)| (figure_name(name), number(value))));
        figures.insert("interrupted".into(), json!(!self.over()));
        RunOutcome {
            model: self.model,
            seed: self.seed,
            figures,
            series: self.series,
            least_separation: summary.least_separation,
            least_wall_separation: summary.least_wall_separation,
        }
    }
}

/// All runs, while they are being made.
pub struct Race<'a> {
    plan: &'a ComparePlan,
    workers: &'a Workers,
    leaders: Vec<ModelRun>,
    progress: Progress,
    /// The completed share of each run, in millionths; the runs of the first seed come first.
    done: Vec<AtomicU64>,
}

const WHOLE: f64 = 1e6;

impl<'a> Race<'a> {
    /// Builds the worlds of the first seed.
    ///
    /// # Errors
    /// A world cannot be built.
    pub fn start(plan: &'a ComparePlan, workers: &'a Workers, progress: Progress) -> Result<Self, Failure> {
        let models = (0..plan.models.len()).collect();
        let leaders: Result<Vec<ModelRun>, Failure> =
            workers.map(models, |model| ModelRun::build(plan, model, plan.seeds[0])).into_iter().collect();
        let mut leaders = leaders?;
        leaders.iter_mut().for_each(ModelRun::show);
        let done = (0..plan.models.len() * plan.seeds.len()).map(|_| AtomicU64::new(0)).collect();
        Ok(Self { plan, workers, leaders, progress, done })
    }

    /// Returns the runs of the first seed, in the order of the models.
    pub fn leaders(&self) -> &[ModelRun] {
        &self.leaders
    }

    /// Makes one step of the leaders that have not ended. Returns whether there were any.
    ///
    /// # Errors
    /// A model in Python has failed.
    pub fn step(&mut self) -> Result<bool, Failure> {
        let running: Vec<&mut ModelRun> = self.leaders.iter_mut().filter(|run| !run.over()).collect();
        if running.is_empty() || interrupt::asked() {
            return Ok(false);
        }
        let done = &self.done;
        let step = |run: &mut ModelRun| {
            run.step()?;
            run.show();
            note(&done[run.model], run);
            Ok(())
        };
        self.workers.map(running, step).into_iter().collect::<Result<(), Failure>>()?;
        self.show();
        Ok(true)
    }

    /// Completes all runs: the leaders that have not ended, and the runs of the other seeds.
    ///
    /// # Errors
    /// A world cannot be built, or a model in Python has failed.
    pub fn finish(mut self) -> Result<Vec<RunOutcome>, Failure> {
        let models = self.leaders.len();
        let leaders = std::mem::take(&mut self.leaders).into_iter().map(Some);
        let others = (models..self.done.len()).map(|_| None);
        let tasks = leaders.chain(others).enumerate().collect();
        let race = &self;
        let show = |run: &mut ModelRun| {
            if race.plan.all_series {
                run.show();
            }
        };
        let work = |(k, run): (usize, Option<ModelRun>)| {
            let mut run = match run {
                Some(run) => run,
                None if interrupt::asked() => return Ok(None),
                None => {
                    let mut run = ModelRun::build(race.plan, k % models, race.plan.seeds[k / models])?;
                    show(&mut run);
                    run
                }
            };
            while !run.over() && !interrupt::asked() {
                run.step()?;
                show(&mut run);
                note(&race.done[k], &run);
                race.show();
            }
            Ok(Some(run.outcome()))
        };
        let outcomes: Result<Vec<Option<RunOutcome>>, Failure> = self.workers.map(tasks, work).into_iter().collect();
        self.progress.done();
        Ok(outcomes?.into_iter().flatten().collect())
    }

    fn show(&self) {
        let parts = self.done.iter().map(|part| part.load(Ordering::Relaxed));
        let (sum, whole) =
            parts.fold((0, 0), |(sum, whole), part| (sum + part, whole + usize::from(part >= WHOLE as u64)));
        let count = self.done.len();
        self.progress.show(sum as f64 / WHOLE / count as f64, || format!("{whole} of {count} runs"));
    }
}

fn note(part: &AtomicU64, run: &ModelRun) {
    let share = if run.over() { 1.0 } else { 0.999 * share(&run.world, run.time.limit) };
    part.store((share * WHOLE) as u64, Ordering::Relaxed);
}
