//! The command line of `throng bench`.

use crate::options::ReportArgs;
use crate::source::Changes;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use throng_scene::MAX_AGENTS;

/// The examples for `-h`.
pub const SHORT: &str = "\
Examples:
  throng bench
  throng bench crossing --agents 10k 100k --threads 1 2 --guard both
  throng bench circle office

`throng bench --help` describes what is measured and the keys of --json.";

/// The measurement, keys and examples for `--help`.
pub const LONG: &str = "\
A world is built and makes the steps of --warm-up. Then copies of it make the same --steps, once for each number of
threads, and all that --repeat times, after one step that is not measured. The results are medians, in nanoseconds per
move of one agent by one sub-step: wall-clock time, least wall-clock time of the repeats, processor time of all threads,
and wall-clock time of each stage. Bytes per agent: everything that the world has allocated after the warm-up.

Steps of works are 0.1 s long (`hall`, `rooms` and `evacuation`: 0.05 s) and not divided. Steps of
flocks are 1/30 s long, those of swarms 1/60 s.

Keys of --json (a list of runs, one object each):
  work, agents, threads        name of the work or scene; number of agents when measuring begins; threads for the steps
  guard                        on, off, or some: for some of the agents
  ns_per_agent_step            wall-clock nanoseconds per move of one agent by one sub-step, median
  least_ns_per_agent_step      the same, least
  cpu_ns_per_agent_step        processor time, all threads, median; null where the system does not report it
  stages                       { perceive, intend, avoid, guard, move }: wall-clock nanoseconds, medians
  cpu_per_simulated_second     processor seconds per simulated second, median
  bytes_per_agent              bytes allocated for the world, per agent
  warm_up, steps, repeats      steps before measuring; steps per repeat; number of repeats
  step_seconds                 simulated seconds per step
  agent_steps                  moves of one agent by one sub-step in `steps` steps
  version, profile             of this program: its version, and how it was built, `release` or `dev`
  machine                      { cpu, cores, instructions, system, load }: widest SIMD instruction set;
                               programs running when measuring began (1 per busy core)

Exit codes: 0 done; 2 an error; 130 interrupted: the figures measured until then are written.

Examples:
  throng bench
      the works for comparing simulators
  throng bench --list
  throng bench all --threads 1 -o here.json
  throng bench crossing crossing-shuffled --agents 10k 100k 1M --guard both
  throng bench densities at-rest
  throng bench ring-1000 scenes/crossing.toml
  throng bench station.wkt --exit 10,0,2,4 --people 500 --set time.step=0.05";

/// The arguments of `throng bench`.
#[derive(Args, Debug)]
pub struct BenchArgs {
    /// Reference works (see --list; `densities` and `all` are several), scenes of the gallery, or files, as for `throng
    /// run` [default: crossing crossing-shuffled]
    ///
    /// The gallery also has a scene `crossing`: name its file, scenes/crossing.toml.
    #[arg(value_name = "WORK|SCENE")]
    pub works: Vec<PathBuf>,

    /// Lists the reference works
    #[arg(long)]
    pub list: bool,

    /// Number of agents in a work, such as 10000 or 10k or 1M [default: those that --list shows]
    #[arg(long, value_name = "N", num_args = 1.., value_delimiter = ',', value_parser = parse_count)]
    pub agents: Vec<usize>,

    /// Threads for the steps [default: 1, and the number of cores]
    #[cfg(feature = "parallel")]
    #[arg(long, value_name = "N", num_args = 1.., value_delimiter = ',', value_parser = parse_threads)]
    pub threads: Vec<usize>,

    /// Whether the guard keeps agents apart [default: off in works; scenes as written]
    #[arg(long)]
    pub guard: Option<GuardArg>,

    /// Steps per repeat [default: enough for a million moves, from 10 to 100]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub steps: Option<u32>,

    /// Steps before measuring
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(..=1_000_000))]
    pub warm_up: u32,

    /// Number of repeats
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub repeat: u32,

    /// A file to write, .json or .md; can be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// How results are reported.
    #[command(flatten)]
    pub report: ReportArgs,

    /// Changes to scenes.
    #[command(flatten)]
    pub changes: Changes,
}

/// Whether to measure with the guard, without it, or both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum GuardArg {
    /// With the guard
    On,
    /// Without it
    Off,
    /// First without, then with the guard
    Both,
}

impl BenchArgs {
    /// Returns the numbers of threads to measure with.
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

    /// Returns the guard settings to measure with, in order; `None` keeps the scene's.
    pub fn guards(&self) -> &'static [Option<bool>] {
        match self.guard {
            None => &[None],
            Some(GuardArg::On) => &[Some(true)],
            Some(GuardArg::Off) => &[Some(false)],
            Some(GuardArg::Both) => &[Some(false), Some(true)],
        }
    }

    /// Returns the steps per repeat for this number of agents.
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
