//! `throng validate families`: random variants of scenes, and the conditions that hold in all of them.

use super::args::ValidateArgs;
use crate::columns::aligned;
use crate::failure::Failure;
use crate::interrupt;
use crate::out::{Out, complain};
use crate::progress::Progress;
use crate::threads::Workers;
use serde_json::{Value, json};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;
use throng_record::Output;
use throng_record::validate::families::{FAMILIES, Trial, TrialFlaw};
use throng_scene::{Model, Scene};

/// The name of the families among the names of experiments.
pub const NAME: &str = "families";

/// The outcome of a trial: the violated conditions, or the error if its scene cannot be built.
struct TrialOutcome {
    trial: Trial,
    flaws: Vec<TrialFlaw>,
    error: Option<String>,
}

impl TrialOutcome {
    fn failed(&self) -> bool {
        !self.flaws.is_empty() || self.error.is_some()
    }

    fn words(&self) -> String {
        let flaws = self.flaws.iter().map(ToString::to_string);
        let error = self.error.iter().map(|error| error.lines().next().unwrap_or_default().to_owned());
        flaws.chain(error).collect::<Vec<_>>().join(", ")
    }
}

/// Runs trials and writes the failures by family. With `--keep`, also writes the scenes of failed trials.
///
/// # Errors
/// The model or a key does not exist, a file cannot be written, the program was interrupted, or a trial failed.
pub fn families(args: &ValidateArgs, out: &mut Out) -> Result<(), Failure> {
    let begin = Instant::now();
    let model = args.model()?;
    let (seed, indices) = (args.seed, args.trial.map_or(0..args.runs, |trial| trial..trial + 1));
    let trials: Vec<Trial> = indices.map(|index| Trial::new(seed, index)).collect();
    interrupt::watch();
    let count = trials.len();
    let workers = Workers::new(args.threads.count(), count)?;
    let (progress, done) = (Progress::new(args.report.quiet), AtomicU64::new(0));
    let outcomes = workers.map(trials, |trial| {
        let outcome = run(args, model.as_ref(), trial);
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress.show(done as f64 / count as f64, || format!("{done} of {count} runs"));
        outcome
    });
    progress.done();
    let outcomes: Vec<TrialOutcome> =
        outcomes.into_iter().filter_map(Result::transpose).collect::<Result<_, Failure>>()?;
    if let Some(folder) = &args.keep {
        keep(&outcomes, args.trial.is_some(), folder)?;
    }
    if args.report.json {
        out.line(format_args!("{:#}", as_json(args, &outcomes, begin)))?;
    } else if !args.report.quiet {
        out.text(text(seed, &outcomes).as_bytes())?;
    }
    out.flush()?;
    if interrupt::asked() {
        if !args.report.quiet {
            complain("interrupted; the counts are those of the runs that were complete");
        }
        return Err(Failure::Interrupted);
    }
    if outcomes.iter().any(TrialOutcome::failed) { Err(Failure::Expectation) } else { Ok(()) }
}

/// Runs a trial; returns `None` if it was interrupted.
fn run(args: &ValidateArgs, model: Option<&Model>, trial: Trial) -> Result<Option<TrialOutcome>, Failure> {
    if interrupt::asked() {
        return Ok(None);
    }
    let scene = scene(args, model, &trial)?;
    let outcome = match Trial::check(&scene, |_| !interrupt::asked()) {
        Ok(None) => return Ok(None),
        Ok(Some(flaws)) => TrialOutcome { trial, flaws, error: None },
        Err(error) => TrialOutcome { trial, flaws: vec![], error: Some(error.to_string()) },
    };
    Ok(Some(outcome))
}

/// Returns the scene of a trial with the given model and changes.
fn scene(args: &ValidateArgs, model: Option<&Model>, trial: &Trial) -> Result<Scene, Failure> {
    let mut scene = trial.scene()?;
    for (key, value) in &args.set {
        scene.set(key, value)?;
    }
    Ok(match model {
        Some(model) => scene.with_model(model)?,
        None => scene,
    })
}

/// Writes the scenes of failed trials, or of all trials.
fn keep(outcomes: &[TrialOutcome], all: bool, folder: &Path) -> Result<(), Failure> {
    super::make_folder(folder)?;
    for outcome in outcomes.iter().filter(|outcome| all || outcome.failed()) {
        let mut output = Output::create(folder.join(format!("{}.toml", outcome.trial.name())))?;
        output.put(outcome.trial.text.as_bytes())?;
        output.finish()?;
    }
    Ok(())
}

/// Returns the number of trials of a family, of failed trials, and of trials with each kind of flaw.
fn counts(family: usize, outcomes: &[TrialOutcome]) -> Vec<usize> {
    let of_family: Vec<&TrialOutcome> = outcomes.iter().filter(|outcome| outcome.trial.family == family).collect();
    let failed = of_family.iter().filter(|outcome| outcome.failed()).count();
    let kind = |kind| of_family.iter().filter(|outcome| outcome.flaws.iter().any(|flaw| flaw.kind() == kind)).count();
    [of_family.len(), failed].into_iter().chain((0..TrialFlaw::KINDS.len()).map(kind)).collect()
}

fn text(seed: u64, outcomes: &[TrialOutcome]) -> String {
    let heads = ["family", "runs", "failed"].iter().chain(&TrialFlaw::KINDS).map(ToString::to_string).collect();
    let row = |(k, family): (usize, &throng_record::validate::families::Family)| {
        let counts = counts(k, outcomes);
        std::iter::once(family.name.to_owned()).chain(counts.iter().map(ToString::to_string)).collect::<Vec<_>>()
    };
    let lines: Vec<Vec<String>> = std::iter::once(heads).chain(FAMILIES.iter().enumerate().map(row)).collect();
    let mut out = aligned(&lines);
    let failed: Vec<&TrialOutcome> = outcomes.iter().filter(|outcome| outcome.failed()).collect();
    out.push_str(&format!("\n{} of {} runs failed; seed {seed}\n", failed.len(), outcomes.len()));
    for outcome in &failed {
        out.push_str(&format!("  {}: {}\n", outcome.trial.name(), outcome.words()));
    }
    if let Some(first) = failed.first() {
        let index = first.trial.index;
        out.push_str(&format!(
            "The number in a name is its --trial: throng validate {NAME} --seed {seed} --trial {index} --keep FOLDER\n"
        ));
    }
    out
}

fn as_json(args: &ValidateArgs, outcomes: &[TrialOutcome], begin: Instant) -> Value {
    let family = |(k, family): (usize, &throng_record::validate::families::Family)| {
        let counts = counts(k, outcomes);
        let kinds: serde_json::Map<String, Value> =
            TrialFlaw::KINDS.iter().zip(&counts[2..]).map(|(kind, count)| ((*kind).to_owned(), json!(count))).collect();
        json!({ "name": family.name, "runs": counts[0], "failed": counts[1], "flaws": kinds })
    };
    let failed = |outcome: &TrialOutcome| json!({ "trial": outcome.trial.index, "name": outcome.trial.name(), "flaws": outcome.words() });
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "model": args.model,
        "seed": args.seed,
        "runs": outcomes.len(),
        "families": FAMILIES.iter().enumerate().map(family).collect::<Vec<_>>(),
        "failed": outcomes.iter().filter(|outcome| outcome.failed()).map(failed).collect::<Vec<_>>(),
        "wall_seconds": begin.elapsed().as_secs_f64(),
        "interrupted": interrupt::asked(),
    })
}
