//! The driver: runs each target in processes of its own, limits their time, keeps the inputs that broke a limit, and
//! reports.

#![allow(clippy::print_stdout)] // a program

use crate::corpus::Sample;
use crate::options::Options;
use crate::progress::Progress;
use crate::targets::chosen;
use crate::worker::{FIND, MOST_FINDS};
use crate::{TARGETS, Target, corpus, mutate};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitCode, ExitStatus, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Default time of a target, seconds.
const SECONDS: f64 = 10.0;
/// Interval at which a worker is checked.
const LOOK: Duration = Duration::from_millis(20);
/// A worker is killed after an input takes this multiple of the processor time limit in wall-clock time: other programs
/// may run too.
const PATIENCE: f64 = 3.0;

/// An input that broke a limit.
struct Find {
    number: u64,
    words: String,
}

/// The result of a target.
struct Outcome {
    progress: Progress,
    finds: Vec<Find>,
    seconds: f64,
}

/// Runs the chosen targets and prints their results.
///
/// # Errors
/// A target does not exist, a corpus cannot be read, a worker cannot be started, or a file cannot be written.
pub fn run(options: &Options) -> Result<ExitCode, String> {
    if options.list {
        list();
        return Ok(ExitCode::SUCCESS);
    }
    let targets = chosen(&options.targets)?;
    if options.only.is_some() && targets.len() != 1 {
        return Err("--only needs a single target: name it".into());
    }
    if options.input.is_some() && targets.len() != 1 {
        return Err("--input needs a single target: name it".into());
    }
    if ![options.seconds.unwrap_or(SECONDS), options.max_seconds].iter().all(|seconds| (0.0..=1e9).contains(seconds)) {
        return Err("--seconds and --max-seconds must be from 0 to 1e9".into());
    }
    let out = |error: std::io::Error| format!("{}: {error}", options.out.display());
    std::fs::create_dir_all(&options.out).map_err(out)?;
    println!(
        "{:12} {:>9} {:>9} {:>9} {:>7}  {:>19}  {:>19}",
        "target", "inputs", "accepted", "refused", "s", "slowest, ms", "largest peak, MB"
    );
    let (next, result) = (AtomicUsize::new(0), Mutex::new(Ok(0)));
    std::thread::scope(|scope| {
        for _ in 0..options.jobs {
            scope.spawn(|| {
                while let Some(target) = targets.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let found = target_run(target, &targets, options);
                    if let Ok(mut result) = result.lock() {
                        *result = match (result.clone(), found) {
                            (Ok(before), Ok(found)) => Ok(before + found),
                            (Err(error), _) | (_, Err(error)) => Err(error),
                        };
                    }
                }
            });
        }
    });
    let found = result.into_inner().unwrap_or_else(|_| Err("a thread of the driver panicked".to_owned()))?;
    if found > 0 {
        println!("{found} inputs broke a limit; they are in {}", options.out.display());
    }
    Ok(ExitCode::from(u8::from(found > 0)))
}

fn list() {
    for target in TARGETS {
        println!("{:12} {:12} {}", target.name, target.group, target.about);
    }
}

/// Runs a target, prints its line, keeps its finds, and returns their number.
fn target_run(target: &Target, all: &[&Target], options: &Options) -> Result<usize, String> {
    let sharing = all.iter().filter(|other| other.group == target.group).count();
    let mut options = Options { targets: vec![target.name.to_owned()], ..options.clone() };
    if options.count.is_none() && options.only.is_none() && options.input.is_none() {
        let seconds = options.seconds.unwrap_or(SECONDS);
        options.seconds = Some(if options.share { seconds / sharing as f64 } else { seconds });
    }
    let corpus = corpus::of(target)?;
    let Outcome { progress, finds, seconds } = outcome(target, &options)?;
    let mut lines = format!(
        "{:12} {:9} {:9} {:9} {seconds:7.1}  {:>19}  {:>19}",
        target.name,
        progress.current - options.only.unwrap_or(0),
        progress.accepted,
        progress.refused,
        format!("{:.1} ({})", progress.slowest.0 as f64 / 1e3, progress.slowest.1),
        format!("{:.1} ({})", progress.largest.0 as f64 / f64::from(1 << 20), progress.largest.1),
    );
    for find in &finds {
        let path = keep(target, &corpus, &options, find.number)?;
        lines += &format!("\n  {}\n    {}", path.display(), find.words);
        if options.input.is_none() {
            lines +=
                &format!("\n    again: throng-fuzz {} --seed {} --only {}", target.name, options.seed, find.number);
        }
    }
    if let (Some(number), true) = (options.only, finds.is_empty()) {
        lines += &format!("\n  {}", keep(target, &corpus, &options, number)?.display());
    }
    println!("{lines}");
    Ok(finds.len())
}

