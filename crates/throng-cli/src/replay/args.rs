//! The command line of `throng replay`.

use crate::look::{parse_not_negative, parse_positive};
use crate::map::MapArgs;
use crate::measure::args::parse_line;
use crate::options::{FilmArgs, ReportArgs, ThreadArgs};
use crate::tracks::TrackArgs;
use clap::Args;
use std::path::PathBuf;
use throng_record::pedestrian::Line;
use throng_record::pedestrian::replay::Pace;

/// The number of points of the plot over prediction horizons.
const AHEAD: u32 = 16;

/// The examples for `throng replay -h`.
pub const SHORT: &str = "\
Examples:
  throng replay zara01/obsmat.txt --map-offset 0.5,16.2 -o zara01.mp4
  throng replay corridor.txt --map corridor.wkt --line 0,0,0,5
  throng replay corridor.txt --model orca --model rvo:time_horizon=4 --table people.csv -o corridor.html

`throng replay --help` describes the outputs and the keys of --json; docs/replay.md defines the figures.";

/// The description, outputs, keys and examples for `throng replay --help`.
pub const LONG: &str = "\
Every agent enters at the time and place of the first sample of a recorded person, with the person's velocity, and walks
to the place of the last sample at the person's own speed. Where the person stands for a second or more, not in a jam,
the agent stands until the person goes on (not with --no-pauses). An agent that arrives leaves; if the person stood at
the end, the agent stays until the person leaves. Goals and pauses are known in advance: this does not predict real
people. docs/replay.md defines the figures.

Walls come from --map, else from the recording, else from a map.xml beside it; groups come from --groups, else from a
groups.txt beside it. The model does not use groups: figures are given separately for people in groups and people alone.

Outputs, by the ending of the name:
  .html             one page without network: the tables, a player of the recording and every model on one clock, plots
  .mp4 .gif .avi    video, recorded and replayed people side by side; also .webm and other kinds that ffmpeg writes
  .png, .svg        one picture of the same: the last moment, or that of --frame
  NAME/             a folder of PNG files, one a picture
  .csv .parquet .rec .glb ..   trajectories of the agents, every step, as `throng run` writes them; one file per model,
                    with several models named: again.csv becomes again-orca.csv, again-hrvo.csv

Files get their names when they are complete. Ctrl-C ends the replay and completes the files.

