//! What `throng measure` is told, and its help.

use crate::look::{parse_not_negative, parse_positive};
use crate::options::ThreadArgs;
use crate::source::Changes;
use clap::Args;
use std::path::PathBuf;

/// After `throng measure -h`.
pub const SHORT: &str = "\
Examples:
  throng measure flocking
  throng measure flocking --from 5 --to 20 -o flock.html
  throng run flocking -o flock.csv && throng measure flock.csv --json

`throng measure --help` describes the keys of --json; docs/swarms.md, what the figures mean.";

/// After `throng measure --help`.
pub const LONG: &str = "\
Velocities and accelerations are those of the positions at three moments on end, the steps of a scene or the moments of a
table. docs/swarms.md says how each figure is counted, and what is known of real swarms.

Keys of --json (one object on standard output; metres, seconds):
  scene            name of the scene or the table
  groups           [{ .. }], each with
    name             of the group
    from, to         the first moment and the last
    moments          how many there were
    agents           how many were there, the mean over moments
    speed, nearest   { count, mean, sd, rms, least, most, skewness, kurtosis, pdf: [[middle, density], ..] }
    velocity, acceleration   [x, y, z], each the same
    correlation      { time: when it first falls to 1/e, points: [[lag, value], ..] }
    size, axes       the radius of gyration, and its parts along [x, y, z]: means over moments
    polarisation     the mean over moments
    over_time        [[time, agents, size, polarisation, speed], ..], at most 500
  files            the files written
What is not known is null.

Examples:
  throng measure flocking
  throng measure flocking --group birds --from 5 --to 20 -o flock.html
      one page without network, with plots
  throng measure midges.csv --lag 1 --json
      a table with the columns number, time, x, y, and perhaps group and z";

/// What `throng measure` is told.
#[derive(Args, Debug)]
pub struct MeasureArgs {
    /// A scene (see `throng run`), or a table of trajectories (.csv), as `throng run -o NAME.csv` writes it
    #[arg(value_name = "SCENE|TABLE")]
    pub of: PathBuf,

    /// What of the scene is changed.
    #[command(flatten)]
    pub changes: Changes,

    /// Measures this group only [default: all of them, each for itself]
    #[arg(short, long, value_name = "NAME")]
    pub group: Option<String>,

    /// Leaves out what comes before, seconds
    #[arg(long, value_name = "SECONDS", value_parser = parse_not_negative, default_value_t = 0.0)]
    pub from: f64,

    /// Leaves out what comes after, seconds [default: the end of the scene, or of the table]
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive)]
    pub to: Option<f64>,

    /// How much later velocities are compared with themselves, seconds
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive, default_value_t = 2.0)]
    pub lag: f64,

    /// A page of plots to write, .html; can be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// How many threads.
    #[command(flatten)]
    pub threads: ThreadArgs,

    /// Shows no progress bar and no figures
    #[arg(short, long)]
    pub quiet: bool,

    /// Writes the figures as one JSON object to standard output
    #[arg(long)]
    pub json: bool,
}
