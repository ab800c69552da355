//! The command line of `throng compare`.

use super::contender::Contender;
use crate::failure::Failure;
use crate::models::distinct;
use crate::options::{EndArgs, FilmArgs, ReportArgs, ThreadArgs};
use crate::seeds::seeds;
use crate::source::SceneArgs;
use clap::Args;
use std::path::PathBuf;

/// The examples for `-h`.
pub const COMPARE_SHORT: &str = "\
Examples:
  throng compare circle
  throng compare circle --models vo,rvo,hrvo,orca --seeds 1..5 -o circle.html
  throng compare doorway --models orca,orca:time_horizon=4 -o doorway.mp4
  throng compare lab.toml --models rvo,orca --seeds 1..5 --bounds lab.bounds.toml --junit grades.xml

`throng compare --help` describes the outputs and the keys of --json.";

/// Outputs, keys and examples for `--help`.
pub const COMPARE: &str = "\
Outputs, by the ending of the name:
  .html             one page without network: the table, figures over time, a player of all models on one
                    clock, and the moments at which velocities swing most. page.html#t=12.5 opens at 12.5 s
  .mp4 .gif .avi    video, the models side by side; also .webm and others through ffmpeg
  .png, .svg        one picture of the same: the moment of --frame, else of the scene's
                    `view.moment`, else that at which the models differ most (docs/compare.md)
  NAME/             a folder of PNG files, one a picture
  .csv              every run: one line per model and seed
  .md               the table

Pictures, video and page show the first seed. Every run has one thread, so that speeds are comparable; several
run at a time. Files get their names when they are complete. Ctrl-C ends the runs and completes the files.

Keys of --json (one object on standard output):
  scene, seeds     name of the scene; the seeds, in order
  models           [{ model, median: { .. }, least: { .. }, most: { .. }, runs: [{ seed, .. }] }], the figures under
                   the keys of `throng run --json`, and
                     us_per_agent_step  microseconds of processor time per move of one agent by one sub-step
                     interrupted        whether the run was interrupted
  wall_seconds     seconds the whole comparison took
  grades           with --bounds: { bounds: the file, passed, models: [{ model, passed, runs: [{ seed, passed,
                   checks: [{ measure, at_least, at_most, found, passed }] }] }] }; else null
  interrupted      whether the comparison was interrupted: figures cover the time until then, without runs not begun
  files            the files written

The [expect] of the scene is not checked: models are compared because they differ. --bounds grades them: every run of
every model must be within the bounds of a TOML file (docs/compare.md lists the measures), such as
  [bounds]
  arrived_share = { at_least = 1 }
  overlap_depth = { at_most = 0.01 }
  time = { at_least = 10, at_most = 40 }

Exit codes: 0 done; 1 a run is outside the bounds; 2 an error; 130 interrupted.

Examples:
  throng compare circle
      the velocity obstacle family, a table
  throng compare circle --seeds 1..5 -o circle.html -o circle.mp4
  throng compare doorway --models orca,orca:time_horizon=4,orca:time_horizon=1:neighbours=5
      one model with several settings
  throng compare lab.toml --models rvo,orca --seeds 1..5 --bounds lab.bounds.toml --junit grades.xml
      grades: a run outside the bounds fails, by the exit code and in the report of tests
  throng compare lab.toml --models mine.py,orca --bounds lab.bounds.toml
      a model in Python beside one of the engine
  throng compare station.wkt --exit 10,0,2,4 --people 500 --models rvo,orca -o station.csv";

/// The arguments of `throng compare`.
#[derive(Args, Debug)]
pub struct CompareArgs {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,

    /// The local models, with commas between them
    ///
    /// The names are those of `avoid.NAME` in scene files (`-` is `_`). Values of a model's keys come after colons:
    /// orca:time_horizon=4:neighbours=20. A model replaces the model of every group and keeps the group's `neighbours`
    /// and `neighbour_distance`; a group that already has the model keeps all its values.
    ///
    /// mine.py is the model of a file of Python, mine.py:NAME one of several. They are functions with @throng_sim.model, of
    /// the Python package. The program runs `python3`, or the program that the environment variable PYTHON names.
    #[arg(short, long, value_name = "MODEL,..", value_delimiter = ',', default_value = "vo,rvo,hrvo,orca")]
    pub models: Vec<String>,

    /// The seeds, such as 1..5 (1 to 5) or 1,3,7 [default: the scene's]
    #[arg(long, value_name = "SEEDS", conflicts_with = "seed")]
    pub seeds: Option<String>,

    /// A file to write, its kind by its ending; can be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// When the runs end.
    #[command(flatten)]
    pub end: EndArgs,

    /// Grades the runs by the bounds of a TOML file: the exit code is 1 if a run is outside
    #[arg(long, value_name = "FILE", help_heading = "Grades")]
    pub bounds: Option<PathBuf>,

    /// Writes the grades as JUnit XML: a test suite for each model, a test for each seed and bound
    #[arg(long, value_name = "FILE", requires = "bounds", help_heading = "Grades")]
    pub junit: Option<PathBuf>,

    /// Shows every run in the table, not only medians and ranges
    #[arg(long)]
    pub all: bool,

    /// The number of threads.
    #[command(flatten)]
    pub threads: ThreadArgs,

    /// How results are reported.
    #[command(flatten)]
    pub report: ReportArgs,

    /// The moments that pictures show, and how pictures look; --size is the size of all panels together.
    #[command(flatten)]
    pub film: FilmArgs,
}

impl CompareArgs {
    /// Returns the models, in order.
    ///
    /// # Errors
    /// A model does not exist, has no such key, or is given twice.
    pub fn models(&self) -> Result<Vec<Contender>, Failure> {
        let models = self.models.iter().map(|text| Contender::named(text)).collect::<Result<Vec<_>, _>>()?;
        distinct("--models", models.iter().map(Contender::label))?;
        Ok(models)
    }

    /// Returns the seeds, in order; `default` where none are given.
    ///
    /// # Errors
    /// A seed is not a whole number or is given twice, or there are too many seeds.
    pub fn seeds(&self, default: u64) -> Result<Vec<u64>, Failure> {
        self.seeds.as_deref().map_or(Ok(vec![default]), seeds)
    }
}
