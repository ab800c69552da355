//! The command line.

use crate::annotate::AnnotateArgs;
use crate::bench::args::{self as bench, BenchArgs};
use crate::choice::ChoiceArgs;
use crate::compare::{COMPARE, COMPARE_SHORT, CompareArgs};
use crate::explain::args::{self as explain, ExplainArgs};
use crate::info::args::{self as info, InfoArgs};
use crate::look::LookArgs;
use crate::measure::args::{self as measure, MeasureArgs};
use crate::options::{EndArgs, FilmArgs, ReportArgs, ThreadArgs};
use crate::recorded::args::{self as recorded, ConvertArgs, RenderArgs};
use crate::replay::args::{self as replay, ReplayArgs};
use crate::sheet::args::{self as sheet, SheetArgs};
use crate::source::SceneArgs;
use crate::sweep::args::{self as sweep, SweepArgs};
use crate::validate::args::{self as validate, ValidateArgs};
use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;

/// Crowds and groups of agents: runs scenes, writes video, pictures and trajectories
#[derive(Parser, Debug)]
#[command(name = "throng", version, propagate_version = true, after_help = EXAMPLES, after_long_help = EXAMPLES)]
pub struct Arguments {
    /// The subcommand.
    #[command(subcommand)]
    pub command: Command,
}

const EXAMPLES: &str = "\
Examples:
  throng list                        the scenes of the gallery
  throng run circle                  run one; writes circle.mp4
  throng run plan.toml -o a.mp4 -o a.csv
  throng compare circle -o c.html    the local models side by side
  throng sweep width.toml            many runs, their parameters and seeds by a plan: width.parquet
  throng check plan.toml             validate a scene and report what it does
  throng show doorway                a picture of the start, doorway.png
  throng sheet                       a still of each scene of the gallery, sheet.png
  throng measure flocking            distributions of speeds, distances and the like
  throng replay obsmat.txt -o a.mp4  recorded and simulated people side by side
  throng info run.csv                report on a file of trajectories
  throng convert run.csv -o run.usda the same trajectories as another kind of file
  throng render people.txt -o a.mp4  a video of a file of trajectories
  throng validate --quick            experiments with people beside the model's results
  throng explain circle --agent 3    why agent 3 chooses its velocity, circle-agent-3.svg
  throng bench                       how long steps take on this machine

Exit codes: 0 done; 1 the scene did not meet its [expect], or another check failed; 2 an error; 130 interrupted.";

