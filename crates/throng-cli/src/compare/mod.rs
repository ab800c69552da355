//! `throng compare`: a scene with several local models, side by side.

mod args;
mod bounds;
mod contender;
mod figures;
mod grade;
mod html;
mod junit;
mod outputs;
mod race;
mod sheet;
mod table;
mod telling;
mod worker;

pub use args::{COMPARE, COMPARE_SHORT, CompareArgs};

use crate::failure::Failure;
use crate::interrupt;
use crate::out::{Out, complain, note};
use crate::progress::{Progress, waiting};
use crate::threads::Workers;
use bounds::Bounds;
use figures::CompareResults;
use grade::Grades;
use outputs::CompareOutputs;
use race::{ComparePlan, Race};
use std::time::Instant;
use throng_record::Output;

/// Runs a scene with every model and seed, and writes the files and the table.
///
/// # Errors
/// A model, a seed or a bound is not valid, the scene cannot be built, a file cannot be written, the program was
/// interrupted, or a run is outside the bounds.
pub fn compare(args: &CompareArgs, out: &mut Out) -> Result<(), Failure> {
    let begin = Instant::now();
    let mut loaded = args.scene.load()?;
    args.end.apply(&mut loaded.scene);
    let seeds = args.seeds(loaded.scene.seed)?;
    loaded.scene.seed = seeds[0];
    let bounds = args.bounds.as_deref().map(Bounds::open).transpose()?;
    let plan = ComparePlan { loaded, models: args.models()?, seeds, all_series: bounds.is_some() };
    if !args.report.quiet {
        note(&plan.loaded.notes);
    }
    let workers = Workers::new(args.threads.count(), plan.models.len() * plan.seeds.len())?;
    let mut race = waiting(args.report.quiet, "building the worlds", || {
        Race::start(&plan, &workers, Progress::new(args.report.quiet))
    })?;
    if let (Some(bounds), Some(run)) = (&bounds, race.leaders().first()) {
        bounds.check_names(run.world.figures().map(|(name, _)| name))?;
    }
    let junit = args.junit.as_ref().map(Output::create).transpose()?;
    interrupt::watch();
    let mut outputs = CompareOutputs::create(args, &plan, race.leaders())?;
    if outputs.watch() {
        outputs.push(race.leaders())?;
        while race.step()? {
            outputs.push(race.leaders())?;
        }
        outputs.end(race.leaders())?;
    }
    let results = CompareResults::new(&plan, race.finish()?, interrupt::asked());
    let mut files = outputs.finish(&plan, &results, args.all)?;
    let grades = bounds.as_ref().map(|bounds| Grades::new(bounds, &results));
    // a report of an interrupted comparison would pass without its runs
    if let (Some(mut output), Some(grades), false) = (junit, &grades, results.interrupted) {
        files.push(output.path().to_path_buf());
        output.put(junit::report(&results.scene, grades).as_bytes())?;
        output.finish()?;
    }
    if args.report.json {
        out.line(format_args!("{}", results.json(&files, grades.as_ref(), begin.elapsed())))?;
    } else if !args.report.quiet {
        out.text(table::text(&plan, &results, args.all).as_bytes())?;
        out.text(grades.as_ref().map_or_else(String::new, Grades::text).as_bytes())?;
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
    match grades {
        Some(grades) if !grades.passed() => {
            if args.report.quiet && !args.report.json {
                complain(grades.text().trim_end());
            }
            Err(Failure::Expectation)
        }
        _ => Ok(()),
    }
}
