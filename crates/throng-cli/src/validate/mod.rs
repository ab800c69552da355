//! `throng validate`: repeats experiments with people by a model and compares the results.

pub mod args;
mod families;
mod page;
mod race;
mod results;
mod table;

use crate::failure::Failure;
use crate::files::{distinct, is};
use crate::interrupt;
use crate::out::{Out, complain};
use crate::progress::Progress;
use crate::threads::Workers;
use args::ValidateArgs;
use race::ValidatePlan;
use results::ValidateResults;
use std::path::Path;
use std::time::{Duration, Instant};
use throng_record::Output;
use throng_record::validate::Experiment;
use throng_record::validate::families::FAMILIES;

/// A function that formats the results for a file.
type ResultsFormat = fn(&ValidateResults, Duration) -> Result<String, Failure>;

/// Runs the experiments, and writes the table and the files.
///
/// # Errors
/// An experiment, a model or a key does not exist, a file cannot be written, the program was interrupted, or a figure
/// is outside its tolerance.
pub fn validate(args: &ValidateArgs, out: &mut Out) -> Result<(), Failure> {
    let begin = Instant::now();
    if args.asks_families()? {
        return families::families(args, out);
    }
    let experiments = args.experiments()?;
    if args.list {
        return list(&experiments, out);
    }
    let cases = |experiment: &'static Experiment| {
        (experiment, experiment.cases().into_iter().filter(|case| case.quick || !args.quick).collect())
    };
    let plan = ValidatePlan {
        experiments: experiments.into_iter().map(cases).collect(),
        model: args.model()?,
        set: args.set.clone(),
        seeds: args.seeds()?,
    };
    let outputs = outputs(args)?;
    if let Some(folder) = &args.keep {
        keep(&plan, folder)?;
    }
    interrupt::watch();
    let count = plan.experiments.iter().map(|(_, cases)| cases.len()).sum::<usize>() * plan.seeds.len();
    let workers = Workers::new(args.threads.count(), count)?;
    let validated = plan.run(&workers, &Progress::new(args.report.quiet))?;
    let results = ValidateResults {
        model: args.model.clone(),
        set: plan.set,
        seeds: plan.seeds,
        quick: args.quick,
        experiments: validated,
        interrupted: interrupt::asked(),
    };
    for (mut output, write) in outputs {
        output.put(write(&results, begin.elapsed())?.as_bytes())?;
        output.finish()?;
    }
    if args.report.json {
        out.line(format_args!("{:#}", results.json(begin.elapsed())))?;
    } else if !args.report.quiet {
        out.text(table::text(&results).as_bytes())?;
        for file in &args.output {
            out.line(format_args!("wrote {}", file.display()))?;
        }
    }
    out.flush()?;
    if results.interrupted {
        if !args.report.quiet {
            complain("interrupted; the figures are those of the cases that were complete");
        }
        return Err(Failure::Interrupted);
    }
    let (required, met) = results.required_and_met();
    if met < required { Err(Failure::Expectation) } else { Ok(()) }
}

/// Creates the output files before the runs, so that errors in their names appear first.
fn outputs(args: &ValidateArgs) -> Result<Vec<(Output, ResultsFormat)>, Failure> {
    distinct(&args.output)?;
    let mut outputs: Vec<(Output, ResultsFormat)> = Vec::new();
    for path in &args.output {
        let write: ResultsFormat = if is(path, "html") {
            page::page
        } else if is(path, "json") {
            |results, wall| Ok(format!("{:#}\n", results.json(wall)))
        } else {
            let text = format!("{}: cannot tell what to write from this name", path.display());
            return Err(Failure::hint(text, "end it in .html or .json"));
        };
        outputs.push((Output::create(path)?, write));
    }
    Ok(outputs)
}

/// Creates a folder if it does not exist.
fn make_folder(folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder)
        .map_err(|error| Failure::Error(format!("cannot create the folder {}: {error}", folder.display())))
}

/// Writes the scene files of all cases with the first seed.
fn keep(plan: &ValidatePlan, folder: &Path) -> Result<(), Failure> {
    make_folder(folder)?;
    for (experiment, cases) in &plan.experiments {
        for case in cases {
            let scene = plan.scene(experiment, case, plan.seeds[0])?;
            let name = format!("{}-{}.toml", experiment.name, case.name.replace([' ', '/'], "-"));
            let mut output = Output::create(folder.join(name))?;
            output.put(scene.to_toml()?.as_bytes())?;
            output.finish()?;
        }
    }
    Ok(())
}

/// Lists experiments and cases; cases outside the quick selection stand in brackets.
fn list(experiments: &[&'static Experiment], out: &mut Out) -> Result<(), Failure> {
    let widest = experiments.iter().map(|experiment| experiment.name.len()).max().unwrap_or(0);
    for experiment in experiments {
        let name = |case: &throng_record::validate::Case| {
            if case.quick { case.name.clone() } else { format!("[{}]", case.name) }
        };
        let cases: Vec<String> = experiment.cases().iter().map(name).collect();
        out.line(format_args!("{:widest$}  {}: {}", experiment.name, experiment.title, cases.join(", ")))?;
    }
    out.line(format_args!(
        "\nCases in brackets are left out with --quick. `throng validate {}` runs random variants of scenes:",
        families::NAME
    ))?;
    let widest = FAMILIES.iter().map(|family| family.name.len()).max().unwrap_or(0);
    FAMILIES.iter().try_for_each(|family| out.line(format_args!("{:widest$}  {}", family.name, family.about)))
}