/// The subcommands.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Runs a scene and writes what happens
    #[command(after_help = RUN_SHORT, after_long_help = RUN)]
    Run(Box<RunArgs>),
    /// Runs a scene with several local models and shows them side by side
    ///
    /// Every model runs every seed. The table holds the median of each figure, and its range where there are several
    /// seeds; docs/compare.md defines the figures.
    #[command(after_help = COMPARE_SHORT, after_long_help = COMPARE)]
    Compare(Box<CompareArgs>),
    /// Makes many runs with many values of parameters and many seeds, and writes one table of the results
    ///
    /// A plan names scenes, parameters and seeds; docs/sweeps.md describes it. Every run has one thread, and several run
    /// at a time. An interrupted sweep goes on where it was.
    #[command(after_help = sweep::SHORT, after_long_help = sweep::LONG)]
    Sweep(SweepArgs),
    /// Measures how long steps take, stage by stage, in reference works and scenes
    #[command(after_help = bench::SHORT, after_long_help = bench::LONG)]
    Bench(Box<BenchArgs>),
    /// Lists the scenes of the gallery, group by group: their titles and the names to type
    #[command(after_help = LIST)]
    List(ListArgs),
    /// Validates a scene and reports what it would do
    ///
    /// Reads the scene, builds its world, plans the ways of all agents and makes one step. Reports agents, groups,
    /// goals, the place, what importers left out, agents that overlap at the start, and goals that cannot be reached,
    /// with the reasons. The exit code is 0 for a scene that can be run, with or without warnings, and 2 for one that
    /// cannot.
    #[command(after_help = CHECK)]
    Check(SceneArgs),
    /// Draws the start of a scene
    #[command(after_help = SHOW)]
    Show(ShowArgs),
    /// Draws a contact sheet: a still of each of many scenes, with its name
    ///
    /// Runs every scene up to a typical moment, several scenes at a time, and draws them side by side, under the
    /// headings of the gallery's groups. Without names, the whole gallery.
    #[command(after_help = sheet::EXAMPLES, after_long_help = sheet::EXAMPLES)]
    Sheet(SheetArgs),
    /// Reports on a file of trajectories: agents, times, place, speeds
    #[command(after_help = info::LONG, after_long_help = info::LONG)]
    Info(InfoArgs),
    /// Measures swarms: distributions of speeds, accelerations and distances, correlation times of velocities, sizes
    ///
    /// Measures the scene that it runs, or a table of trajectories; docs/swarms.md defines the figures.
    #[command(after_help = measure::SHORT, after_long_help = measure::LONG)]
    Measure(Box<MeasureArgs>),
    /// Converts trajectories: to another kind of file, to other moments, to some of the people
    #[command(after_help = recorded::CONVERT, after_long_help = recorded::CONVERT)]
    Convert(Box<ConvertArgs>),
    /// Draws trajectories: writes video and pictures of a file
    #[command(after_help = recorded::RENDER, after_long_help = recorded::RENDER)]
    Render(Box<RenderArgs>),
    /// Replays recorded people: they enter as recorded, walk by a model, and are compared with the recording
    ///
    /// Every agent enters at the recorded time and place with the recorded speed and goal. Recorded and simulated
    /// people are drawn side by side and compared; docs/replay.md defines the figures.
    #[command(after_help = replay::SHORT, after_long_help = replay::LONG)]
    Replay(Box<ReplayArgs>),
    /// Validates the pedestrian model: repeats experiments with people and compares the results
    ///
    /// Every case runs every seed. The table holds mean and standard deviation of each figure, the value measured in
    /// the experiment, and the tolerance.
    #[command(after_help = validate::SHORT, after_long_help = validate::LONG)]
    Validate(Box<ValidateArgs>),
    /// Draws why one agent chooses its velocity: its velocity space at one moment
    #[command(after_help = explain::SHORT, after_long_help = explain::LONG)]
    Explain(Box<ExplainArgs>),
    /// Opens the studio: see, direct and debug scenes in a window
    #[cfg(feature = "studio")]
    Studio(throng_studio::window::Arguments),
    /// Writes the JSON schema of scene files to standard output
    ///
    /// Editors with support for JSON schemas complete and check the keys of scene files.
    #[command(after_help = "Example:\n  throng schema > throng.schema.json")]
    Schema,
    /// Writes the completion script of a shell to standard output
    #[command(after_help = "Example:\n  throng completions bash > ~/.local/share/bash-completion/completions/throng")]
    Completions(CompletionsArgs),
}

const RUN_SHORT: &str = "\
Examples:
  throng run circle
  throng run doorway -o door.mp4 -o door.csv -o end.png --color speed
  throng run headon --json --no-files --set avoid.orca.time_horizon=3

`throng run --help` describes the outputs and the keys of --json.";

const RUN: &str = "\
Outputs, by the ending of the name:
  .mp4              video (H.264)
  .gif              looping animation
  .png, .svg        one picture: the last moment, or that of --frame
  .csv              trajectories: every agent at every step, as text
  .parquet          the same for data frames (Apache Parquet)
  .rec              the same in few bytes; NAME.rec.part holds what is written so far and is readable after a crash
  .sqlite           the same for JuPedSim and PedPy
  .usda             the same for film and animation (Universal Scene Description)
  .glb              the same for engines and the web (binary glTF)
  NAME-*.bvh        the joints of each person, a file each: its number takes the place of *
  NAME/             a folder of PNG files, one a picture
  .avi, .webm, ...  other video, through the program ffmpeg if it is installed

Files get their names when they are complete. Ctrl-C ends the run and completes the files; a second one ends the
program at once.

