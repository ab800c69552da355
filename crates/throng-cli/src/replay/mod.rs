//! `throng replay`: simulates recorded people by one or several models and compares them with the recording.

pub mod args;
mod json;
mod kinds;
mod outputs;
mod page;
mod report;
mod setup;
mod stage;
mod table;
mod tables;
mod text;
mod walk;

use crate::failure::Failure;
use crate::files::is;
use crate::interrupt;
use crate::out::{Out, complain, note};
use crate::threads;
use args::ReplayArgs;
use report::ReplayReport;
use setup::Setup;
use std::time::Instant;
use throng_record::Output;

/// Replays recorded people, and writes the files and the figures.
///
/// # Errors
/// The data, the map or the groups cannot be read, a model does not exist, a file cannot be written, or the program was
/// interrupted.
pub fn replay(args: &ReplayArgs, out: &mut Out) -> Result<(), Failure> {
    let begin = Instant::now();
    if let Some(path) = args.table.as_ref().filter(|path| !is(path, "csv")) {
        let text = format!("--table {}: tables of people are .csv", path.display());
        return Err(Failure::hint(text, "end the name in .csv"));
    }
    let setup = Setup::read(args)?;
    if !args.report.quiet {
        note(&setup.notes);
    }
    interrupt::watch();
    let (replayed, pages) = threads::with(args.threads.count(), || walk::walk(&setup))?;
    let predicted = walk::predictions(&setup, pages.as_ref())?;
    let report = ReplayReport::new(&setup, replayed, predicted);
    if let Some(path) = &args.table {
        table::table(&report).write_csv(Output::create(path)?)?;
    }
    if let Some(pages) = pages {
        pages.write(&report)?;
    }
    if args.report.json {
        out.line(format_args!("{}", json::of(&report, begin.elapsed())))?;
    } else if !args.report.quiet {
        out.text(text::of(&report).as_bytes())?;
    }
    out.flush()?;
    if report.interrupted {
        if !args.report.quiet {
            complain("interrupted; the figures and the files cover the time until then");
        }
        return Err(Failure::Interrupted);
    }
    Ok(())
}
