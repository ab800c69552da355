//! The command line.

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Runs one crowd on many machines, with the bits of one machine.
///
/// Started by mpirun or srun: `mpirun -n 4 throng-mpi run city.toml -o run/`. One rank a machine, or a NUMA domain, is best:
/// the ranks use threads inside.
#[derive(Parser, Debug)]
#[command(name = "throng-mpi", version, max_term_width = 100)]
pub struct Program {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What the program does.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Runs a scene on all ranks
    Run(RunArgs),
    /// Writes a city of any size: a scene and its people
    City(CityArgs),
}

/// Options of `run`.
#[derive(Args, Debug)]
pub struct RunArgs {
    /// The scene: a name of the gallery, or a scene file
    #[arg(value_name = "SCENE")]
    pub scene: PathBuf,

    /// The folder of the run: parts of trajectories, checkpoints, run.json
    ///
    /// `throng convert FOLDER -o FILE` joins the parts.
    #[arg(short, long, value_name = "FOLDER")]
    pub output: PathBuf,

    /// Goes on from the last checkpoint of the folder; the number of ranks may be another one
    #[arg(long)]
    pub resume: bool,

    /// Takes the people from Parquet files instead of the scene: columns x, y, goal_x and goal_y (metres), and, if
    /// wanted, time (seconds until the agent enters), leaves (1: it leaves at its goal) and speed (m/s)
    ///
    /// The people are agents of the first group of the scene: its table gives bodies, speeds and all else.
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub people: Vec<PathBuf>,

    /// Changes one value of the scene, as in `throng run`; can be given several times
    #[arg(long, value_name = "KEY=VALUE", value_parser = parse_change)]
    pub set: Vec<(String, String)>,

    /// The simulated time at which the run ends, seconds [default: as the scene says]
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive)]
    pub time: Option<f64>,

    /// Simulated seconds between two moments in the files; 0: no trajectories
    #[arg(long, value_name = "SECONDS", default_value_t = 1.0, value_parser = parse_not_negative)]
    pub every: f64,

    /// The format of the parts
    #[arg(long, value_enum, default_value_t = Kind::Parquet)]
    pub format: Kind,

    /// Minutes between two checkpoints; 0: none
    ///
    /// Each takes the time to write the state. A run that is asked to end (Ctrl-C, SIGTERM, SIGUSR1) always writes one.
    #[arg(long, value_name = "MINUTES", default_value_t = 10.0, value_parser = parse_not_negative)]
    pub checkpoint: f64,

    /// Steps between two looks at the balance of the ranks; 0: the ground is divided once
    ///
    /// The ground is divided anew where the slowest rank computes more than 1.15 times the mean.
    #[arg(long, value_name = "STEPS", default_value_t = 250)]
    pub balance: u64,

    /// Threads of each rank [default: the cores of the machine, divided by the ranks on it]
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,

    /// Prints the hash of the state after every step, to compare runs
    #[arg(long)]
    pub hashes: bool,

    /// Prints nothing but errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// Formats of parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Kind {
    /// Tables
    Parquet,
    /// Recordings of throng
    Rec,
}

impl Kind {
    /// Returns the ending of file names.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Parquet => "parquet",
            Self::Rec => "rec",
        }
    }
}

/// Options of `city`.
#[derive(Args, Debug)]
pub struct CityArgs {
    /// The number of people
    #[arg(long, value_name = "N", default_value_t = 100_000, value_parser = clap::value_parser!(u32).range(1..=400_000_000))]
    pub people: u32,

    /// People per square metre of street
    #[arg(long, value_name = "N", default_value_t = 0.25, value_parser = parse_density)]
    pub density: f64,

    /// The seed of places and goals
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,

    /// The folder for city.toml and people.parquet
    #[arg(short, long, value_name = "FOLDER")]
    pub output: PathBuf,
}

fn parse_change(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => Ok((key.trim().to_owned(), value.trim().to_owned())),
        _ => Err("write KEY=VALUE, such as time.step=0.1".into()),
    }
}

fn number(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|x: &f64| x.is_finite()).ok_or_else(|| "write a number".into())
}

fn parse_positive(text: &str) -> Result<f64, String> {
    number(text)?.gt(&0.0).then(|| number(text)).ok_or("must be greater than 0")?
}

fn parse_not_negative(text: &str) -> Result<f64, String> {
    number(text)?.ge(&0.0).then(|| number(text)).ok_or("must not be negative")?
}

fn parse_density(text: &str) -> Result<f64, String> {
    let density = parse_positive(text)?;
    (density <= 1.5).then_some(density).ok_or_else(|| "must be at most 1.5, so that the places are found fast".into())
}
