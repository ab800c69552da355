//! The command line of `throng measure`.

use crate::look::{parse_not_negative, parse_positive};
use crate::options::{ReportArgs, ThreadArgs};
use crate::source::{Changes, parse_four};
use crate::tracks::TrackArgs;
use clap::Args;
use glam::DVec2;
use std::path::PathBuf;
use throng_record::pedestrian::{Area, Line};

/// The examples for `throng measure -h`.
pub const SHORT: &str = "\
Examples:
  throng measure flocking
  throng measure flocking --from 5 --to 20 -o flock.html
  throng run flocking -o flock.csv && throng measure flock.csv --json
  throng measure people.txt --area=-0.1,-2,2,2 --line=-0.6,0,2.4,0 -o people.html -o people.csv

`throng measure --help` describes the keys of --json; docs/swarms.md and docs/measures.md define the figures.";

/// The description, keys and examples for `throng measure --help`.
pub const LONG: &str = "\
A scene is run and its groups are measured as swarms. A file of trajectories is measured as swarms too and, if all its
agents walk on the ground, as people: their motion, the times and lengths of their ways, their distances, and lane
formation; with --area the density and speed in an area, with --line the crossings of a line and the flow.

For swarms, velocities and accelerations follow from the positions at three consecutive moments: steps of a scene or
moments of a file. docs/swarms.md defines these figures and compares real swarms; docs/measures.md defines those of
people and compares PedPy's and measurements of real people.

Keys of --json (one object on standard output; metres, seconds):
  scene            name of the scene or the table
  groups           [{ .. }], each with
    name             of the group
    from, to         time of the first and of the last moment
    moments          number of moments
    agents           number of agents, mean over moments
    speed, nearest   { count, mean, sd, rms, least, most, skewness, kurtosis, pdf: [[middle, density], ..] }
    velocity, acceleration   [x, y, z], each a distribution like `speed`
    correlation      { time: lag at which it first falls to 1/e, points: [[lag, value], ..] }
    size, axes       radius of gyration, and its components along [x, y, z]: means over moments
    polarisation     mean over moments
    over_time        [[time, agents, size, polarisation, speed], ..], at most 500
  beside           the figures of the file of --beside, like a group; null without it
  people           null for a scene and for flying agents; else
    people, frame_rate, moments   number of people; moments per second; number of moments
    interval         samples to each side over which a velocity is taken
    speed, turning, acceleration, effort   { count, mean, sd, rms, least, most, .. }: m/s, degrees a second, m/s², W/kg
    travel_time, path_length, path_ratio   distributions over ways from the first to the last sample: s, m
    left             { half, most, all }: seconds until 50 %, 95 % and all of the people have left
    nearest          least distance of two centres; separation: over the sum of their radii
    collisions, near_misses, time_to_collision   pairs that overlapped; pairs within 0.5 s of a collision; least time
    directions       people [one way, other way]; lane_order, steady_lane_order: mean, mean of the middle half
    areas            [{ size, density, speed, voronoi_density, voronoi_speed: means over moments,
                     fundamental_diagram: [[Voronoi density, speed], ..] of all moments }, ..], one per --area
    lines            [{ length, crossed, leftwards, first, last, flow, steady_flow, specific_flow, steady_specific_flow }, ..],
                     one per --line: flows in people/s and people/(s m); steady: without the first and last 5 %
    over_time        { columns: [name, ..], rows: [[..], ..] }, at most 500; all rows with -o NAME.csv or NAME.parquet
  files            the files written
Unknown values are null.

Keys of --json with --feet (metres, shares of moments): people, steps, mean_slide, p95_slide, largest_slide: how far the
point of contact of a foot gets from where it touched the ground; skating_ratio, penetration, airborne, least_gap (less
than 0: feet cross); each: the same for each person, with number, height and build.