Keys of --json (one object on standard output):
  scene                     name of the scene
  agents                    all agents: present, removed, and still to enter
  arrived, removed          at the ends of their journeys (removed agents included); removed by exits
  resting                   agents that stand still
  queueing                  agents that stand in a queue that moves
  waiting_for_room          agents outside the goal area of their journey, in which no place is free
  blocked                   agents without progress for 10 s, not because of a queue
  oscillating               agents without progress for 10 s that kept walking
  stranded                  agents that cannot reach their goals
  stuck                     blocked, oscillating and stranded agents together
  without_progress_30s      how often an agent walked for 30 s without progress
  time                      seconds simulated
  time_ratio, path_ratio    agents that arrived: time and length of the way over those of the shortest way, mean
  least_separation          least distance of two centres over the sum of their radii; 1: they touched
  overlaps                  overlaps of bodies with bodies and walls, counted every sub-step
  guard_share               share of the moves that the guard changed by more than 1 %
  pushed_share              share of the moves that accelerate an agent beyond its limit, which only the guard causes
  backwards_share           share of the time that walking agents move against the direction of their way
  heading_change_deg_per_s  turning of the headings of walking agents, mean
  course_change_deg_per_s   turning of their directions of motion: trembling, which headings smooth out
  steps, sub_steps          steps made, and the sub-steps they were divided into
  agent_steps_per_second    moves of one agent by one sub-step, per second of computing the steps
  expect                    { passed, checks: [{ name, expected, found, passed }] }: the scene's [expect]
  figures                   what the rules of a game count, by name; empty without rules
  least_wall_separation     least distance of a centre to a wall or solid over the radius
  state_hash                hash of the last state: the same for the same bits, here and in the studio
  swarms                    [{ name, speed, speed_sd, acceleration, nearest, size, polarisation, correlation_time }] of
                            the groups that steer as swarms: means, as in `throng measure`
  wall_seconds              seconds the whole run took, files included
  step_seconds              seconds the steps alone took
  cpu_per_simulated_second  processor seconds (all threads, files included) per simulated second
  interrupted               whether the run was interrupted
  files                     the files written
Infinite and unknown values are null.

Exit codes: 0 done; 1 the scene did not meet its [expect]; 2 an error; 130 interrupted.

Examples:
  throng run circle
      writes circle.mp4
  throng run doorway -o door.mp4 -o door.csv -o end.png --color speed
  throng run office.toml -o frames/ --fps 10 --size 1280x720 --camera 0,0,20,15
  throng run bottleneck --speed-up 4 --trails 5
  throng run drones --projection plan
  throng run corridor -o people.csv --rate 10 --from 5 --to 20 --columns number,time,x,y
  throng run crossing --annotate=velocity,targets --annotate-agents 1,5
  throng run street.toml --field=speed,streamlines
  throng run headon --json --no-files --set avoid.orca.time_horizon=3
  throng run station.wkt --exit 10,0,2,4 --people 500 -o station.mp4
  throng run scenario.zip -o scenario.csv --limit 60";

const CHECK: &str = "\
Examples:
  throng check doorway
  throng check plan.toml --set count=5000
  throng check station.wkt --exit 10,0,2,4 --people 500";

const LIST: &str = "\
A slider is a number to change with --set PATH=VALUE, a preset a change to make with --preset NAME.

Examples:
  throng list
  throng list arrival
  throng list fields my-scene.toml
  throng run arrival --preset 'too late'";

const SHOW: &str = "\
Examples:
  throng show doorway
  throng show plan.toml -o plan.svg --size 1600x900";

/// The arguments of `throng run`.
#[derive(Args, Debug)]
pub struct RunArgs {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,

    /// A file to write, its kind by its ending; can be given several times [default: <scene>.mp4]
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// Writes no files: only the summary
    #[arg(long, conflicts_with = "output")]
    pub no_files: bool,

    /// When the run ends.
    #[command(flatten)]
    pub end: EndArgs,

    /// Does not check the scene's [expect]
    #[arg(long)]
    pub no_expect: bool,

    /// The number of threads.
    #[command(flatten)]
    pub threads: ThreadArgs,

    /// How results are reported.
    #[command(flatten)]
    pub report: ReportArgs,

    /// What is written.
    #[command(flatten)]
    pub choice: ChoiceArgs,

    /// The moments that pictures show, and how pictures look.
    #[command(flatten)]
    pub film: FilmArgs,

    /// What is drawn beside agents.
    #[command(flatten)]
    pub annotate: AnnotateArgs,
}

/// The arguments of `throng list`.
#[derive(Args, Debug)]
pub struct ListArgs {
    /// Groups of the gallery, `papers`, names of scenes, and scene files: writes what they say to viewers [default: the list of
    /// all scenes]
    #[arg(value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,

    /// Writes what each scene says to viewers: what to see, why, its sliders and presets
    #[arg(short, long, conflicts_with = "names")]
    pub long: bool,

    /// Writes only the names, for programs
    #[arg(long, conflicts_with = "scenes")]
    pub names: bool,
}

/// The arguments of `throng show`.
#[derive(Args, Debug)]
pub struct ShowArgs {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,

    /// The picture to write, .png or .svg [default: <scene>.png]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// How pictures look.
    #[command(flatten)]
    pub look: LookArgs,
}

/// The arguments of `throng completions`.
#[derive(Args, Debug)]
pub struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    pub shell: clap_complete::Shell,
}
