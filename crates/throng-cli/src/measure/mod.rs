//! `throng measure`: what swarms and crowds are like.

pub mod args;
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
use throng_record::swarm::{Moment, Swarm};

/// How the names of what it writes end.
const ENDINGS: [&str; 6] = ["html", "htm", "svg", "png", "csv", "parquet"];

/// A group and what was measured.
pub struct Measured {
    /// Its name; empty where it has none.
    pub name: String,
    /// Its figures.
    pub swarm: Swarm,
}

/// What was measured.
pub struct Subject {
    /// Name of the scene or the file.
    pub name: String,
    /// What it is called on pages and pictures.
    pub title: String,
    /// Its groups, as swarms.
    pub groups: Vec<Measured>,
    /// Those of a file who walk, as people.
    pub people: Option<people::People>,
}

/// Runs a scene, or reads a file of trajectories, and tells the figures of its groups.
///
/// # Errors
/// The scene or the file cannot be read, there is no such group, nobody was there, or a file cannot be written.
pub fn measure(args: &MeasureArgs, out: &mut Out) -> Result<(), Failure> {
    distinct(&args.output)?;
    if let Some(path) = args.output.iter().find(|path| !ENDINGS.iter().any(|ending| is(path, ending))) {
        let text =
            format!("{}: `measure` writes pages of plots, plots, and tables of people's figures", path.display());
        let hint = "end the name in .html, .svg, .png, .csv or .parquet; --json writes the figures to standard output";
        return Err(Failure::hint(text, hint));
    }
    if let Some(to) = args.to.filter(|&to| to <= args.from) {
        return Err(Failure::hint(format!("--to {to}: it begins at {} s", args.from), "give --to more than --from"));
    }
    interrupt::watch();
    let subject = gather::gather(args)?;
    let name = &subject.name;
    if subject.groups.is_empty() {
        let to = args.to.map_or_else(|| "the end".to_owned(), |to| format!("{to} s"));
        let text = format!("{name}: nobody was there from {} s to {to}", args.from);
        return Err(Failure::hint(text, "change --from and --to"));
    }
    for path in &args.output {
        write(path, &subject)?;
    }
    if args.json {
        out.line(format_args!("{}", json::of(&subject, &args.output)))?;
    } else if !args.quiet {
        let people = subject.people.as_ref().map_or_else(String::new, |people| people.text(name));
        out.text(people.as_bytes())?;
        out.text(text::text(name, &subject.groups).as_bytes())?;
        args.output.iter().try_for_each(|path| out.line(format_args!("wrote {}", path.display())))?;
    }
    out.flush()?;
    if interrupt::asked() {
        if !args.quiet {
            complain("interrupted; the figures are those up to there");
        }
        return Err(Failure::Interrupted);
    }
    Ok(())
}

/// Writes a file, its kind by its ending.
fn write(path: &Path, subject: &Subject) -> Result<(), Failure> {
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

/// The mean over moments of what is known.
pub fn mean(swarm: &Swarm, figure: impl Fn(&Moment) -> f64) -> f64 {
    let known = swarm.moments().iter().map(figure).filter(|value| value.is_finite());
    let (sum, count) = known.fold((0.0, 0u32), |(sum, count), value| (sum + value, count + 1));
    sum / f64::from(count)
}
