//! The command line.

use clap::Parser;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  throng-fuzz                                every target for 10 s
  throng-fuzz csv rec --seconds 3600         two targets for an hour each
  throng-fuzz --count 2000 --jobs 2          2,000 mutants of every target, two targets at a time
  throng-fuzz plans --seconds 60 --share     the targets of a group, a minute together
  throng-fuzz svg --seed 3 --only 4711       one mutant again; it is written to the folder of --out
  throng-fuzz svg --input broken.svg         a single file, unchanged

Exit codes: 0 no input broke a limit; 1 at least one input did; 2 an error.";

/// Feed malformed inputs to every reader of throng: none may panic, abort, or exceed the limits of time and memory
#[derive(Parser, Clone, Debug)]
#[command(name = "throng-fuzz", version, after_help = EXAMPLES)]
pub struct Options {
    /// Targets, or groups of targets [default: all]
    #[arg(value_name = "TARGET")]
    pub targets: Vec<String>,

    /// List the targets and their groups
    #[arg(long)]
    pub list: bool,

    /// Seconds for each target [default: 10]
    #[arg(long, value_name = "S", conflicts_with = "count")]
    pub seconds: Option<f64>,

    /// Divide the seconds among the targets of a group
    #[arg(long, requires = "seconds")]
    pub share: bool,

    /// Number of mutants for each target, after the files of its corpus; replaces --seconds
    #[arg(long, value_name = "N")]
    pub count: Option<u64>,

    /// Seed of the mutants
    #[arg(long, value_name = "K", default_value_t = 1)]
    pub seed: u64,

    /// Run a single input, by its number
    #[arg(long, value_name = "NUMBER", conflicts_with_all = ["seconds", "count"])]
    pub only: Option<u64>,

    /// Run a single file, unchanged
    #[arg(long, value_name = "FILE", conflicts_with_all = ["seconds", "count", "only"])]
    pub input: Option<PathBuf>,

    /// Number of targets that run at the same time
    #[arg(long, value_name = "J", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=64))]
    pub jobs: u16,

    /// Limit of processor time per input, seconds
    #[arg(long, value_name = "S", default_value_t = 10.0)]
    pub max_seconds: f64,

    /// Limit of memory per input, megabytes
    #[arg(long, value_name = "MB", default_value_t = 2048)]
    pub max_memory: u64,

    /// Folder for the inputs that broke a limit
    #[arg(long, value_name = "FOLDER", default_value = "target/fuzz")]
    pub out: PathBuf,

    /// Internal, for workers: the file for the progress.
    #[arg(long, hide = true)]
    pub worker: Option<PathBuf>,

    /// Internal, for workers: the first input.
    #[arg(long, hide = true, default_value_t = 0)]
    pub first: u64,
}
