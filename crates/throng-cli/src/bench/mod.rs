//! `throng bench`: how long steps take, stage by stage, in reference works and scenes.

pub mod args;
mod machine;
mod measure;
mod plan;
mod table;

use crate::failure::Failure;
use crate::files::{distinct, is};
use crate::interrupt;
use crate::out::{Out, complain};
use crate::progress::Progress;
use args::BenchArgs;
use machine::{Machine, profile};
use measure::MeasuredRun;
use throng_bench::WORKS;
use throng_record::Output;

/// A function that formats runs for a file.
type RunsFormat = fn(&Machine, &[MeasuredRun]) -> String;

/// Measures the works and scenes of the arguments, and writes the table and the files.
///
/// # Errors
/// A work or scene does not exist or cannot be built, a file cannot be written, or the program was interrupted.
pub fn bench(args: &BenchArgs, out: &mut Out) -> Result<(), Failure> {
    if args.list {
        return list(out);
    }
    let subjects = plan::subjects(args)?;
    let outputs = outputs(args)?;
    if profile() == "dev" && !args.report.quiet {
        complain("note: this program was not built with --release; it is slower than it could be");
    }
    interrupt::watch();
    let (machine, threads) = (Machine::here(), args.threads());
    let progress = Progress::new(args.report.quiet);
    let mut runs: Vec<MeasuredRun> = Vec::new();
    let whole = subjects.len() * threads.len() * args.repeat as usize;
    let mut done = 0;
    for subject in subjects.iter().take_while(|_| !interrupt::asked()) {
        let show = |done: usize| progress.show(done as f64 / whole as f64, || subject.name().to_owned());
        show(done);
        runs.extend(measure::measure(subject, args, &threads, || {
            done += 1;
            show(done);
        })?);
    }
    progress.done();
    for (mut output, write) in outputs {
        output.put(write(&machine, &runs).as_bytes())?;
        output.finish()?;
    }
    if args.report.json {
        out.line(format_args!("{:#}", table::json(&machine, &runs)))?;
    } else if !args.report.quiet {
        out.text(table::text(&machine, &runs).as_bytes())?;
        for file in &args.output {
            out.line(format_args!("wrote {}", file.display()))?;
        }
    }
    out.flush()?;
    if interrupt::asked() {
        if !args.report.quiet {
            complain("interrupted; the figures are those measured until then");
        }
        return Err(Failure::Interrupted);
    }
    Ok(())
}

/// Creates the output files before the measurement, so that errors in their names appear first.
fn outputs(args: &BenchArgs) -> Result<Vec<(Output, RunsFormat)>, Failure> {
    distinct(&args.output)?;
    let mut outputs: Vec<(Output, RunsFormat)> = Vec::new();
    for path in &args.output {
        let write: RunsFormat = if is(path, "json") {
            |machine, runs| format!("{:#}\n", table::json(machine, runs))
        } else if is(path, "md") {
            table::markdown
        } else {
            let text = format!("{}: cannot tell what to write from this name", path.display());
            return Err(Failure::hint(text, "end it in .json or .md"));
        };
        outputs.push((Output::create(path)?, write));
    }
    Ok(outputs)
}

/// Lists the reference works.
fn list(out: &mut Out) -> Result<(), Failure> {
    let widest = WORKS.iter().map(|work| work.name.len()).max().unwrap_or(0);
    for work in WORKS {
        let sizes: Vec<String> = work.sizes.iter().map(usize::to_string).collect();
        out.line(format_args!("{:widest$}  {} [{}]", work.name, work.about, sizes.join(", ")))?;
    }
    Ok(())
}
