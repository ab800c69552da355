//! `throng measure`: figures of swarms and crowds.

pub mod args;
mod feet;
mod gather;
mod json;
mod page;
mod people;
mod text;

use crate::failure::Failure;
use crate::files::{distinct, is};
use crate::interrupt;
use crate::out::{Out, complain};
use args::MeasureArgs;
pub use people::object as people_json;
use std::path::Path;
pub use text::short;
use throng_record::Output;
use throng_record::swarm::{Swarm, SwarmMoment};

/// The file-name endings of the outputs.
const ENDINGS: [&str; 6] = ["html", "htm", "svg", "png", "csv", "parquet"];

/// A group and its figures.
pub struct Measured {
    /// The name of the group; empty if it has none.
    pub name: String,
    /// The figures of the group.
    pub swarm: Swarm,
}

/// A measured scene or file.
pub struct MeasuredSubject {
    /// The name of the scene or the file.
    pub name: String,
    /// The title on pages and pictures.
    pub title: String,
    /// The figures of the groups as swarms.
    pub groups: Vec<Measured>,
    /// The file to compare with.
    pub beside: Option<Measured>,
    /// The figures of walking people, for a file.
    pub people: Option<people::People>,
}

/// Measures a scene or a file of trajectories and writes the figures of its groups.
///
/// # Errors
/// The scene or the file cannot be read, there is no such group, no agent is present in the measured time, or a file
/// cannot be written.
pub fn measure(args: &MeasureArgs, out: &mut Out) -> Result<(), Failure> {
    if args.feet {
        return feet::measure(args, out);
    }
    distinct(&args.output)?;
    if let Some(path) = args.output.iter().find(|path| !ENDINGS.iter().any(|ending| is(path, ending))) {
        let text =
            format!("{}: `measure` writes pages of plots, plots, and tables of people's figures", path.display());
        let hint = "end the name in .html, .svg, .png, .csv or .parquet; --json writes the figures to standard output";
        return Err(Failure::hint(text, hint));
    }
    if let Some(to) = args.to.filter(|&to| to <= args.from) {
        let text = format!("--to {to}: the measurement begins at {} s", args.from);
        return Err(Failure::hint(text, "give --to more than --from"));
    }
    let subject = gather::gather(args)?;
    let name = &subject.name;
    if subject.groups.is_empty() {
        let to = args.to.map_or_else(|| "the end".to_owned(), |to| format!("{to} s"));
        let text = format!("{name}: no agent is present from {} s to {to}", args.from);
        return Err(Failure::hint(text, "change --from and --to"));
    }
    for path in &args.output {
        write(path, &subject)?;
    }
    if args.report.json {
        out.line(format_args!("{}", json::of(&subject, &args.output)))?;
    } else if !args.report.quiet {
        let people = subject.people.as_ref().map_or_else(String::new, |people| people.text(name));
        out.text(people.as_bytes())?;
        out.text(text::text(name, &subject.groups).as_bytes())?;
        if let Some(beside) = &subject.beside {
            out.text(text::of("beside", beside).as_bytes())?;
        }
        args.output.iter().try_for_each(|path| out.line(format_args!("wrote {}", path.display())))?;
    }
    out.flush()?;
    if interrupt::asked() {
        if !args.report.quiet {
            complain("interrupted; the figures cover the time until then");
        }
        return Err(Failure::Interrupted);
    }
    Ok(())
}

/// Writes a file; its ending determines its kind.
fn write(path: &Path, subject: &MeasuredSubject) -> Result<(), Failure> {
    if is(path, "csv") {
        people::table(path, subject)?.write_csv(Output::create(path)?)?;
    } else if is(path, "parquet") {
        people::table(path, subject)?.write_parquet(Output::create(path)?)?;
    } else if is(path, "svg") || is(path, "png") {
        page::figure(subject)?.write(path)?;
    } else {
        let mut output = Output::create(path)?;
        output.put(page::text(subject).as_bytes())?;
        output.finish()?;
    }
    Ok(())
}

/// Returns the mean over moments of the known values of a figure.
pub fn mean(swarm: &Swarm, figure: impl Fn(&SwarmMoment) -> f64) -> f64 {
    let known = swarm.moments().iter().map(figure).filter(|value| value.is_finite());
    let (sum, count) = known.fold((0.0, 0u32), |(sum, count), value| (sum + value, count + 1));
    sum / f64::from(count)
}
