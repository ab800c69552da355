//! The command line of `throng bench`.

use crate::source::Changes;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use throng_scene::MAX_AGENTS;

/// The examples, for `-h`.
pub const SHORT: &str = "\
Examples:
  throng bench
  throng bench crossing --agents 10k 100k --threads 1 2 --guard both
  throng bench circle office

`throng bench --help` says what is measured, and describes the keys of --json.";

/// What is measured, keys and examples, for `--help`.
pub const LONG: &str = "\
A world is built and makes the steps of --warm-up. Then copies of it make the same --steps, once for each number of
threads, and all that --repeat times; one more step before is not measured. Given are medians, in nanoseconds for a move
of one agent by one sub-step: on the clock, least of the repeats on the clock, processor time of all threads, and
on the clock stage by stage. Bytes an agent are everything that the world has allocated after the warm-up.

The steps of works are 0.1 s long, those of `hall` and `rooms` 0.05 s, and not divided.

Keys of --json (a list of runs, one object each):
  work, agents, threads        the name of the work or scene; how many agents, when measuring begins; threads for the steps
  guard                        on, off, or some: for some of the agents
  ns_per_agent_step            nanoseconds on the clock for a move of one agent by one sub-step, median
  least_ns_per_agent_step      the same, least
  cpu_ns_per_agent_step        processor time, all threads, median; null where the system does not tell
  stages                       { perceive, intend, avoid, guard, move }: nanoseconds on the clock, medians
  cpu_per_simulated_second     processor seconds a simulated second, median
  bytes_per_agent              bytes allocated for the world, an agent
  warm_up, steps, repeats      steps made before; steps measured at a time; how many times
  step_seconds                 simulated seconds a step
  agent_steps                  moves of one agent by one sub-step in `steps` steps
  version, profile             of this program: its version, and how it was built, `release` or `dev`
  machine                      { cpu, cores, instructions, system, load }: `instructions` the widest vectors it knows, `load`
                               how many programs were running when measuring began, one for each core that is busy

Exit codes: 0 done; 2 an error; 130 interrupted: what was measured until then is written.

Examples:
  throng bench
      the works that simulators are compared on
  throng bench --list
  throng bench all --threads 1 -o here.json
  throng bench crossing crossing-shuffled --agents 10k 100k 1M --guard both
  throng bench densities at-rest
  throng bench ring-1000 scenes/crossing.toml
  throng bench station.wkt --exit 10,0,2,4 --people 500 --set time.step=0.05";

/// What `throng bench` is told.
#[derive(Args, Debug)]
pub struct BenchArgs {
    /// Reference works (see --list; `densities` and `all` are several), scenes of the gallery, or files, as for `throng
    /// run` [default: crossing crossing-shuffled]
    ///
    /// The gallery has a scene `crossing` too: scenes/crossing.toml names its file.
    #[arg(value_name = "WORK|SCENE")]
    pub works: Vec<PathBuf>,

    /// Lists the reference works
    #[arg(long)]
    pub list: bool,

    /// How many agents a work has, such as 10000 or 10k or 1M [default: those that --list shows]
    #[arg(long, value_name = "N", num_args = 1.., value_delimiter = ',', value_parser = parse_count)]
    pub agents: Vec<usize>,

    /// Threads for the steps [default: 1, and as many as there are cores]
    #[cfg(feature = "parallel")]
    #[arg(long, value_name = "N", num_args = 1.., value_delimiter = ',', value_parser = parse_threads)]
    pub threads: Vec<usize>,

    /// Whether the guard keeps everybody apart [default: off in works, as it is in scenes]
    #[arg(long)]
    pub guard: Option<GuardArg>,

    /// Steps measured at a time [default: as many as make a million moves, from 10 to 100]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub steps: Option<u32>,

    /// Steps made before
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(..=1_000_000))]
    pub warm_up: u32,

    /// How many times steps are measured
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub repeat: u32,

    /// A file to write, .json or .md; can be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// Writes the runs as JSON to standard output
    #[arg(long)]
    pub json: bool,

    /// Shows no progress bar and no table
    #[arg(short, long)]
    pub quiet: bool,

    /// What of scenes is changed.
    #[command(flatten)]
    pub changes: Changes,
}

/// With the guard, without it, or one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum GuardArg {
    /// With the guard
    On,
    /// Without it
    Off,
    /// One after the other
    Both,
}

impl BenchArgs {
    /// Threads for the steps.
    pub fn threads(&self) -> Vec<usize> {
        #[cfg(feature = "parallel")]
        {
            let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
            match (self.threads.is_empty(), cores) {
                (false, _) => self.threads.clone(),
                (true, 1) => vec![1],
                (true, cores) => vec![1, cores],
            }
        }
        #[cfg(not(feature = "parallel"))]
        vec![1]
    }

    /// With the guard or without, one after the other; `None`: as a scene has it.
    pub fn guards(&self) -> &'static [Option<bool>] {
        match self.guard {
            None => &[None],
            Some(GuardArg::On) => &[Some(true)],
            Some(GuardArg::Off) => &[Some(false)],
            Some(GuardArg::Both) => &[Some(false), Some(true)],
        }
    }

    /// Steps measured at a time where there are so many agents.
    pub fn steps(&self, agents: usize) -> u32 {
        self.steps.unwrap_or_else(|| (1_000_000 / agents.max(1)).clamp(10, 100) as u32)
    }
}

fn parse_count(text: &str) -> Result<usize, String> {
    let (digits, unit) = match text.strip_suffix(['k', 'M']) {
        Some(digits) => (digits, if text.ends_with('k') { 1_000 } else { 1_000_000 }),
        None => (text, 1),
    };
    let count = digits.trim().replace('_', "").parse::<u64>().ok().and_then(|count| count.checked_mul(unit));
    count
        .filter(|count| (1..=MAX_AGENTS).contains(count))
        .map(|count| count as usize)
        .ok_or_else(|| format!("write a whole number from 1 to {MAX_AGENTS}, such as 10000, 10k or 1M"))
}

#[cfg(feature = "parallel")]
fn parse_threads(text: &str) -> Result<usize, String> {
    let threads = text.trim().parse().ok().filter(|threads| (1..=1024).contains(threads));
    threads.ok_or_else(|| "write a whole number from 1 to 1024".into())
}
