//! The command line of `throng validate`.

use super::families;
use crate::failure::Failure;
use crate::models::models;
use crate::options::{ReportArgs, ThreadArgs};
use crate::seeds::seeds;
use crate::source::parse_change;
use clap::Args;
use std::path::PathBuf;
use throng_record::validate::{EXPERIMENTS, Experiment};
use throng_scene::Model;

/// The examples for `-h`.
pub const SHORT: &str = "\
Examples:
  throng validate --list
  throng validate
  throng validate door corridor --model hrvo --seeds 1..3
  throng validate --quick -o report.html

`throng validate --help` describes what is measured and the keys of --json.";

/// The measurement, keys and examples for `--help`.
pub const LONG: &str = "\
Runs the geometries of experiments with people, with the defaults of the engine or other settings, and measures them as
in the experiments. Each figure stands beside the people's value, the values of JuPedSim's best model and of RVO2 in the
same geometry, and this engine's value before its interaction rules were rebuilt. A figure with a tolerance is `ok` or
`outside`. docs/validation.md describes every experiment, figure and source.

Outputs, by the ending of the name:
  .html             one page without network: the tables, and plots with the measured points of the experiments
  .json             the same as --json

Keys of --json (one object on standard output):
  version, model, set, seeds    version of this program; the given model and changes; the seeds, in order
  quick                         whether only the quick selection ran
  experiments                   [{ name, title, source, figures: [{ case, name, unit, mean, deviation, values, people,
                                jupedsim, rvo2, before, tolerance, ok }] }]: `values` by seed,
                                `tolerance` [least, greatest], `ok` null without tolerance
  required, met                 number of figures with a tolerance; number of those within it
  wall_seconds, interrupted     seconds the validation took; whether it was interrupted
Infinite and unknown values are null.

`throng validate families` runs random variants of scenes (random width, number, density, rotation, shift and seed) and
checks in each that every agent arrives, that no agent walks for 30 s without progress, that arrived agents are in their
goals, and that no two agents overlap. It counts the failures by family and lists them with the options that reproduce
them. Its --json: { version, model, seed, runs, families: [{ name, runs, failed, flaws }],
failed: [{ trial, name, flaws }], wall_seconds, interrupted }.

Exit codes: 0 all figures are within their tolerances; 1 a figure is outside, or a run of families failed; 2 an error;
130 interrupted.

Examples:
  throng validate --list
      the experiments and their cases
  throng validate
      all experiments, five seeds
  throng validate door corridor --model hrvo --seeds 1..3
  throng validate --set body.radius=0.25 --json > wide.json
  throng validate --quick -o report.html
  throng validate loop --keep scenes/
      also writes the scene files, for `throng run` and the studio
  throng validate families --runs 500 --keep failed/
      random variants of scenes: does every agent arrive, none oscillate, none overlap?";

/// The arguments of `throng validate`.
#[derive(Args, Debug)]
pub struct ValidateArgs {
    /// The experiments (see --list), or `families` [default: all experiments]
    #[arg(value_name = "EXPERIMENT")]
    pub experiments: Vec<String>,

    /// Lists the experiments and their cases
    #[arg(long)]
    pub list: bool,

    /// The local model of all agents, as in `throng compare` [default: the engine's]
    #[arg(short, long, value_name = "MODEL")]
    pub model: Option<String>,

    /// Changes one value of every scene; can be given several times
    ///
    /// KEY is the path of the value in scene files, as in `throng run`.
    #[arg(long, value_name = "KEY=VALUE", value_parser = parse_change)]
    pub set: Vec<(String, String)>,

    /// The seeds, such as 1..5 (1 to 5) or 1,3,7 [default: 1..5, with --quick 1]
    #[arg(long, value_name = "SEEDS")]
    pub seeds: Option<String>,

    /// Runs a selection of the cases, one seed
    #[arg(long)]
    pub quick: bool,

    /// The number of threads; each makes one run at a time.
    #[command(flatten)]
    pub threads: ThreadArgs,

    /// For `families`: the number of runs
    #[arg(long, value_name = "N", default_value_t = 500, value_parser = clap::value_parser!(u64).range(1..=1_000_000), help_heading = "Random families")]
    pub runs: u64,

    /// For `families`: the seed that determines all variants
    #[arg(long, value_name = "N", default_value_t = 1, help_heading = "Random families")]
    pub seed: u64,

    /// For `families`: makes only the run with this index
    #[arg(long, value_name = "INDEX", value_parser = clap::value_parser!(u64).range(..=u64::MAX - 1), help_heading = "Random families")]
    pub trial: Option<u64>,

    /// A file to write, .html or .json; can be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// Writes the scenes into this folder, as scene files; for `families` those of failed runs
    #[arg(long, value_name = "FOLDER")]
    pub keep: Option<PathBuf>,

    /// How results are reported.
    #[command(flatten)]
    pub report: ReportArgs,
}

impl ValidateArgs {
    /// Whether the random families are requested instead of experiments.
    ///
    /// # Errors
    /// Families and experiments are requested together, or an output file is given for families.
    pub fn asks_families(&self) -> Result<bool, Failure> {
        let asked = self.experiments.iter().any(|name| name == families::NAME);
        if asked && self.experiments.len() > 1 {
            let text = format!("`{}` cannot be combined with experiments", families::NAME);
            return Err(Failure::hint(text, "run them separately"));
        }
        if asked && !self.output.is_empty() {
            return Err(Failure::hint("random families have no report to write", "use --json"));
        }
        Ok(asked)
    }

    /// Returns the experiments, in the order of the list.
    ///
    /// # Errors
    /// An experiment does not exist.
    pub fn experiments(&self) -> Result<Vec<&'static Experiment>, Failure> {
        let known = |name: &str| EXPERIMENTS.iter().any(|experiment| experiment.name == name);
        if let Some(unknown) = self.experiments.iter().find(|name| !known(name)) {
            let names: Vec<&str> = EXPERIMENTS.iter().map(|experiment| experiment.name).collect();
            let text = format!("there is no experiment `{unknown}`");
            return Err(Failure::hint(text, format!("the experiments are {}", names.join(", "))));
        }
        let asked = |experiment: &&Experiment| {
            self.experiments.is_empty() || self.experiments.iter().any(|name| name == experiment.name)
        };
        Ok(EXPERIMENTS.iter().filter(asked).collect())
    }

    /// Returns the local model, if one is given.
    ///
    /// # Errors
    /// The model does not exist or has no such key.
    pub fn model(&self) -> Result<Option<Model>, Failure> {
        Ok(models("--model", self.model.as_slice())?.into_iter().next())
    }

    /// Returns the seeds, in order.
    ///
    /// # Errors
    /// A seed is not a whole number or is given twice, or there are too many seeds.
    pub fn seeds(&self) -> Result<Vec<u64>, Failure> {
        match (&self.seeds, self.quick) {
            (Some(text), _) => seeds(text),
            (None, true) => Ok(vec![1]),
            (None, false) => Ok((1..=5).collect()),
        }
    }
}
