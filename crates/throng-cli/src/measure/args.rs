//! What `throng measure` is told, and its help.

use crate::look::{parse_not_negative, parse_positive};
use crate::options::ThreadArgs;
use crate::source::{Changes, parse_four};
use crate::tracks::TrackArgs;
use clap::Args;
use glam::DVec2;
use std::path::PathBuf;
use throng_record::pedestrian::{Area, Line};

/// After `throng measure -h`.
pub const SHORT: &str = "\
Examples:
  throng measure flocking
  throng measure flocking --from 5 --to 20 -o flock.html
  throng run flocking -o flock.csv && throng measure flock.csv --json
  throng measure people.txt --area=-0.1,-2,2,2 --line=-0.6,0,2.4,0 -o people.html -o people.csv

`throng measure --help` describes the keys of --json; docs/swarms.md and docs/measures.md, what the figures mean.";

/// After `throng measure --help`.
pub const LONG: &str = "\
A scene is run and its groups are measured as swarms. A file of trajectories is measured so too, and, where nobody is above
the ground, as people: how they move, how long they are on their way, how near they come to each other and whether they walk
in lanes; with --area density and speed in it, with --line how many cross it and the flow.

Of swarms, velocities and accelerations are those of the positions at three moments on end, the steps of a scene or the
moments of a file. docs/swarms.md says how each figure is counted, and what is known of real swarms; docs/measures.md, those of
people, beside PedPy's and what was measured of real ones.

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
  people           null for a scene and for those who fly; else
    people, frame_rate, moments   how many; moments a second; how many moments
    interval         rows to each side over which a velocity is taken
    speed, turning, acceleration, effort   { count, mean, sd, rms, least, most, .. }: m/s, degrees a second, m/s², W/kg
    travel_time, path_length, path_ratio   the same, of ways from first to last seen: s, m
    left             { half, most, all }: seconds until so many (1/2, 95 %) have been seen for the last time
    nearest          least distance of two centres; separation: over the sum of their radii
    collisions, near_misses, time_to_collision   how often two came to overlap, or to be on a course to within 0.5 s; the least
    directions       [one way, the other]; lane_order, steady_lane_order: mean, and of the middle half of the time
    areas            [{ size, density, speed, voronoi_density, voronoi_speed: means over moments,
                     fundamental_diagram: [[Voronoi density, speed], ..] of all moments }, ..], one an --area
    lines            [{ length, crossed, leftwards, first, last, flow, steady_flow, specific_flow, steady_specific_flow }, ..],
                     one a --line: people a second, and a second and metre; steady: without the first and last 5 %
    over_time        { columns: [name, ..], rows: [[..], ..] }, at most 500; all of them with -o NAME.csv or NAME.parquet
  files            the files written
What is not known is null.

Examples:
  throng measure flocking
  throng measure flocking --group birds --from 5 --to 20 -o flock.html
      one page without network, with plots
  throng measure midges.csv --lag 1 --json
      a table with the columns number, time, x, y, and perhaps group and z
  throng measure AO_300_bottleneck.txt --area=-0.1,-2,2,2 --line=-0.6,0,2.4,0 -o bottleneck.html -o bottleneck.csv
      recorded people: a page of plots, and a table of all moments
  throng measure hall.h5 --area \"0,0 4,0 2,3\" --walkable hall.wkt --cut-off 1";

/// What `throng measure` is told.
#[derive(Args, Debug)]
pub struct MeasureArgs {
    /// A scene (see `throng run`), or a file of trajectories, as `throng run -o NAME.csv` writes it or others (`throng info`)
    #[arg(value_name = "SCENE|FILE")]
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

    /// Leaves out what comes after, seconds [default: the end of the scene, or of the file]
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive)]
    pub to: Option<f64>,

    /// How much later velocities are compared with themselves, seconds
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive, default_value_t = 2.0)]
    pub lag: f64,

    /// How people are measured.
    #[command(flatten)]
    pub people: PeopleArgs,

    /// What a file of trajectories does not say itself.
    #[command(flatten)]
    pub tracks: TrackArgs,

    /// What to write: a page of plots, .html; the plots alone, .svg or .png; people's figures of all moments, .csv or .parquet;
    /// can be given several times
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

/// How people are measured.
#[derive(Args, Debug)]
#[command(next_help_heading = "People")]
pub struct PeopleArgs {
    /// Where density and speed are measured: lower left corner, width and height of a rectangle, or the corners of a polygon,
    /// metres; can be given several times
    #[arg(long, value_name = "X,Y,W,H|\"X,Y X,Y X,Y ..\"", value_parser = parse_area, allow_hyphen_values = true)]
    pub area: Vec<Area>,

    /// The line at which people are counted, from one end to the other, metres; can be given several times
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = parse_line, allow_hyphen_values = true)]
    pub line: Vec<Line>,

    /// Over which time a velocity is taken, seconds: half before and half after
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive, default_value_t = 0.4)]
    pub interval: f64,

    /// The ground that can be walked on, a floor plan (see `throng run`) less what is solid in it, to which Voronoi cells are clipped [default: what the file says]
    #[arg(long, value_name = "FILE")]
    pub walkable: Option<PathBuf>,

    /// How far Voronoi cells reach, metres [default: as far as the ground, 1 where that is not known]
    #[arg(long, value_name = "METRES", value_parser = parse_positive)]
    pub cut_off: Option<f64>,
}

/// Reads a rectangle or a polygon.
fn parse_area(text: &str) -> Result<Area, String> {
    let corner = |pair: &str| {
        let (x, y) = pair.split_once(',')?;
        let [x, y] = [x, y].map(|x| x.trim().parse().ok().filter(|x: &f64| x.is_finite()));
        Some(DVec2::new(x?, y?))
    };
    let area = if text.trim().contains(char::is_whitespace) {
        text.split_whitespace().map(corner).collect::<Option<Vec<DVec2>>>().and_then(Area::new)
    } else {
        parse_four(text).ok().filter(|[_, _, w, h]| *w > 0.0 && *h > 0.0).and_then(Area::rectangle)
    };
    area.ok_or_else(|| "write x,y,width,height, or the corners of a polygon such as \"0,0 4,0 2,3\"".into())
}

/// Reads the two ends of a line.
pub fn parse_line(text: &str) -> Result<Line, String> {
    let [x0, y0, x1, y1] = parse_four(text)?;
    let line = Line { from: DVec2::new(x0, y0), to: DVec2::new(x1, y1) };
    if line.length() > 0.0 { Ok(line) } else { Err("the two ends are at one place".into()) }
}
