//! `throng sweep`: many runs with many values of parameters and many seeds, and one table of the results.

pub mod args;
mod list;
mod make;
mod report;
mod tables;

use crate::failure::Failure;
use crate::interrupt;
use crate::out::{Out, complain, note};
use crate::progress::waiting;
use crate::threads::Workers;
use args::SweepArgs;
use make::{Made, SweepWork};
use report::SweepReport;
use std::time::Instant;
use tables::Tables;
use throng_record::sweep::{Plan, RunFolder};
use throng_scene::Plugins;

/// Makes the runs of a plan that are not finished yet, and writes the table of all.
///
/// # Errors
/// The plan is not valid, a file cannot be written, a run could not be made, or the program was interrupted.
pub fn sweep(args: &SweepArgs, out: &mut Out) -> Result<(), Failure> {
    let begin = Instant::now();
    let quiet = args.report.quiet;
    let plan = waiting(quiet, "reading the plan", || Plan::open(&args.plan, &Plugins::new()))?;
    let chosen = args.chosen(plan.len())?;
    tables::check(&args.tables())?;
    if !quiet {
        note(plan.scenes.iter().flat_map(|scene| &scene.notes));
    }
    let workers = Workers::new(args.threads.count(), chosen.len())?;
    if args.dry_run {
        return list::list(args, &plan, &chosen, &workers, out);
    }
    // errors in the names of tables appear before the runs
    let tables = if args.index.is_none() { Some(Tables::create(&args.tables())?) } else { None };
    let folder = if args.collect { RunFolder::at(args.folder()) } else { RunFolder::create(args.folder())? };
    interrupt::watch();
    let work = SweepWork { plan: &plan, folder: &folder, workers: &workers, quiet };
    let Made { rows, made, kept } = if args.collect { work.collect(&chosen)? } else { work.make(&chosen)? };
    let interrupted = interrupt::asked();
    let report = SweepReport {
        plan: &args.plan,
        runs: plan.len(),
        chosen: chosen.len(),
        made,
        kept,
        failed: rows.iter().filter_map(|row| Some((row.index, row.error()?.to_owned()))).collect(),
        folder: folder.path(),
        files: if interrupted || tables.is_none() { Vec::new() } else { args.tables() },
        interrupted,
    };
    if let (false, Some(tables)) = (interrupted, tables) {
        waiting(quiet, "writing the table", || tables.write(&plan, rows))?;
    }
    if args.report.json {
        out.line(format_args!("{}", report.json(begin.elapsed())))?;
    } else if !quiet {
        report.print(out)?;
    }
    out.flush()?;
    if interrupted {
        if !quiet {
            complain(&report.how_to_go_on());
        }
        return Err(Failure::Interrupted);
    }
    if report.failed.is_empty() { Ok(()) } else { Err(Failure::Expectation) }
}
