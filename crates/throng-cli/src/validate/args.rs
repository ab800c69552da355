//! The command line of `throng validate`.

use super::families;
use crate::failure::Failure;
use crate::models::models;
use crate::options::ThreadArgs;
use crate::seeds::seeds;
use crate::source::parse_change;
use clap::Args;
use std::path::PathBuf;
use throng_record::validate::{EXPERIMENTS, Experiment};
use throng_scene::Model;

/// The examples, for `-h`.
pub const SHORT: &str = "\
Examples:
  throng validate --list
  throng validate
  throng validate door corridor --model hrvo --seeds 1..3
  throng validate --quick -o report.html

`throng validate --help` says what is measured, and describes the keys of --json.";

/// What is measured, keys and examples, for `--help`.
pub const LONG: &str = "\
Runs the geometries of experiments with people, with the defaults of the engine or with other settings, and measures them as the experiments were measured.
Each figure stands beside what people did, what the best model of JuPedSim and RVO2 do in the same geometry, and what this engine did before its
interaction rules were rebuilt. A figure with a tolerance is `ok` or `outside`. docs/validation.md describes every experiment, figure and source.

Outputs, by the ending of the name:
  .html             one page without network: the tables, and plots with the measured points of the experiments
  .json             the same as --json

Keys of --json (one object on standard output):
  version, model, set, seeds    of this program; the model and the changes that were asked for; the seeds, in order
  quick                         whether only the quick selection ran
  experiments                   [{ name, title, source, figures: [{ case, name, unit, mean, deviation, values, people,
                                jupedsim, rvo2, before, tolerance, ok }] }]: `values` by seed, `tolerance` from where to where,
                                `ok` null where there is no tolerance
  required, met                 how many figures have a tolerance; how many of them are within it
  wall_seconds, interrupted     seconds it all took; whether it was interrupted
What is infinite or not known is null.

`throng validate families` runs random variants of scenes (width, number, density, rotation, shift and seed drawn at random) and checks in each that every
agent arrives, that none walks for 30 s without getting anywhere, that arrived agents are in their goals, and that no two overlap. It counts the
failures by family and names each with what reproduces it. Its --json: { version, model, seed, runs, families: [{ name, runs, failed, flaws }],
failed: [{ trial, name, flaws }], wall_seconds, interrupted }.

Exit codes: 0 all figures are within their tolerances; 1 one is outside, or a run of families failed; 2 an error; 130 interrupted.

Examples:
  throng validate --list
      the experiments and their cases
  throng validate
      all of them, five seeds
  throng validate door corridor --model hrvo --seeds 1..3
  throng validate --set body.radius=0.25 --json > wide.json
  throng validate --quick -o report.html
  throng validate loop --keep scenes/
      writes the scene files too, for `throng run` and the studio
  throng validate families --runs 500 --keep failed/
      random variants of scenes: does every agent arrive, none oscillate, none overlap?";

/// What `throng validate` is told.
#[derive(Args, Debug)]
pub struct ValidateArgs {
    /// Which experiments (see --list), or `families` [default: all experiments]
    #[arg(value_name = "EXPERIMENT")]
    pub experiments: Vec<String>,

    /// Lists the experiments and their cases
    #[arg(long)]
    pub list: bool,

    /// The local model of all agents, as for `throng compare` [default: the engine's]
    #[arg(short, long, value_name = "MODEL")]
    pub model: Option<String>,

    /// Changes one value of every scene; can be given several times
    ///
    /// KEY is the path of the value in scene files, as for `throng run`.
    #[arg(long, value_name = "KEY=VALUE", value_parser = parse_change)]
    pub set: Vec<(String, String)>,

    /// The seeds, such as 1..5 (1 to 5) or 1,3,7 [default: 1..5, with --quick 1]
    #[arg(long, value_name = "SEEDS")]
    pub seeds: Option<String>,

    /// Runs a selection of the cases, one seed
    #[arg(long)]
    pub quick: bool,

    /// How many threads; each takes a run at a time.
    #[command(flatten)]
    pub threads: ThreadArgs,

    /// Of `families`: how many runs
    #[arg(long, value_name = "N", default_value_t = 500, value_parser = clap::value_parser!(u64).range(1..=1_000_000), help_heading = "Random families")]
    pub runs: u64,

    /// Of `families`: the seed that all variants follow from
    #[arg(long, value_name = "N", default_value_t = 1, help_heading = "Random families")]
    pub seed: u64,

    /// Of `families`: only the run with this index
    #[arg(long, value_name = "INDEX", value_parser = clap::value_parser!(u64).range(..=u64::MAX - 1), help_heading = "Random families")]
    pub trial: Option<u64>,

    /// A file to write, .html or .json; can be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// Writes the scenes into this folder, as scene files; of `families` those of the runs that failed
    #[arg(long, value_name = "FOLDER")]
    pub keep: Option<PathBuf>,

    /// Writes the figures as one JSON object to standard output
    #[arg(long)]
    pub json: bool,

    /// Shows no progress bar and no table
    #[arg(short, long)]
    pub quiet: bool,
}

impl ValidateArgs {
    /// Whether the random families are asked for, instead of experiments.
    ///
    /// # Errors
    /// Both are asked for, or a file is to be written that there is none of.
    pub fn asks_families(&self) -> Result<bool, Failure> {
        let asked = self.experiments.iter().any(|name| name == families::NAME);
        if asked && self.experiments.len() > 1 {
            let text = format!("`{}` and experiments are asked for", families::NAME);
            return Err(Failure::hint(text, "ask for one of the two at a time"));
        }
        if asked && !self.output.is_empty() {
            return Err(Failure::hint("random families have no report to write", "use --json"));
        }
        Ok(asked)
    }

    /// The experiments, in the order in which they are listed.
    ///
    /// # Errors
    /// There is no such experiment.
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

    /// The local model, where one is given.
    ///
    /// # Errors
    /// There is no such model, or it has no such key.
    pub fn model(&self) -> Result<Option<Model>, Failure> {
        Ok(models("--model", self.model.as_slice())?.into_iter().next())
    }

    /// The seeds, in order.
    ///
    /// # Errors
    /// They are no whole numbers, too many, or one comes twice.
    pub fn seeds(&self) -> Result<Vec<u64>, Failure> {
        match (&self.seeds, self.quick) {
            (Some(text), _) => seeds(text),
            (None, true) => Ok(vec![1]),
            (None, false) => Ok((1..=5).collect()),
        }
    }
}
