//! The command line of `throng sweep`.

use crate::failure::Failure;
use crate::options::{ReportArgs, ThreadArgs};
use crate::seeds::numbers;
use clap::Args;
use std::path::{Path, PathBuf};

/// The examples for `-h`.
pub const SHORT: &str = "\
Examples:
  throng sweep width.toml
  throng sweep width.toml -o width.parquet -o width.csv --threads 8
  throng sweep width.toml --dry-run
  throng sweep width.toml --index 0..9 && throng sweep width.toml --collect

`throng sweep --help` describes plans, tables and the keys of --json.";

/// Plan, table, keys and examples for `--help`.
pub const LONG: &str = "\
A plan is a TOML file; docs/sweeps.md describes it:
  scenes = [\"door.toml\", \"corridor\"]   files relative to the plan, or names of the gallery
  seeds = \"1..10\"                      or [1, 3, 7]; without it, each scene's own seed
  limit = 120                          the latest end of all runs, seconds
  set.time.step = 0.05                 keys of --set, the same for all runs
  [[vary]]                             each table is an axis; the plan makes all combinations of its axes
  body.radius = [0.2, 0.25]            a list of values
  [[vary]]
  count = { from = 50, to = 200, by = 50 }              or { from, to, count }
  speed.preferred = [1.0, 1.1, 1.2, 1.3]                changes together with `count`, as it is in the same table
  [columns]
  speed.preferred = \"speed\"            names of columns, instead of keys
  [[record.line]]                      counts people at a line: door.flow, door.crossed, ..
  name = \"door\"
  from = [0, -1]
  to = [0, 1]
  [[record.area]]                      density and speed in an area: front.density, ..
  name = \"front\"
  shape.rectangle = { center = [-1, 0], size = [2, 2] }

Outputs, by the ending of the name: .parquet, .csv, .json; one row a run, in the order of their numbers:
  index, scene              number of the run, from 0, and name of the scene
  KEY                       every parameter that varies
  seed, error               seed; why the run could not be made, else null
  state_hash                hash of the last state: the same for the same bits
  agents, arrived, time, overlaps, ..   the figures of `throng run --json`, but for those that depend on the machine
  mean_speed                of walking agents, over the run, m/s
  passed, failed            whether the run met the scene's [expect], and what it did not meet; null without [expect]
  NAME.flow, ..             the figures of lines, areas and people of `throng measure --json`
  figures.NAME              what the rules of a game count
The bytes are the same for any number of threads, and however often the sweep was interrupted.

The result of each finished run is kept in a folder beside the table (NAME.runs). The same command makes only the runs
that are missing: those that an interrupt left, and those that changed since, with the scene, a file that the scene
names, a parameter, or the version of this program. --index makes some of the runs without writing the table, so that
several machines can share a folder; --collect writes the table of finished runs. In a job array of Slurm:
  throng sweep plan.toml --index $SLURM_ARRAY_TASK_ID

Keys of --json (one object on standard output):
  plan, runs            name of the plan; its number of runs
  chosen                number of the runs of --index, else of all runs
  made, kept            runs made now; runs that were kept before
  failed                [{ index, error }]: runs that could not be made
  folder, files         the folder of finished runs; the tables written
  wall_seconds          seconds the whole command took
  interrupted           whether it was interrupted
With --dry-run: { plan, runs, folder, list: [{ index, scene, parameters: { .. }, seed, kept }] }.

Exit codes: 0 done; 1 a run could not be made, and its row says why; 2 an error; 130 interrupted: the same command makes
the rest.

Examples:
  throng sweep width.toml
      writes width.parquet
  throng sweep width.toml -o width.parquet -o width.csv --threads 8
  throng sweep width.toml --dry-run
      lists the runs and which of them are finished
  throng sweep width.toml --index 0..9
  throng sweep width.toml --collect
      the table of runs that other commands made";

/// The arguments of `throng sweep`.
#[derive(Args, Debug)]
pub struct SweepArgs {
    /// The plan: a TOML file with scenes, parameters and seeds
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,

    /// A table to write, .parquet, .csv or .json; can be given several times [default: <plan>.parquet]
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// The folder that keeps the results of finished runs [default: the first table's name with .runs]
    #[arg(long, value_name = "FOLDER")]
    pub runs: Option<PathBuf>,

    /// Makes only the runs with these numbers, such as 0..9 (0 to 9) or 1,3,7, and writes no table
    #[arg(long, value_name = "RUNS", conflicts_with_all = ["collect"])]
    pub index: Option<String>,

    /// Makes no runs: writes the table of the finished ones, which must be all
    #[arg(long)]
    pub collect: bool,

    /// Lists the runs and makes none
    #[arg(long, conflicts_with_all = ["collect"])]
    pub dry_run: bool,

    /// The number of threads; each makes one run at a time.
    #[command(flatten)]
    pub threads: ThreadArgs,

    /// How results are reported.
    #[command(flatten)]
    pub report: ReportArgs,
}

impl SweepArgs {
    /// Returns the tables to write.
    pub fn tables(&self) -> Vec<PathBuf> {
        if self.output.is_empty() {
            let stem = self.plan.file_stem().unwrap_or(self.plan.as_os_str());
            return vec![Path::new(stem).with_extension("parquet")];
        }
        self.output.clone()
    }

    /// Returns the folder of finished runs.
    pub fn folder(&self) -> PathBuf {
        self.runs.clone().unwrap_or_else(|| self.tables()[0].with_extension("runs"))
    }

    /// Returns the numbers of the chosen runs of a plan with `count` runs, in order.
    ///
    /// # Errors
    /// A number is not whole, is given twice, or is not that of a run.
    pub fn chosen(&self, count: usize) -> Result<Vec<usize>, Failure> {
        let Some(text) = &self.index else { return Ok((0..count).collect()) };
        let numbers = numbers("--index", "run", text)?;
        let inside = |number: &u64| usize::try_from(*number).ok().filter(|number| *number < count).ok_or(*number);
        numbers.iter().map(inside).collect::<Result<_, _>>().map_err(|number| {
            let hint = format!("the runs are 0..{}; `--dry-run` lists them", count - 1);
            Failure::hint(format!("--index {text}: there is no run {number}"), hint)
        })
    }
}
