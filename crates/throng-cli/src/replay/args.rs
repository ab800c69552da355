//! What `throng replay` is told, and its help.

use crate::look::{parse_not_negative, parse_positive};
use crate::map::MapArgs;
use crate::measure::args::parse_line;
use crate::options::{FilmArgs, ThreadArgs};
use crate::tracks::TrackArgs;
use clap::Args;
use std::path::PathBuf;
use throng_record::pedestrian::Line;
use throng_record::pedestrian::replay::Pace;

/// Points of a plot of what is ahead.
const AHEAD: u32 = 16;

/// After `throng replay -h`.
pub const SHORT: &str = "\
Examples:
  throng replay zara01/obsmat.txt --map-offset 0.5,16.2 -o zara01.mp4
  throng replay corridor.txt --map corridor.wkt --line 0,0,0,5
  throng replay corridor.txt --model orca --model rvo:time_horizon=4 --table people.csv -o corridor.html

`throng replay --help` describes the outputs and the keys of --json; docs/replay.md, what the figures mean.";

/// After `throng replay --help`.
pub const LONG: &str = "\
Everybody enters where and when they were recorded first, with their velocity there, and walks to where they were recorded last, at their
own speed; where the recorded one stands for a second or more, though in no jam, the agent stands until that one goes on (not with
--no-pauses). Who is there leaves, or stays until the recorded one leaves if that one stood at the end. Goals and pauses are known in
advance: nothing here predicts real people. docs/replay.md defines the figures.

Walls come from --map, else from what the file says, else from a map.xml beside it; who belongs together, from --groups, else from a
groups.txt beside it. The model knows nothing of groups: figures are told for those in groups and those alone.

Outputs, by the ending of the name:
  .html             one page without network: the tables, a player of the recorded and of every model on one clock, plots
  .mp4 .gif .avi    video, recorded and replayed people side by side; also .webm and other kinds that ffmpeg writes
  .png, .svg        one picture of the same: the last moment, or that of --frame
  NAME/             a folder of PNG files, one a picture
  .csv .parquet .rec .glb ..   trajectories of the replayed, every step, as `throng run` writes them; of several models a file each,
                    with the model in its name: again.csv becomes again-orca.csv, again-hrvo.csv

Files get their names when they are complete. Ctrl-C ends the replay and completes the files.

Keys of --json (one object on standard output; metres, seconds):
  data, step             what was replayed, in steps of so many seconds
  from, until            the first moment and the last
  map                    { areas, obstacles: how many; through: how many of the recorded walk through what is solid }
  recorded               entered: how many; seen_once; pauses: { people, count, seconds } that are given; speed, nearest: { mean, median }; crossings: null, or the same of the times
                         at which --line is crossed; people: as `throng measure --json` says them
  models                 [{ model, .. }], each with
    entered, overlapping (somebody who was there), moved (out of something solid), refused, goals_moved, arrived,
    stranded (cannot reach their goals), walking (on their way at the end)
    delay                seconds by which they arrive later than the recorded left, the median
    speed, nearest       { mean, median, distance: of Kolmogorov and Smirnov from the recorded }
    crossings            null, or the same
    people               as `throng measure --json` says them
    microscopic          every 0.4 s, of `recorded` too: standing (share), speed_deviation (of a person's own speed), turning,
                         acceleration: { median, p99 }, head_on: { pairs, median, p5: least distance }, g (at 0.4, 0.8, .. 4 s to
                         collision), g_rms (root mean square of its difference from the recorded one)
    summary              of the world: least_separation, overlaps, guard_share
  from_entry             [{ horizon, people, average: { MODEL, .., constant_velocity, straight }, final: the same }], by the names
                         of the models, each { mean, median }; the last, with horizon null, is when they were recorded last
  predicted              null, or { every, moments, horizons: the same list, alone, in_groups: the same of the longest horizon, or null }
  wall_seconds, interrupted, files
What is not known is null.

Exit codes: 0 done; 2 an error; 130 interrupted.

Examples:
  throng replay zara01/obsmat.txt --map-offset 0.5,16.2
      a table of figures; walls from zara01/map.xml, which has another origin, groups from zara01/groups.txt
  throng replay zara01/obsmat.txt -o zara01.mp4 -o orca.csv --table people.csv
      side by side, the replayed people's trajectories, and a line a person
  throng replay corridor.txt --map corridor.wkt --line 0,0,0,5 --from 20 --until 60 --json
      a part of it, on a floor plan, counted at a line
  throng replay obsmat.txt --model orca,hrvo,rvo -o models.html --table people.csv
      several models in one table, on one page, and side by side
  throng replay obsmat.txt --model hrvo --set keep_right=0 --speed 90% --every 0
      another model, without its bias to the right, faster people, no predictions";

/// What `throng replay` is told.
#[derive(Args, Debug)]
pub struct ReplayArgs {
    /// Recorded people: a file of trajectories (`throng info`)
    #[arg(value_name = "DATA")]
    pub data: PathBuf,

    /// Who they are and where they walk.
    #[command(flatten)]
    pub stage: StageArgs,

    /// Leaves out what comes before, seconds of the recording: who is there already enters where they are then
    #[arg(long, value_name = "SECONDS", value_parser = parse_not_negative, default_value_t = 0.0)]
    pub from: f64,

    /// Leaves out what comes after [default: the end]
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive)]
    pub until: Option<f64>,

    /// How it is compared.
    #[command(flatten)]
    pub figures: FigureArgs,

    /// What a file of trajectories does not say itself.
    #[command(flatten)]
    pub tracks: TrackArgs,

    /// A file to write, its kind by its ending; can be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// A table to write, .csv: a line a person, with how far the replay and the two simple predictions are off
    #[arg(long, value_name = "FILE")]
    pub table: Option<PathBuf>,

    /// How many threads.
    #[command(flatten)]
    pub threads: ThreadArgs,

    /// Shows no progress bar and no figures
    #[arg(short, long)]
    pub quiet: bool,

    /// Writes the figures as one JSON object to standard output
    #[arg(long)]
    pub json: bool,

    /// Which moments pictures show, and how they look; --size is that of both panels together.
    #[command(flatten)]
    pub film: FilmArgs,
}