Keys of --json (one object on standard output; metres, seconds):
  data, step             the recording; seconds of a step
  from, until            time of the first and of the last moment
  map                    { areas, obstacles: numbers; through: number of recorded people walking through solids }
  recorded               entered: number of people; seen_once; pauses: { people, count, seconds } of the agents;
                         speed, nearest: { mean, median }; crossings: null, or { mean, median } of the times at which
                         --line is crossed; people: as in `throng measure --json`
  models                 [{ model, .. }], each with
    entered, overlapping (entered onto another agent), moved (out of a solid), refused, goals_moved, arrived,
    stranded (cannot reach their goals), walking (at the end)
    delay                seconds from the recorded leaving to the arrival, median
    speed, nearest       { mean, median, distance: Kolmogorov-Smirnov distance from the recording }
    crossings            null, or { mean, median, distance }
    people               as in `throng measure --json`
    microscopic          every 0.4 s, also in `recorded`: standing (share), speed_deviation (of a person's own speed),
                         turning, acceleration: { median, p99 }, head_on: { pairs, median, p5: least distance },
                         g (at 0.4, 0.8, .. 4 s to collision), g_rms (root mean square of its difference from the
                         recording's)
    summary              of the world: least_separation, overlaps, guard_share
  from_entry             [{ horizon, people, average: { MODEL, .., constant_velocity, straight }, final: the same }],
                         each { mean, median } by predictor; horizon null: the time of the last recorded sample
  predicted              null, or { every, moments, horizons: the same list,
                         alone, in_groups: for the longest horizon, or null }
  wall_seconds, interrupted, files
Unknown values are null.

Exit codes: 0 done; 2 an error; 130 interrupted.

Examples:
  throng replay zara01/obsmat.txt --map-offset 0.5,16.2
      a table of figures; walls from zara01/map.xml, which has another origin, groups from zara01/groups.txt
  throng replay zara01/obsmat.txt -o zara01.mp4 -o orca.csv --table people.csv
      side-by-side video, trajectories of the agents, and a table with one line per person
  throng replay corridor.txt --map corridor.wkt --line 0,0,0,5 --from 20 --until 60 --json
      a part of the recording, on a floor plan, counted at a line
  throng replay obsmat.txt --model orca,hrvo,rvo -o models.html --table people.csv
      several models in one table, on one page, and side by side
  throng replay obsmat.txt --model hrvo --set keep_right=0 --speed 90% --every 0
      another model, without its bias to the right, faster people, no predictions";

/// The arguments of `throng replay`.
#[derive(Args, Debug)]
pub struct ReplayArgs {
    /// Recorded people: a file of trajectories (`throng info`)
    #[arg(value_name = "DATA")]
    pub data: PathBuf,

    /// The people and the ground they walk on.
    #[command(flatten)]
    pub stage: StageArgs,

    /// Leaves out everything before this time, seconds of the recording: people present then enter at their places then
    #[arg(long, value_name = "SECONDS", value_parser = parse_not_negative, default_value_t = 0.0)]
    pub from: f64,

    /// Leaves out everything after this time [default: the end]
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive)]
    pub until: Option<f64>,

    /// How the replay is compared.
    #[command(flatten)]
    pub figures: FigureArgs,

    /// How a file of trajectories is read.
    #[command(flatten)]
    pub tracks: TrackArgs,

    /// A file to write, its kind by its ending; can be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// The table of people to write, .csv: one line per person, with the displacements of the models and the two simple
    /// predictors
    #[arg(long, value_name = "FILE")]
    pub table: Option<PathBuf>,

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

/// Options for the people and the ground they walk on.
#[derive(Args, Debug)]
#[command(next_help_heading = "People")]
pub struct StageArgs {
    /// The map.
    #[command(flatten)]
    pub map: MapArgs,

    /// Walks on open ground, without any map
    #[arg(long, conflicts_with_all = ["map", "map_offset"])]
    pub no_map: bool,

    /// The groups of people: one line per group with the numbers of its members [default: a groups.txt beside the file]
    #[arg(long, value_name = "FILE")]
    pub groups: Option<PathBuf>,

    /// The local model, as in `throng compare`: its name, and values of its keys after colons; can be given several
    /// times, or several with commas between them
    #[arg(short, long, value_name = "MODEL,..", value_delimiter = ',', default_value = "orca")]
    pub model: Vec<String>,

    /// Changes a value of the agents' scene, which has one group; can be given several times
    ///
    /// As in `throng run`: --set avoid.orca.time_horizon=3, --set keep_right=0, --set speed.max=2, --set
    /// time.sub_steps=4.
    #[arg(long, value_name = "KEY=VALUE", value_parser = crate::source::parse_change)]
    pub set: Vec<(String, String)>,

    /// Seconds of a step [default: 0.04]
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive)]
    pub step: Option<f64>,

    /// The seed of the random number generator
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(..=i64::MAX as u64))]
    pub seed: Option<u64>,

    /// Preferred speeds: the `mean` or a quantile such as 50% of each person's own speeds while walking; or m/s for all
    /// agents
    #[arg(long, value_name = "SPEED", value_parser = parse_pace, default_value = "50%")]
    pub speed: Pace,

    /// Radius of all bodies, metres [default: from the file, else 0.2]
    #[arg(long, value_name = "METRES", value_parser = parse_positive)]
    pub radius: Option<f64>,

    /// Distance to the goal within which an agent has arrived, metres
    #[arg(long, value_name = "METRES", value_parser = parse_positive, default_value_t = 0.3)]
    pub near: f64,

    /// Ignores the recorded pauses: agents do not stand on the way
    #[arg(long)]
    pub no_pauses: bool,

    /// Keeps every arrived agent until its recorded person leaves, even if the person did not stand at the end
    #[arg(long)]
    pub stay: bool,
}

/// Options for comparing recorded and replayed people.
#[derive(Args, Debug)]
#[command(next_help_heading = "Figures")]
pub struct FigureArgs {
    /// Prediction horizons at which positions are compared, seconds
    #[arg(long, value_name = "SECONDS,..", value_delimiter = ',', value_parser = parse_positive, default_value = "1,2,4")]
    pub horizons: Vec<f64>,

    /// Interval between the starts of predictions, seconds: all agents start at the recorded positions; 0 for no
    /// predictions
    #[arg(long, value_name = "SECONDS", value_parser = parse_not_negative, default_value_t = 1.0)]
    pub every: f64,

    /// Interval over which a velocity is taken, seconds
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive, default_value_t = 0.4)]
    pub interval: f64,

    /// Line at which people are counted, from one end to the other, metres
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = parse_line, allow_hyphen_values = true)]
    pub line: Option<Line>,
}

impl FigureArgs {
    /// Returns the horizons of the plot, seconds: evenly spaced up to the longest horizon.
    pub fn ahead(&self) -> impl Iterator<Item = f64> {
        let longest = self.horizons.iter().copied().fold(0.0, f64::max);
        (1..=AHEAD).map(move |k| longest * f64::from(k) / f64::from(AHEAD))
    }
}

fn parse_pace(text: &str) -> Result<Pace, String> {
    let wrong = || "write mean, a part such as 50%, or a speed in m/s".to_owned();
    if text == "mean" {
        return Ok(Pace::Mean);
    }
    match text.strip_suffix('%') {
        Some(part) => {
            let part = parse_not_negative(part).ok().filter(|&part| part <= 100.0).ok_or_else(wrong)?;
            Ok(Pace::Quantile(0.01 * part))
        }
        None => Ok(Pace::Constant(parse_positive(text).ok().filter(|&speed| speed <= 1000.0).ok_or_else(wrong)?)),
    }
}
