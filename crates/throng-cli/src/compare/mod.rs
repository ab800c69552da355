//! `throng compare`: a scene with several local models, side by side.

mod args;
mod figures;
mod html;
mod outputs;
mod race;
mod sheet;
mod table;

pub use args::{COMPARE, COMPARE_SHORT, CompareArgs};

use crate::failure::Failure;
use crate::interrupt;
use crate::out::{Out, complain, note};
use crate::progress::{Progress, waiting};
use crate::source::Loaded;
use crate::threads::Workers;
use figures::CompareResults;
use outputs::CompareOutputs;
use race::{ComparePlan, Race};
use std::time::Instant;

/// Runs a scene with every model and seed, and writes the files and the table.
///
/// # Errors
/// A model or a seed is not valid, the scene cannot be built, a file cannot be written, or the program was interrupted.
pub fn compare(args: &CompareArgs, out: &mut Out) -> Result<(), Failure> {
    let begin = Instant::now();
    let mut loaded = args.scene.load()?;
    args.end.apply(&mut loaded.scene);
    let seeds = args.seeds(loaded.scene.seed)?;
    loaded.scene.seed = seeds[0];
    let plan = ComparePlan { loaded, models: args.models()?, seeds };
    if !args.report.quiet {
        note(&plan.loaded.notes);
    }
    let workers = Workers::new(args.threads.count(), plan.models.len() * plan.seeds.len())?;
    let mut race = waiting(args.report.quiet, "building the worlds", || {
        Race::start(&plan, &workers, Progress::new(args.report.quiet))
    })?;
    interrupt::watch();
    let mut outputs = CompareOutputs::create(args, &plan, race.leaders())?;
    if outputs.watch() {
        outputs.push(race.leaders())?;
        while race.step() {
            outputs.push(race.leaders())?;
        }
        outputs.end(race.leaders())?;
    }
    let results = CompareResults::new(&plan, race.finish()?, interrupt::asked());
    let files = outputs.finish(&plan, &results, args.all)?;
    if args.report.json {
        out.line(format_args!("{}", results.json(&files, begin.elapsed())))?;
    } else if !args.report.quiet {
        out.text(table::text(&plan, &results, args.all).as_bytes())?;
        for file in &files {
            out.line(format_args!("wrote {}", file.display()))?;
        }
    }
    out.flush()?;
    if results.interrupted {
        if !args.report.quiet {
            complain("interrupted; the figures and the files cover the time until then");
        }
        return Err(Failure::Interrupted);
    }
    Ok(())
}

/// Returns the scene with one of the models and one of the seeds.
fn variant(plan: &ComparePlan, model: usize, seed: u64) -> Result<Loaded, Failure> {
    let model = &plan.models[model];
    let mut loaded = plan.loaded.clone();
    loaded.scene = loaded.scene.with_model(model).map_err(|mut error| {
        error.file = Some(format!("--models {model}").into());
        error
    })?;
    loaded.scene.seed = seed;
    Ok(loaded)
}