/// Who recorded people are, and where they walk.
#[derive(Args, Debug)]
#[command(next_help_heading = "People")]
pub struct StageArgs {
    /// Where they walk.
    #[command(flatten)]
    pub map: MapArgs,

    /// Walks on open ground, whatever the file or a map.xml says
    #[arg(long, conflicts_with_all = ["map", "map_offset"])]
    pub no_map: bool,

    /// Who belongs together: a line a group, the numbers of its members [default: a groups.txt beside the file]
    #[arg(long, value_name = "FILE")]
    pub groups: Option<PathBuf>,

    /// The local model, as `throng compare` takes it: its name, and values of its keys after colons; can be given several times,
    /// or several with commas between them
    #[arg(short, long, value_name = "MODEL,..", value_delimiter = ',', default_value = "orca")]
    pub model: Vec<String>,

    /// Changes a value of the scene with one group that they are; can be given several times
    ///
    /// As of `throng run`: --set avoid.orca.time_horizon=3, --set keep_right=0, --set speed.max=2, --set time.sub_steps=4.
    #[arg(long, value_name = "KEY=VALUE", value_parser = crate::source::parse_change)]
    pub set: Vec<(String, String)>,

    /// Seconds of a step [default: 0.04]
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive)]
    pub step: Option<f64>,

    /// The seed of everything random
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(..=i64::MAX as u64))]
    pub seed: Option<u64>,

    /// Preferred speeds: `mean`, or a part such as 50% that is below it, of their own speeds while they walk; or m/s for everybody
    #[arg(long, value_name = "SPEED", value_parser = parse_pace, default_value = "50%")]
    pub speed: Pace,

    /// Radius of all bodies, metres [default: what the file says, else 0.2]
    #[arg(long, value_name = "METRES", value_parser = parse_positive)]
    pub radius: Option<f64>,

    /// Who is so near to their goal has arrived, metres
    #[arg(long, value_name = "METRES", value_parser = parse_positive, default_value_t = 0.3)]
    pub near: f64,

    /// Gives goals and speeds alone: agents do not stand on the way where and while the recorded people do
    #[arg(long)]
    pub no_pauses: bool,

    /// Who has arrived stays until the recorded one leaves, also those who did not stand at the end
    #[arg(long)]
    pub stay: bool,
}

/// How recorded and replayed people are compared.
#[derive(Args, Debug)]
#[command(next_help_heading = "Figures")]
pub struct FigureArgs {
    /// How many seconds later places are compared
    #[arg(long, value_name = "SECONDS,..", value_delimiter = ',', value_parser = parse_positive, default_value = "1,2,4")]
    pub horizons: Vec<f64>,

    /// Begins predictions anew so often, seconds: everybody where they were recorded then; 0 for none
    #[arg(long, value_name = "SECONDS", value_parser = parse_not_negative, default_value_t = 1.0)]
    pub every: f64,

    /// Over which time a velocity is taken, seconds
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive, default_value_t = 0.4)]
    pub interval: f64,

    /// The line at which people are counted, from one end to the other, metres
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = parse_line, allow_hyphen_values = true)]
    pub line: Option<Line>,
}

impl FigureArgs {
    /// How far ahead a plot looks, seconds: evenly, as far as horizons go.
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