/// Writes an input to the output folder and returns its path.
fn keep(target: &Target, corpus: &[Sample], options: &Options, number: u64) -> Result<PathBuf, String> {
    if let Some(input) = &options.input {
        return Ok(input.clone());
    }
    let path = options.out.join(format!("{}-{}-{number}.{}", target.name, options.seed, target.ending));
    std::fs::write(&path, mutate::input(target, corpus, options.seed, number))
        .map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(path)
}

/// Runs a target. After an input that ended a worker, another worker continues with the next input.
fn outcome(target: &Target, options: &Options) -> Result<Outcome, String> {
    let start = Instant::now();
    let folder = tempfile::tempdir().map_err(|error| format!("no temporary folder: {error}"))?;
    let (path, output, errors) = (folder.path().join("progress"), folder.path().join("out"), folder.path().join("err"));
    let mut out = Outcome { progress: Progress::default(), finds: Vec::new(), seconds: 0.0 };
    out.progress.current = options.only.unwrap_or(0);
    loop {
        let (first, spent) = (out.progress.current, start.elapsed().as_secs_f64());
        let mut worker = spawn(options, first, spent, [&path, &output, &errors])?;
        let (status, hangs) =
            watch(&mut worker, &path, options).map_err(|error| format!("{}: {error}", target.name))?;
        let progress = Progress::read(&path);
        out.progress.add(&progress);
        out.finds.extend(finds(&std::fs::read_to_string(&output).unwrap_or_default()));
        let end = std::fs::read(&errors).unwrap_or_default();
        let end = last_words(&String::from_utf8_lossy(&end));
        match (status.code(), hangs) {
            (Some(0), _) => break,
            (Some(2), false) => return Err(format!("{}: {end}", target.name)),
            _ if options.only.is_some_and(|only| progress.current != only) => break,
            _ => {}
        }
        let words = match hangs {
            true => format!("no end after {:.0} s", PATIENCE * options.max_seconds),
            false => format!("the process ended with {status}: {end}"),
        };
        out.finds.push(Find { number: progress.current, words });
        out.progress.current += 1;
        let ends = options.only.is_some() || options.input.is_some() || out.finds.len() >= MOST_FINDS;
        if ends || options.seconds.is_some_and(|seconds| start.elapsed().as_secs_f64() > seconds) {
            break;
        }
    }
    out.seconds = start.elapsed().as_secs_f64();
    Ok(out)
}

/// Starts a worker at an input, with the remaining time.
fn spawn(options: &Options, first: u64, spent: f64, [progress, out, err]: [&Path; 3]) -> Result<Child, String> {
    let fail = |error: std::io::Error| format!("no worker: {error}");
    let mut command = Command::new(std::env::current_exe().map_err(fail)?);
    command.args(&options.targets).arg("--worker").arg(progress);
    let mut add = |name: &str, value: Option<String>| {
        if let Some(value) = value {
            command.args([name, &value]);
        }
    };
    add("--first", Some(first.to_string()));
    add("--seed", Some(options.seed.to_string()));
    add("--count", options.count.map(|count| count.to_string()));
    add("--seconds", options.seconds.map(|seconds| (seconds - spent).max(0.0).to_string()));
    add("--only", options.only.map(|only| only.to_string()));
    add("--max-seconds", Some(options.max_seconds.to_string()));
    add("--max-memory", Some(options.max_memory.to_string()));
    if let Some(input) = &options.input {
        command.arg("--input").arg(input);
    }
    // a backtrace takes seconds
    command.env("RUST_BACKTRACE", "0").stdin(Stdio::null());
    command.stdout(File::create(out).map_err(fail)?).stderr(File::create(err).map_err(fail)?);
    command.spawn().map_err(fail)
}

/// Waits for a worker, and kills it if an input takes too long. Returns whether it was killed.
fn watch(worker: &mut Child, progress: &Path, options: &Options) -> std::io::Result<(ExitStatus, bool)> {
    let patience = Duration::from_secs_f64(PATIENCE * options.max_seconds).max(Duration::from_secs(1));
    let (mut last, mut since) = (u64::MAX, Instant::now());
    loop {
        if let Some(status) = worker.try_wait()? {
            return Ok((status, false));
        }
        let current = Progress::read(progress).current;
        if current != last {
            (last, since) = (current, Instant::now());
        }
        if since.elapsed() > patience {
            worker.kill()?;
            return Ok((worker.wait()?, true));
        }
        std::thread::sleep(LOOK);
    }
}

/// Returns the finds in a worker's output.
fn finds(output: &str) -> impl Iterator<Item = Find> {
    output.lines().filter_map(|line| {
        let (number, words) = line.strip_prefix(FIND)?.trim_start().split_once(' ')?;
        Some(Find { number: number.parse().ok()?, words: words.to_owned() })
    })
}

/// Returns the last lines of a worker's standard error.
fn last_words(text: &str) -> String {
    let lines: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).collect();
    lines[lines.len().saturating_sub(3)..].join(" / ").chars().take(500).collect()
}