Examples:
  throng measure flocking
  throng measure flocking --group birds --from 5 --to 20 -o flock.html
      one page without network, with plots
  throng measure swarm-aggregation --from 5 --beside midges.csv -o swarm.html
      a scene, and the curves of an experiment beside its own
  throng measure midges.csv --lag 1 --json
      a table with the columns number, time, x, y, and optionally group and z
  throng measure AO_300_bottleneck.txt --area=-0.1,-2,2,2 --line=-0.6,0,2.4,0 -o bottleneck.html -o bottleneck.csv
      recorded people: a page of plots, and a table of all moments
  throng run circle -o circle.glb && throng measure circle.glb --feet
      whether the feet of the exported people stand still on the ground; also of a .usda, or of the .bvh of a person
  throng measure hall.h5 --area \"0,0 4,0 2,3\" --walkable hall.wkt --cut-off 1";

/// The arguments of `throng measure`.
#[derive(Args, Debug)]
pub struct MeasureArgs {
    /// A scene (see `throng run`), or a file of trajectories in a format that `throng info` reads
    #[arg(value_name = "SCENE|FILE")]
    pub of: PathBuf,

    /// Changes to the scene.
    #[command(flatten)]
    pub changes: Changes,

    /// Measures only this group [default: all groups, each separately]
    #[arg(short, long, value_name = "NAME")]
    pub group: Option<String>,

    /// Leaves out everything before this time, seconds
    #[arg(long, value_name = "SECONDS", value_parser = parse_not_negative, default_value_t = 0.0)]
    pub from: f64,

    /// Leaves out everything after this time, seconds [default: the end of the scene, or of the file]
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive)]
    pub to: Option<f64>,

    /// The largest lag of the autocorrelation of velocities, seconds
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive, default_value_t = 2.0)]
    pub lag: f64,

    /// A file of trajectories to compare with, such as an experiment with insects: its figures follow, and its curves are
    /// drawn beside
    ///
    /// Its groups are measured together, from its first moment to its last.
    #[arg(long, value_name = "FILE")]
    pub beside: Option<PathBuf>,

    /// Measures how far the feet of the people in a .glb, .usda or .bvh file slide, read at four times its frames
    #[arg(long, conflicts_with_all = ["group", "beside", "area", "line", "output", "walkable", "cut_off"])]
    pub feet: bool,

    /// Options for measuring people.
    #[command(flatten)]
    pub people: PeopleArgs,

    /// How a file of trajectories is read.
    #[command(flatten)]
    pub tracks: TrackArgs,

    /// The file to write: a page of plots, .html; the plots alone, .svg or .png; the figures of people at all moments,
    /// .csv or .parquet; can be given several times
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// The number of threads.
    #[command(flatten)]
    pub threads: ThreadArgs,

    /// How results are reported.
    #[command(flatten)]
    pub report: ReportArgs,
}

/// Options for measuring people.
#[derive(Args, Debug)]
#[command(next_help_heading = "People")]
pub struct PeopleArgs {
    /// Area in which density and speed are measured: lower left corner, width and height of a rectangle, or the corners
    /// of a polygon, metres; can be given several times
    #[arg(long, value_name = "X,Y,W,H|\"X,Y X,Y X,Y ..\"", value_parser = parse_area, allow_hyphen_values = true)]
    pub area: Vec<Area>,

    /// Line at which people are counted, from one end to the other, metres; can be given several times
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = parse_line, allow_hyphen_values = true)]
    pub line: Vec<Line>,

    /// Interval over which a velocity is taken, seconds: half before and half after
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive, default_value_t = 0.4)]
    pub interval: f64,

    /// Walkable ground to which Voronoi cells are clipped: a floor plan (see `throng run`) [default: the ground in the
    /// file]
    #[arg(long, value_name = "FILE")]
    pub walkable: Option<PathBuf>,

    /// Maximum distance that Voronoi cells reach, metres [default: up to the ground's edge, 1 without known ground]
    #[arg(long, value_name = "METRES", value_parser = parse_positive)]
    pub cut_off: Option<f64>,
}

/// Parses a rectangle or a polygon.
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

/// Parses the two ends of a line.
pub fn parse_line(text: &str) -> Result<Line, String> {
    let [x0, y0, x1, y1] = parse_four(text)?;
    let line = Line { from: DVec2::new(x0, y0), to: DVec2::new(x1, y1) };
    if line.length() > 0.0 { Ok(line) } else { Err("the two ends of the line are equal".into()) }
}
