//! The worker: runs the inputs of a target in a process of its own, and reports the current input and the inputs that
//! broke a limit.

#![allow(clippy::print_stdout)] // a program; its driver reads the output

use crate::options::Options;
use crate::progress::Progress;
use crate::{Target, corpus, memory, mutate};
use std::fs::File;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::ExitCode;
use std::sync::Mutex;
use std::time::{Duration, Instant};
use throng_bench::clock::process_time;

/// A worker ends after this number of inputs that broke a limit.
pub(crate) const MOST_FINDS: usize = 10;
/// The first word of an output line that reports a find.
pub(crate) const FIND: &str = "find";
/// Greatest length of a rejection message, characters.
const LONGEST: usize = 4000;
/// Stack of the thread that runs the target, bytes: the default of Rust's threads, less than that of a main thread.
const STACK: usize = 2 << 20;

/// The last panic: place and message.
static PANIC: Mutex<String> = Mutex::new(String::new());

/// Runs the target of the options from input [`first`](Options::first) on.
///
/// # Errors
/// The corpus or the input cannot be read, or the progress cannot be written.
pub fn run(options: &Options) -> Result<ExitCode, String> {
    let target = options.targets.first().and_then(|name| Target::named(name)).ok_or("a worker needs a target")?;
    let progress = options.worker.as_deref().ok_or("a worker needs a file for its progress")?;
    memory::limit(options.max_memory << 20)?;
    // panics that a reader catches are not finds
    throng_scene::hush();
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if let Ok(mut last) = PANIC.lock() {
            *last = panic.to_string().replace('\n', " ");
        }
        report(panic);
    }));
    let thread = std::thread::Builder::new().stack_size(STACK);
    let run = std::thread::scope(|scope| {
        thread.spawn_scoped(scope, || work(target, options, progress)).map(|thread| thread.join())
    });
    run.map_err(|error| format!("no thread: {error}"))?.map_err(|_| "the worker itself panicked".to_owned())??;
    Ok(ExitCode::SUCCESS)
}

fn work(target: &Target, options: &Options, path: &Path) -> Result<(), String> {
    let corpus = corpus::of(target)?;
    let given = options.input.as_ref().map(std::fs::read).transpose().map_err(|error| error.to_string())?;
    let end = match (options.only, options.count, &given) {
        (_, _, Some(_)) => 1,
        (Some(only), ..) => only + 1,
        (_, Some(count), _) => corpus.len() as u64 + count,
        // the whole corpus runs, regardless of the time
        _ => u64::MAX,
    };
    let deadline = Duration::from_secs_f64(options.seconds.unwrap_or(f64::MAX).clamp(0.0, 1e9));
    let limit = Duration::from_secs_f64(options.max_seconds);
    let failed = |error: std::io::Error| format!("{}: {error}", path.display());
    let mut file = File::create(path).map_err(failed)?;
    let (start, mut finds) = (Instant::now(), 0);
    let mut so_far = Progress { current: options.first, ..Progress::default() };
    while so_far.current < end && finds < MOST_FINDS {
        if so_far.current >= corpus.len() as u64 && start.elapsed() >= deadline {
            break;
        }
        let number = so_far.current;
        so_far.write(&mut file).map_err(failed)?;
        let input = given.clone().unwrap_or_else(|| mutate::input(target, &corpus, options.seed, number));
        let (before, began) = (process_time(), Instant::now());
        let result = catch_unwind(AssertUnwindSafe(|| (target.run)(&input)));
        let clock = || Some(process_time()?.saturating_sub(before?));
        let time = clock().unwrap_or_else(|| began.elapsed());
        let mut find = |words: String| {
            finds += 1;
            println!("{FIND} {number} {words}");
        };
        match result {
            Ok(Ok(())) => so_far.accepted += 1,
            Ok(Err(message)) => {
                so_far.refused += 1;
                let length = message.chars().count();
                if length > LONGEST {
                    find(format!("a message of {length} characters: {}", message.chars().take(80).collect::<String>()));
                }
            }
            Err(_) => {
                let words = PANIC.lock().map_or_else(|_| String::new(), |last| last.clone());
                find(words.chars().take(500).collect());
            }
        }
        if time > limit {
            find(format!("{:.1} s of processor time", time.as_secs_f64()));
        }
        let peak = memory::peak();
        if peak > options.max_memory << 20 && so_far.largest.0 <= options.max_memory << 20 {
            find(format!("{} MB of memory", peak >> 20));
        }
        so_far.slowest = so_far.slowest.max((time.as_micros() as u64, number));
        // the peak is that of the whole process: if it grows, the current input caused it
        if peak > so_far.largest.0 {
            so_far.largest = (peak, number);
        }
        so_far.current += 1;
    }
    so_far.write(&mut file).map_err(failed)
}
